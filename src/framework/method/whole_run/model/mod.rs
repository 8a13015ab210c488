//! MODEL-IET: one Gaussian process of the feature map, shared by all goals, decides every trial.
//!
//! Identification moves first (nothing known), then, goal by goal, the pose whose predicted features come nearest
//! while the model is still sure of them; of poses alike, the one with the least motion from its neighbours. A goal ends
//! when a measured pose is within the tolerance, when the model expects no improvement even optimistically, or after
//! [`ModelSpec::max_tries`]. The model may be wrong about what it has not seen: a goal is out of reach only once
//! [`ModelSpec::restarts`] trials from another region of the joint space have left it as hopeless.
//!
//! Sources: R. Astudillo, P. Frazier, "Bayesian Optimization of Composite Functions", ICML 2019; M. Deisenroth,
//! C. Rasmussen, PILCO, ICML 2011; K. Chatzilygeroudis et al., Black-DROPS, IROS 2017; A. Cully et al., "Robots that
//! can adapt like animals", Nature 521 (2015), DOI 10.1038/nature14422.

mod belief;
mod columns;
mod kernel;
mod nearness;
mod process;
mod restart;
mod shortlist;
mod simulator;
mod spec;
#[cfg(test)]
pub(super) mod tests;

pub use spec::{ModelSpec, Prior};

use super::planner::{Believed, FeatureMap, GoalOutcome, NextTrial, RunSetup, Trial, WholeRun, WholeRunMethod};
use super::space::Space;
use super::steps::Targets;
use crate::distance::distance;
use crate::random::RandomStream;
use crate::world::WorldError;
use belief::{Aim, Belief};
use nearness::Neighbours;
use shortlist::{Starts, nearest_by_prior};
use simulator::SimulatedWorld;

/// How many of the measured poses nearest to a goal are searched around.
const LOCAL_CENTRES: usize = 3;

/// Weight of the predicted variance while a goal has had fewer than [`CAUTIOUS_TRIES`] trials, and after.
const CAUTION: f64 = 0.1;
const LATE_CAUTION: f64 = 0.02;
const CAUTIOUS_TRIES: u32 = 4;

/// A goal that is still worth a trial.
struct Open {
    index: usize,
    tries: u32,
    /// B, the smallest distance measured so far.
    best: f64,
    /// The improvement a trial must promise.
    need: f64,
    /// Poses between which the goal's own lies.
    neighbours: Neighbours,
}

/// A run of MODEL-IET.
pub struct ModelIet {
    spec: ModelSpec,
    tolerance: f64,
    space: Space,
    goals: Vec<Vec<f64>>,
    prior: Option<Box<dyn FeatureMap>>,
    earlier: Vec<Trial>,
    log: Vec<Trial>,
    seed: u64,
}

impl ModelIet {
    /// A run for `goals` (n rows of m features) over `space`; a goal is reached within `tolerance` (features' unit).
    #[must_use]
    pub fn new(spec: ModelSpec, tolerance: f64, space: Space, goals: Vec<Vec<f64>>, seed: u64) -> Self {
        Self { spec, tolerance, space, goals, prior: None, earlier: Vec::new(), log: Vec::new(), seed }
    }

    /// With a simulator as the prior mean.
    #[must_use]
    pub fn with_prior(mut self, prior: Box<dyn FeatureMap>) -> Self {
        self.prior = Some(prior);
        self
    }

    /// With the trials of earlier runs on the same robot.
    #[must_use]
    pub fn with_earlier(mut self, earlier: Vec<Trial>) -> Self {
        self.earlier = earlier;
        self
    }

    fn identification_count(&self) -> usize {
        let nothing_known = self.prior.is_none() && self.earlier.iter().all(|t| t.observation.is_none());
        if nothing_known { self.space.len() + 1 } else { 0 }
    }

    fn ask_model(&self, identification: usize, mut prior: Option<&mut dyn FeatureMap>) -> NextTrial {
        let mut random = RandomStream::of_run(self.seed, self.log.len() as u64 + 1);
        let logs = [self.earlier.as_slice(), self.log.as_slice()];
        if self.log.iter().chain(&self.earlier).all(|t| t.observation.is_none()) {
            let blind = self.log.len() >= identification + self.spec.max_tries as usize;
            if blind {
                return NextTrial::Finished;
            }
            let prior = prior.as_deref_mut();
            let joints = nearest_by_prior(&self.space, &self.goals[0], prior, !self.log.is_empty(), &mut random);
            let joints = self.space.equivalent(&joints, &self.space.home());
            return NextTrial::Execute { joints, goal: 0 };
        }
        let Some(mut belief) = Belief::fit(&self.space, logs, &self.goals, prior, self.spec.noise) else {
            return NextTrial::Finished;
        };
        let open = self.open_goals(identification, &mut belief);
        let mut starts = Starts::new(&self.space, &mut belief, &mut random);
        let mut chosen: Option<(f64, Vec<f64>, usize)> = None;
        for goal in &open {
            let Some((rank, joints)) = self.sure_pose(goal, &mut starts, &mut belief, &mut random) else { continue };
            if chosen.as_ref().is_none_or(|c| rank < c.0) {
                chosen = Some((rank, joints, goal.index));
            }
        }
        if chosen.is_none() {
            for goal in &open {
                if let Some(joints) = self.hopeful_pose(goal, &mut starts, &mut belief, &mut random) {
                    chosen = Some((0.0, joints, goal.index));
                    break;
                }
            }
        }
        if chosen.is_none() {
            chosen =
                self.restart(identification, &open, &starts, &mut belief).map(|(joints, goal)| (0.0, joints, goal));
        }
        if let Some((_, joints, goal)) = chosen {
            return NextTrial::Execute { joints, goal };
        }
        NextTrial::Finished
    }

