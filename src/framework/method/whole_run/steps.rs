//! Decorator that keeps a whole-run method inside the allowed region and within one bounded step of the previous pose.
//!
//! A proposed pose that is allowed and close enough is passed on unchanged. Otherwise the trial goes as far towards it
//! as one step allows, to an allowed pose. If there is no allowed pose within one step, the run ends, and the goals
//! not reached are stopped short. The previous pose is normally that of the last trial; if the world is reset, the robot
//! returns to its start and repeats the accepted poses, and the last of them is the previous pose.
//!
//! If consecutive *goals* may be at most one step apart, the result is the sequence of measured poses with the smallest
//! sum of squared distances from the goals that respects this limit (dynamic programming over goals and trials).

use super::space::Space;
use super::{Believed, GoalOutcome, NextTrial, Trial, WholeRun};
use crate::distance::squared_distance;
use crate::random::RandomStream;

/// Number of poses tried around a blocked one, per spread.
const CLOUD: usize = 300;
/// Spreads of these poses, rad.
const SPREADS: [f64; 4] = [0.05, 0.2, 0.6, 2.0];
/// Shares of the way that are tried, in tenths.
const SHARES: u32 = 10;

/// Limits on the robot's steps.
#[derive(Debug, Clone, PartialEq)]
pub struct StepLimits {
    /// Largest step of each of the d joints from one trial to the next, rad or m; infinite for no limit.
    pub per_trial: Vec<f64>,
    /// Largest step of any joint from one goal's pose to the next goal's, rad or m; `None` for no limit.
    pub per_goal: Option<f64>,
    /// Pose of the robot before the first trial; `None` if the first trial is not limited.
    pub start: Option<Vec<f64>>,
    /// Whether the accepted poses are executed again before each trial.
    pub repeats: bool,
}

/// Goals of a run and the tolerance within which they are reached.
#[derive(Debug, Clone, PartialEq)]
pub struct Targets {
    /// Goals, n rows of m features.
    pub goals: Vec<Vec<f64>>,
    /// Largest distance at which a goal counts as reached, features' unit.
    pub tolerance: f64,
}

/// A whole-run method restricted to its limits.
pub struct Stepped {
    inner: Box<dyn WholeRun>,
    space: Space,
    limits: StepLimits,
    targets: Targets,
    seed: u64,
}

impl Stepped {
    /// Restricts `inner`, which searches `space`, to `limits`.
    #[must_use]
    pub fn new(inner: Box<dyn WholeRun>, space: Space, limits: StepLimits, targets: Targets, seed: u64) -> Self {
        Self { inner, space, limits, targets, seed }
    }

    fn before(&self) -> Option<&[f64]> {
        let log = self.inner.log();
        let last = if self.limits.repeats { self.inner.accepted().last().map(|&i| &log[i]) } else { log.last() };
        last.map(|trial| trial.joints.as_slice()).or(self.limits.start.as_deref())
    }

    fn may(&self, from: Option<&[f64]>, to: &[f64]) -> bool {
        let near =
            |from: &[f64]| to.iter().zip(from).zip(&self.limits.per_trial).all(|((t, f), l)| (t - f).abs() <= *l);
        from.is_none_or(near) && self.space.allows(to)
    }

    /// The closest pose to `wanted` found that the robot may take; `None` if there is none.
    fn nearest(&self, wanted: &[f64]) -> Option<Vec<f64>> {
        let from = self.before();
        let reach = from.map_or_else(|| wanted.to_vec(), |from| self.capped(from, wanted));
        if let Some(from) = from {
            for share in (1..=SHARES).rev().map(|s| f64::from(s) / f64::from(SHARES)) {
                let pose: Vec<f64> = from.iter().zip(&reach).map(|(f, r)| f + (r - f) * share).collect();
                let is_new = self.inner.log().iter().all(|trial| trial.joints != pose);
                if is_new && self.may(Some(from), &pose) {
                    return Some(pose);
                }
            }
        }
        let mut random = RandomStream::of_run(!self.seed, self.inner.log().len() as u64 + 1);
        let mut pose = vec![0.0; wanted.len()];
        let mut best: Option<(f64, Vec<f64>)> = None;
        for spread in SPREADS {
            for _ in 0..CLOUD {
                self.space.near(&reach, spread, &mut random, &mut pose);
                if let Some(from) = from {
                    pose = self.capped(from, &pose);
                }
                let way = self.way(&pose, wanted);
                if best.as_ref().is_none_or(|b| way < b.0) && self.may(from, &pose) {
                    best = Some((way, pose.clone()));
                }
            }
            if best.is_some() {
                break;
            }
        }
        best.map(|b| b.1)
    }

