//! Gauss-Newton with Broyden's Jacobian: the classical way to a goal in few evaluations, the Jacobian carried over from
//! goal to goal.
//!
//! Symbols: d joints q, m features o, goals `X_j`, Jacobian J (m x d, features' unit per rad or m).
//!
//! 1. Identification: home, then home with each joint moved in turn; every trial, these and all later ones, corrects J
//!    along its step by Broyden's rank-one update `J += (do - J dq) dq' / (dq' dq)`. From J = 0 the moves of single joints
//!    make it the difference quotient.
//! 2. For goal j, from the measured pose nearest to it: the step that brings `o + J dq` nearest to `X_j` within the limits
//!    and a box around the pose. The box halves when a step does not come nearer and doubles when it does.
//! 3. After three steps in a row that did not, the joints are moved in turn again around the best pose (a restart).
//!
//! A goal ends within the tolerance, when no step promises `max(tolerance / 4, 2 %)` of its distance, or when its restarts
//! or tries are used up. It never calls a goal out of reach, for all its restarts begin at the same pose. One linear model is believed at a time: far from where it was made it misleads, which is why
//! MODEL-IET fares better; this method shows by how much.
//!
//! Source: C. G. Broyden, "A class of methods for solving nonlinear simultaneous equations", Math. Comp. 19 (1965),
//! DOI 10.1090/S0025-5718-1965-0198670-6.

use super::planner::{GoalOutcome, NextTrial, RunSetup, Trial, WholeRun, WholeRunMethod};
use super::refine::{Local, refine};
use super::space::Space;
use super::steps::Targets;
use crate::distance::distance;
use crate::method::contract::{Effects, Method, Profile, SimulatorUse};
use crate::method::parameters::parameters;
use crate::world::WorldError;
use nalgebra::{DMatrix, DVector};

/// Steps in a row that come no nearer before the Jacobian is made anew.
const FAILURES: u32 = 3;
/// Weight of a step's length against the features, as a share of the Jacobian's mean squared column.
const DAMPING: f64 = 1e-4;
/// Evaluations of the linear model to find one step.
const STEPS: usize = 60;
/// Smallest step (rad, or the like share of a stroke) that teaches the Jacobian anything.
const LEAST_STEP: f64 = 1e-4;

parameters! {
    /// Parameters of the Broyden Gauss-Newton method.
    pub struct BroydenSpec {
        /// A goal is given up after this many trials of its own.
        pub max_tries: u32 = 15, in 1..=10_000;
        /// How often a goal's Jacobian may be made anew.
        pub restarts: u32 = 1;
        /// Size of the identification moves (of 180 degrees per stroke for prismatic joints).
        pub identification_deg: f64 = 25.0, in 0.1..=180.0, unit "degrees";
        /// Half the side of the largest box a step may be taken in (of 180 degrees per stroke for prismatic joints).
        pub longest_step_deg: f64 = 40.0, in 0.1..=360.0, unit "degrees";
        /// Largest step of a joint from one trial to the next (of 180 degrees per stroke for prismatic joints); any step if
        /// absent.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub max_step_deg: Option<f64> = None, in 0.1..=1e4, unit "degrees";
    }
}

impl Method for BroydenSpec {
    fn profile(&self) -> Profile {
        Profile { few_evaluations: false, ..Profile::whole_run(Effects::Smooth, SimulatorUse::Never) }
    }
}

/// A run of the Broyden Gauss-Newton method; its state is a function of its trials, in their order.
pub struct Broyden {
    spec: BroydenSpec,
    tolerance: f64,
    space: Space,
    goals: Vec<Vec<f64>>,
    log: Vec<Trial>,
    jacobian: DMatrix<f64>,
    /// The measured pose the next step is taken from.
    base: Option<usize>,
    /// Joints still to be moved in turn, the next one last.
    moves: Vec<usize>,
    goal: usize,
    tries: u32,
    failures: u32,
    restarts: u32,
    /// Half the side of the box around the base, rad.
    radius: f64,
    /// Observations lost in a row.
    lost: usize,
    next: NextTrial,
}