    /// Observations of the own trials, m values each; with noise, the model's mean there instead. `None` if the
    /// observation was lost.
    fn seen(&self, belief: &mut Belief) -> Vec<Option<Vec<f64>>> {
        let mut denoised = |trial: &Trial| {
            let observed = trial.observation.clone()?;
            if self.spec.noise == 0.0 {
                return Some(observed);
            }
            belief.predict_mean(&trial.joints);
            Some(belief.mean.clone())
        };
        self.log.iter().map(&mut denoised).collect()
    }

    /// B: the smallest distance of what was `seen` to the goal, and at which trial.
    fn best(&self, goal: usize, seen: &[Option<Vec<f64>>]) -> (Option<usize>, f64) {
        let mut best = (None, f64::INFINITY);
        for (index, observed) in seen.iter().enumerate() {
            let Some(observed) = observed else { continue };
            let miss = distance(observed, &self.goals[goal]);
            if miss < best.1 {
                best = (Some(index), miss);
            }
        }
        best
    }

    /// Asks the belief that all trials lead to; `None` if nothing was observed.
    fn with_belief<T>(&mut self, ask: impl FnOnce(&Self, &mut Belief) -> T) -> Option<T> {
        let mut prior = self.prior.take();
        let logs = [self.earlier.as_slice(), self.log.as_slice()];
        let map = prior.as_deref_mut().map(|p| p as &mut dyn FeatureMap);
        let belief = Belief::fit(&self.space, logs, &self.goals, map, self.spec.noise);
        let answer = belief.map(|mut belief| ask(self, &mut belief));
        self.prior = prior;
        answer
    }

    /// Trials of a goal's own.
    fn tries(&self, identification: usize, goal: usize) -> u32 {
        self.log.iter().skip(identification).filter(|t| t.goal == goal).fold(0, |n, _| n + 1)
    }

    /// The goals still worth a trial: not reached, tries left.
    fn open_goals(&self, identification: usize, belief: &mut Belief) -> Vec<Open> {
        let seen = self.seen(belief);
        let bests: Vec<_> = (0..self.goals.len()).map(|goal| self.best(goal, &seen)).collect();
        let pose = |(goal, &(trial, miss)): (usize, &(Option<usize>, f64))| {
            let is_known = miss <= self.tolerance || self.tries(identification, goal) > 0;
            trial.filter(|_| is_known).map(|trial| self.log[trial].joints.as_slice())
        };
        let known: Vec<_> = bests.iter().enumerate().map(pose).collect();
        let mut open = Vec::with_capacity(self.goals.len());
        for (index, &(_, best)) in bests.iter().enumerate() {
            let tries = self.tries(identification, index);
            if best + self.spec.noise.min(0.1 * self.tolerance) > self.tolerance && tries < self.spec.max_tries {
                let need = (0.25 * self.tolerance).max(0.02 * best);
                let neighbours = Neighbours::of(index, &known, &self.space);
                open.push(Open { index, tries, best, need, neighbours });
            }
        }
        open
    }

    /// The pose expected nearest to the goal among those the model is sure of, if it improves enough; with the squared
    /// distance expected.
    fn sure_pose(
        &self,
        goal: &Open,
        starts: &mut Starts,
        belief: &mut Belief,
        random: &mut RandomStream,
    ) -> Option<(f64, Vec<f64>)> {
        let target = self.goals[goal.index].as_slice();
        let sure = Aim { goal: target, caution: if goal.tries < CAUTIOUS_TRIES { CAUTION } else { LATE_CAUTION } };
        let poses = self.search(starts, sure, belief, random).into_iter();
        let scored = poses.map(|pose| {
            let pose = goal.neighbours.unwind(&self.space, &pose);
            (belief.score(&pose, sure).sqrt(), pose)
        });
        let (_, pose) = goal.neighbours.choose(&self.space, scored.collect(), self.tolerance)?;
        let variance = belief.predict(&pose);
        let miss = distance(&belief.mean, target);
        if goal.best - miss < goal.need {
            return None;
        }
        Some((miss * miss + target.len() as f64 * variance, pose))
    }