    /// `to`, or the last pose on the straight way there within one step of `from`.
    fn capped(&self, from: &[f64], to: &[f64]) -> Vec<f64> {
        let ways = to.iter().zip(from).map(|(t, f)| (t - f).abs());
        let share = ways.zip(&self.limits.per_trial).filter(|(way, limit)| way > *limit).map(|(w, l)| l / w);
        // Slightly less than the whole step, so that rounding cannot make it longer.
        let share = share.fold(1.0, |a: f64, b| a.min(b * (1.0 - 1e-12)));
        from.iter().zip(to).map(|(f, t)| if share < 1.0 { f + (t - f) * share } else { *t }).collect()
    }

    fn way(&self, a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).zip(&self.space.axes).map(|((x, y), axis)| ((x - y) * axis.scale()).powi(2)).sum()
    }

    /// The measured poses, one per goal, that lie within `limit` of one another and nearest to the goals.
    fn linked(&self, limit: f64) -> Option<Vec<GoalOutcome>> {
        let log = self.inner.log();
        let observed: Vec<(usize, &Trial, &[f64])> =
            log.iter().enumerate().filter_map(|(i, t)| Some((i, t, t.observation.as_deref()?))).collect();
        let within = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(x, y)| (x - y).abs() <= limit);
        // cost[t]: smallest sum over the goals so far if trial t serves the last one; chosen[goal][t]: the trial before
        // it.
        let mut cost: Vec<f64> = observed
            .iter()
            .map(|(_, t, _)| {
                let starts = self.limits.start.as_ref().is_none_or(|start| within(start, &t.joints));
                if starts { 0.0 } else { f64::INFINITY }
            })
            .collect();
        let mut chosen: Vec<Vec<usize>> = Vec::with_capacity(self.targets.goals.len());
        for (index, goal) in self.targets.goals.iter().enumerate() {
            let best_before = |t: usize| {
                let near = (0..observed.len()).filter(|&b| {
                    index == 0 && b == t || index > 0 && { within(&observed[b].1.joints, &observed[t].1.joints) }
                });
                near.min_by(|&a, &b| cost[a].total_cmp(&cost[b])).unwrap_or(t)
            };
            let before: Vec<usize> = (0..observed.len()).map(best_before).collect();
            cost = (0..observed.len()).map(|t| cost[before[t]] + squared_distance(goal, observed[t].2)).collect();
            chosen.push(before);
        }
        let mut at = (0..observed.len()).min_by(|&a, &b| cost[a].total_cmp(&cost[b]))?;
        let mut outcomes = Vec::with_capacity(chosen.len());
        for (goal, before) in self.targets.goals.iter().zip(&chosen).rev() {
            let distance = squared_distance(goal, observed[at].2).sqrt();
            outcomes.push(GoalOutcome { trial: Some(observed[at].0), distance });
            at = before[at];
        }
        outcomes.reverse();
        Some(outcomes)
    }

    fn is_linked(&self, outcomes: &[GoalOutcome], limit: f64) -> bool {
        let poses = outcomes.iter().filter_map(|o| Some(self.inner.log()[o.trial?].joints.as_slice()));
        let poses: Vec<&[f64]> = self.limits.start.as_deref().into_iter().chain(poses).collect();
        poses.windows(2).all(|w| w[0].iter().zip(w[1]).all(|(a, b)| (a - b).abs() <= limit))
    }
}

impl WholeRun for Stepped {
    fn ask(&mut self) -> NextTrial {
        let NextTrial::Execute { joints, goal } = self.inner.ask() else { return NextTrial::Finished };
        if self.may(self.before(), &joints) {
            return NextTrial::Execute { joints, goal };
        }
        self.nearest(&joints).map_or(NextTrial::Finished, |joints| NextTrial::Execute { joints, goal })
    }

    fn tell(&mut self, trial: Trial) {
        self.inner.tell(trial);
    }

    fn log(&self) -> &[Trial] {
        self.inner.log()
    }

    fn accepted(&self) -> &[usize] {
        self.inner.accepted()
    }

    fn is_used_up(&self, goal: usize) -> bool {
        self.inner.is_used_up(goal)
    }

    fn believed(&mut self, poses: &[&[f64]]) -> Option<Vec<Believed>> {
        self.inner.believed(poses)
    }

    fn has_restarted(&mut self, goal: usize) -> bool {
        self.inner.has_restarted(goal)
    }

    fn outcomes(&mut self) -> Vec<GoalOutcome> {
        let outcomes = self.inner.outcomes();
        match self.limits.per_goal {
            Some(limit) if self.inner.accepted().is_empty() && !self.is_linked(&outcomes, limit) => {
                self.linked(limit).unwrap_or(outcomes)
            }
            _ => outcomes,
        }
    }
}