impl Broyden {
    /// A run for `goals` (n rows of m features) over `space`; a goal is reached within `tolerance` (features' unit).
    #[must_use]
    pub fn new(spec: BroydenSpec, tolerance: f64, space: Space, goals: Vec<Vec<f64>>) -> Self {
        let (m, d) = (goals.first().map_or(0, Vec::len), space.len());
        Self {
            radius: spec.longest_step_deg.to_radians(),
            next: NextTrial::Execute { joints: space.home(), goal: 0 },
            spec,
            tolerance,
            space,
            goals,
            log: Vec::new(),
            jacobian: DMatrix::zeros(m, d),
            base: None,
            moves: (0..d).rev().collect(),
            goal: 0,
            tries: 0,
            failures: 0,
            restarts: 0,
            lost: 0,
        }
    }

    /// The own trial nearest to a goal, and how near it is.
    fn nearest(&self, goal: usize) -> (Option<usize>, f64) {
        let seen = self.log.iter().enumerate().filter_map(|(i, t)| Some((i, t.observation.as_deref()?)));
        let misses = seen.map(|(i, observed)| (Some(i), distance(observed, &self.goals[goal])));
        misses.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((None, f64::INFINITY))
    }

    /// Broyden's update along the step from trial `from` to trial `to`.
    fn learn(&mut self, from: usize, to: usize) {
        let (from, to) = (&self.log[from], &self.log[to]);
        let (Some(before), Some(after)) = (&from.observation, &to.observation) else { return };
        let dq = DVector::from_fn(self.space.len(), |j, _| to.joints[j] - from.joints[j]);
        let longest = dq.iter().zip(&self.space.axes).map(|(q, axis)| q.abs() * axis.scale()).fold(0.0, f64::max);
        if longest < LEAST_STEP {
            return;
        }
        let seen = DVector::from_fn(before.len(), |k, _| after[k] - before[k]);
        let error = seen - &self.jacobian * &dq;
        self.jacobian.ger(1.0 / dq.norm_squared(), &error, &dq, 1.0);
    }

    /// Learns from a trial with an observation.
    fn judge(&mut self, trial: usize) {
        let Some(base) = self.base else {
            self.base = Some(trial);
            return;
        };
        self.learn(base, trial);
        if self.moves.pop().is_some() {
            if self.moves.is_empty() {
                self.base = self.nearest(self.goal).0;
            }
            return;
        }
        let miss = |t: &Trial| t.observation.as_ref().map_or(f64::INFINITY, |o| distance(o, &self.goals[self.goal]));
        let longest = self.spec.longest_step_deg.to_radians();
        if miss(&self.log[trial]) < miss(&self.log[base]) {
            self.base = Some(trial);
            self.radius = (2.0 * self.radius).min(longest);
            self.failures = 0;
        } else {
            self.radius *= 0.5;
            self.failures += 1;
        }
    }

    /// Goes on to the next goal.
    fn leave_goal(&mut self) {
        self.goal += 1;
        (self.tries, self.failures, self.restarts) = (0, 0, 0);
        self.radius = self.spec.longest_step_deg.to_radians();
        self.moves.clear();
        if self.goal < self.goals.len() {
            self.base = self.nearest(self.goal).0;
        }
    }

    /// The next proposal, moving on over goals that are done.
    fn plan(&mut self) -> NextTrial {
        let patience = FAILURES as usize * (self.space.len() + 1);
        if self.lost >= patience {
            return NextTrial::Finished;
        }
        while self.goal < self.goals.len() {
            let Some(base) = self.base else {
                return NextTrial::Execute { joints: self.space.home(), goal: self.goal };
            };
            let (_, best) = self.nearest(self.goal);
            if let (Some(&joint), true) = (self.moves.last(), best > self.tolerance || self.restarts == 0) {
                let step = self.spec.identification_deg.to_radians();
                let joints = self.space.moved(&self.log[base].joints, joint, step);
                return NextTrial::Execute { joints, goal: self.goal };
            }
            if best <= self.tolerance || self.tries >= self.spec.max_tries {
                self.leave_goal();
                continue;
            }
            if self.failures >= FAILURES {
                if self.restarts >= self.spec.restarts {
                    self.leave_goal();
                    continue;
                }
                self.restarts += 1;
                self.failures = 0;
                self.radius = self.spec.longest_step_deg.to_radians();
                self.moves = (0..self.space.len()).rev().collect();
                self.base = self.nearest(self.goal).0;
                continue;
            }
            let need = (0.25 * self.tolerance).max(0.02 * best);
            if let Some(joints) = self.step(base, best - need) {
                return NextTrial::Execute { joints, goal: self.goal };
            }
            self.leave_goal();
        }
        NextTrial::Finished
    }