    /// The pose that, looked at optimistically, improves the goal enough.
    fn hopeful_pose(
        &self,
        goal: &Open,
        starts: &mut Starts,
        belief: &mut Belief,
        random: &mut RandomStream,
    ) -> Option<Vec<f64>> {
        let target = self.goals[goal.index].as_slice();
        let hopeful = Aim { goal: target, caution: -0.25 };
        let mut candidates = Vec::new();
        for pose in self.search(starts, hopeful, belief, random) {
            let pose = goal.neighbours.unwind(&self.space, &pose);
            let variance = belief.predict(&pose);
            let value = distance(&belief.mean, target) - 0.5 * (target.len() as f64 * variance).sqrt();
            candidates.push((value, pose));
        }
        let (hope, pose) = goal.neighbours.choose(&self.space, candidates, self.tolerance)?;
        (hope < goal.best - goal.need).then_some(pose)
    }

    /// Refined poses, some found around the measured ones nearest to the goal.
    fn search(&self, starts: &mut Starts, aim: Aim, belief: &mut Belief, random: &mut RandomStream) -> Vec<Vec<f64>> {
        let trials = self.earlier.iter().chain(&self.log);
        let measured = |t: &'_ Trial| Some(distance(t.observation.as_deref()?, aim.goal));
        let mut nearest: Vec<(f64, &[f64])> =
            trials.filter_map(|t| Some((measured(t)?, t.joints.as_slice()))).collect();
        nearest.sort_by(|a, b| a.0.total_cmp(&b.0));
        let centres: Vec<&[f64]> = nearest.iter().take(LOCAL_CENTRES).map(|near| near.1).collect();
        starts.search(&self.space, aim, &centres, belief, random)
    }
}

impl WholeRunMethod for ModelSpec {
    fn start(&self, run: &RunSetup<'_>) -> Result<Box<dyn WholeRun>, WorldError> {
        let Targets { goals, tolerance } = run.targets.clone();
        let most = run.max_evaluations_per_goal.and_then(|most| u32::try_from(most).ok());
        let spec = Self { max_tries: self.max_tries.min(most.unwrap_or(u32::MAX)), ..self.clone() };
        let model =
            ModelIet::new(spec, tolerance, run.space.clone(), goals, run.seed).with_earlier(run.earlier.to_vec());
        Ok(match self.prior {
            Prior::None => Box::new(model),
            Prior::Simulator => Box::new(model.with_prior(Box::new(SimulatedWorld::new(run)?))),
        })
    }

    fn keeps_goal_limits(&self) -> bool {
        true
    }

    fn max_step_deg(&self) -> Option<f64> {
        self.max_step_deg
    }
}

impl WholeRun for ModelIet {
    fn ask(&mut self) -> NextTrial {
        let identification = self.identification_count();
        if self.log.len() < identification {
            let step = self.spec.identification_deg.to_radians();
            let pose = self.space.identification(self.log.len(), step);
            if let Some(joints) = pose.filter(|p| self.space.allows(p)) {
                return NextTrial::Execute { joints, goal: 0 };
            }
        }
        let mut prior = self.prior.take();
        let proposal = self.ask_model(identification, prior.as_deref_mut().map(|p| p as &mut dyn FeatureMap));
        self.prior = prior;
        proposal
    }

    fn tell(&mut self, trial: Trial) {
        self.log.push(trial);
    }

    fn log(&self) -> &[Trial] {
        &self.log
    }

    fn outcomes(&mut self) -> Vec<GoalOutcome> {
        let outcomes = self.with_belief(|model, belief| {
            let seen = model.seen(belief);
            let outcome = |goal| {
                let (trial, distance) = model.best(goal, &seen);
                GoalOutcome { trial, distance }
            };
            (0..model.goals.len()).map(outcome).collect()
        });
        outcomes.unwrap_or_else(|| vec![GoalOutcome { trial: None, distance: f64::INFINITY }; self.goals.len()])
    }

    fn believed(&mut self, poses: &[&[f64]]) -> Option<Vec<Believed>> {
        if self.spec.noise == 0.0 {
            return None;
        }
        self.with_belief(|_, belief| {
            let at = |pose: &&[f64]| {
                let variance = belief.predict(pose);
                Believed { mean: belief.mean.clone(), variance }
            };
            poses.iter().map(at).collect()
        })
    }

    fn is_used_up(&self, goal: usize) -> bool {
        self.tries(self.identification_count(), goal) >= self.spec.max_tries
    }

    fn has_restarted(&mut self, goal: usize) -> bool {
        self.have_restarts_agreed(self.identification_count(), goal)
    }
}