    /// The best step from trial `base` by the linear model, if it promises a distance of at most `enough`.
    fn step(&self, base: usize, enough: f64) -> Option<Vec<f64>> {
        let from = &self.log[base].joints;
        let observed = self.log[base].observation.as_deref()?;
        let goal = &self.goals[self.goal];
        let mut around = self.space.clone();
        for (axis, q) in around.axes.iter_mut().zip(from) {
            let reach = self.radius / axis.scale();
            (axis.lower, axis.upper) = (axis.lower.max(q - reach), axis.upper.min(q + reach));
        }
        let squares = self.jacobian.tr_mul(&self.jacobian);
        let weight = DAMPING * squares.trace() / squares.nrows() as f64;
        let residual = |q: &[f64]| {
            let dq = DVector::from_fn(q.len(), |j, _| q[j] - from[j]);
            let residual = DVector::from_fn(goal.len(), |k, _| observed[k] - goal[k]) + &self.jacobian * &dq;
            (dq, residual)
        };
        let mut joints = from.clone();
        refine(&around, &mut joints, STEPS, &mut |q, bound, local: &mut Local| {
            let (dq, residual) = residual(q);
            local.value = residual.norm_squared() + weight * dq.norm_squared();
            let gradient = (self.jacobian.tr_mul(&residual) + weight * &dq) * 2.0;
            local.gradient.copy_from_slice(gradient.as_slice());
            let hessian = (&squares + DMatrix::identity(q.len(), q.len()) * weight) * 2.0;
            local.hessian.copy_from_slice(hessian.as_slice());
            local.value < bound
        });
        self.space.retreat(from, &mut joints);
        (residual(&joints).1.norm() <= enough).then_some(joints)
    }
}

impl WholeRunMethod for BroydenSpec {
    fn start(&self, run: &RunSetup<'_>) -> Result<Box<dyn WholeRun>, WorldError> {
        let Targets { goals, tolerance } = run.targets.clone();
        Ok(Box::new(Broyden::new(self.clone(), tolerance, run.space.clone(), goals)))
    }

    fn max_step_deg(&self) -> Option<f64> {
        self.max_step_deg
    }
}

impl WholeRun for Broyden {
    fn ask(&mut self) -> NextTrial {
        self.next.clone()
    }

    fn tell(&mut self, trial: Trial) {
        let is_observed = trial.observation.is_some();
        let is_step = self.moves.is_empty();
        self.log.push(trial);
        if is_step {
            self.tries += 1;
        }
        if is_observed {
            self.lost = 0;
            self.judge(self.log.len() - 1);
        } else {
            self.lost += 1;
            if is_step {
                self.radius *= 0.5;
            }
        }
        self.next = self.plan();
    }

    fn log(&self) -> &[Trial] {
        &self.log
    }

    fn outcomes(&mut self) -> Vec<GoalOutcome> {
        let outcome = |goal| {
            let (trial, miss) = self.nearest(goal);
            GoalOutcome { trial, distance: miss }
        };
        (0..self.goals.len()).map(outcome).collect()
    }

    fn is_used_up(&self, goal: usize) -> bool {
        let tries = self.log.iter().filter(|trial| trial.goal == goal).count();
        tries >= self.spec.max_tries as usize
    }
}

#[cfg(test)]
mod tests {
    use super::super::Axis;
    use super::*;
    use crate::method::per_goal::StopReason;
    use proptest::prelude::*;

    fn space(d: usize) -> Space {
        Space::new(vec![Axis { lower: -1.0, upper: 1.5, home: 0.1, revolute: true }; d])
    }

    fn finish(run: &mut Broyden, world: impl Fn(&[f64]) -> Option<Vec<f64>>) {
        while let NextTrial::Execute { joints, goal } = run.ask() {
            assert!(run.log.len() < 400, "it goes on for ever");
            run.tell(Trial { observation: world(&joints), cells: None, joints, goal });
        }
    }

    fn linear(q: &[f64]) -> Vec<f64> {
        vec![3.0 * q[0] - q[1] + 1.0, q[0] + 2.0 * q[1]]
    }

    #[test]
    fn a_linear_world_is_known_after_the_moves_and_takes_a_step_a_goal() {
        let goals = vec![vec![1.3, 0.9], vec![0.8, 1.4], vec![1.0, 0.2]];
        let mut run = Broyden::new(BroydenSpec::default(), 1e-2, space(2), goals);
        finish(&mut run, |q| Some(linear(q)));
        let expected = DMatrix::from_row_slice(2, 2, &[3.0, -1.0, 1.0, 2.0]);
        assert!((&run.jacobian - expected).norm() < 1e-9, "{}", run.jacobian);
        assert!(run.outcomes().iter().all(|o| o.distance <= 1e-2));
        assert!(run.log.len() <= 3 + 2 * 3, "{} trials", run.log.len());
    }

    #[test]
    fn a_goal_out_of_reach_costs_little_and_is_reported_with_its_residual() {
        let mut run = Broyden::new(BroydenSpec::default(), 0.01, space(2), vec![vec![9.0, 4.5]]);
        finish(&mut run, |q| Some(linear(q)));
        let outcome = run.outcomes()[0].clone();
        // nearest is q = (1.5, 0.5), which shows (5, 2.5)
        assert!(
            run.ended_by(0) == StopReason::NoImprovement && (outcome.distance - 20.0_f64.sqrt()).abs() < 1e-3,
            "{outcome:?}"
        );
        assert!(run.log.len() < 20, "{} trials", run.log.len());
    }

    #[test]
    fn a_world_that_shows_nothing_ends_the_run() {
        let mut run = Broyden::new(BroydenSpec::default(), 0.01, space(2), vec![vec![0.5, 0.5]]);
        finish(&mut run, |_| None);
        assert_eq!((run.log.len(), run.outcomes()[0].trial), (9, None));
    }

    #[test]
    fn a_jacobian_that_misleads_is_made_anew() {
        // the second feature turns back on itself
        let bent = |q: &[f64]| Some(vec![q[0], (3.0 * q[1]).sin()]);
        let spec = BroydenSpec { restarts: 2, ..BroydenSpec::default() };
        let mut run = Broyden::new(spec, 0.02, space(2), vec![vec![0.4, -0.9], vec![0.2, 0.95]]);
        finish(&mut run, bent);
        assert!(run.outcomes().iter().all(|o| o.distance <= 0.02), "{:?}", run.outcomes());
    }

    proptest! {
        #[test]
        fn proposals_stay_in_the_limits_and_follow_from_the_log(
            goals in prop::collection::vec(prop::collection::vec(-2.0..2.0_f64, 2), 1..5), lost in 0_usize..4
        ) {
            let fresh = || Broyden::new(BroydenSpec::default(), 0.05, space(2), goals.clone());
            let mut run = fresh();
            while let NextTrial::Execute { joints, goal } = run.ask() {
                prop_assert!(joints.iter().all(|q| (-1.0..=1.5).contains(q)));
                let mut resumed = fresh();
                run.log().iter().for_each(|t| resumed.tell(t.clone()));
                prop_assert_eq!(resumed.ask(), run.ask());
                let seen = vec![joints[0].sin() + joints[1].cos(), joints[0] * joints[1]];
                let observation = (run.log.len() % 4 >= lost).then_some(seen);
                run.tell(Trial { joints, observation, cells: None, goal });
                prop_assert!(run.log.len() < 400);
            }
        }
    }
}
