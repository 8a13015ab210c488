//! The bookkeeping of effects that accumulate (a share of a surface): what each trial gained, what was accepted.
//!
//! A gain is counted in steps of the action: the smallest rise between goals is 1. If the world can be put back, a
//! trial that gains one step is accepted (after two refused gains of more in a row, such a gain too); if not, every
//! trial stays. The current goal is the first one above the share observed.

use crate::CellSet;
use crate::method::contract::{Effects, Method, Profile, SimulatorUse};
use crate::method::parameters::parameters;
use crate::method::whole_run::{GoalOutcome, NextTrial, Trial};

parameters! {
    /// Parameters of SEARCH-IET.
    pub struct CoverSpec {
        /// The run gives up after this many evaluations.
        pub max_evaluations: u32 = 400, in 1..=100_000;
        /// Poses to choose from, spread evenly over the joints' ranges.
        pub poses: u32 = 2048, in 1..=4096;
        /// Largest step of a joint from one trial to the next (of 180 degrees per stroke for prismatic joints); any step if
        /// absent.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub max_step_deg: Option<f64> = None, in 0.1..=1e4, unit "degrees";
    }
}

impl Method for CoverSpec {
    fn profile(&self) -> Profile {
        Profile::whole_run(Effects::Accumulating, SimulatorUse::Never)
    }
}

/// The log of a run, with the trials accepted and the share reached.
#[derive(Debug, Clone)]
pub(in crate::method::whole_run) struct Ledger {
    spec: CoverSpec,
    /// Whether the world is put back between trials.
    resets: bool,
    goals: Vec<f64>,
    step: f64,
    pub log: Vec<Trial>,
    /// Indices of the accepted trials, in order.
    pub accepted: Vec<usize>,
    /// Share shown after the accepted trials, features' unit.
    level: f64,
    /// The cells shown then; empty if cells are not seen.
    cells: CellSet,
    /// The first trial that left the world as it was at the start.
    idle: Option<usize>,
    straight_overshoots: u32,
}

/// Effect of a trial.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::method::whole_run) struct TrialEffect {
    /// Steps gained over the accepted trials; `None` if the observation was lost.
    pub gain: Option<f64>,
    /// The cells gained; `None` if cells are not seen.
    pub fresh: Option<CellSet>,
    pub accepted: bool,
}

impl Ledger {
    pub fn new(spec: CoverSpec, resets: bool, goals: &[Vec<f64>]) -> Self {
        let goals: Vec<f64> = goals.iter().map(|g| g[0]).collect();
        let rises = goals.windows(2).map(|w| w[1] - w[0]).filter(|r| *r > 1e-9);
        let step = rises.fold(f64::INFINITY, f64::min);
        let step = if step.is_finite() { step } else { 1.0 };
        let level = goals.first().copied().unwrap_or(0.0).min(0.0);
        Self {
            spec,
            resets,
            goals,
            step,
            log: Vec::new(),
            accepted: Vec::new(),
            level,
            cells: CellSet::default(),
            idle: None,
            straight_overshoots: 0,
        }
    }

    /// The first goal above the share shown; `None` if all are reached.
    pub fn goal(&self) -> Option<usize> {
        self.goals.iter().position(|g| *g > self.level + 1e-6 * self.step)
    }

    pub fn is_over(&self) -> bool {
        self.goal().is_none() || self.is_used_up()
    }

    /// Whether the run's trials are used up.
    pub fn is_used_up(&self) -> bool {
        self.log.len() >= self.spec.max_evaluations as usize
    }

    pub fn propose(&self, joints: Vec<f64>) -> NextTrial {
        self.goal().map_or(NextTrial::Finished, |goal| NextTrial::Execute { joints, goal })
    }

    pub fn tell(&mut self, trial: Trial) -> TrialEffect {
        let seen = trial.observation.as_ref().map(|o| o[0]);
        let gain = seen.map(|s| (s - self.level) / self.step);
        let one = gain.is_some_and(|g| (g - 1.0).abs() < 0.5);
        let more = gain.is_some_and(|g| g >= 1.5);
        let accepted = !self.resets || one || (more && self.straight_overshoots >= 2);
        let fresh = trial.cells.as_ref().map(|cells| cells.difference(&self.cells));
        if self.accepted.is_empty() && gain.is_some_and(|g| g.abs() < 0.5) {
            self.idle = self.idle.or(Some(self.log.len()));
        }
        if accepted {
            self.accepted.push(self.log.len());
            self.level = seen.unwrap_or(self.level);
            if let Some(cells) = &trial.cells {
                self.cells.clone_from(cells);
            }
        }
        self.straight_overshoots = if more && !accepted { self.straight_overshoots + 1 } else { 0 };
        self.log.push(trial);
        TrialEffect { gain, fresh, accepted }
    }

    /// For each goal, the first accepted trial that shows it or more, or else the last accepted one; for goals that
    /// hold at the start, a trial that changed nothing.
    pub fn outcomes(&self) -> Vec<GoalOutcome> {
        let seen = |index: usize| self.log[index].observation.as_ref().map(|o| o[0]);
        let kept = self.idle.iter().chain(&self.accepted);
        let shown: Vec<(usize, f64)> = kept.filter_map(|&i| Some((i, seen(i)?))).collect();
        let slack = 1e-6 * self.step;
        let of = |goal: f64| {
            let found = shown.iter().find(|s| s.1 >= goal - slack).or(shown.last());
            let distance = found.map_or(f64::INFINITY, |s| (s.1 - goal).abs());
            GoalOutcome { trial: found.map(|s| s.0), distance, reached: distance < 0.5 * self.step }
        };
        self.goals.iter().map(|&goal| of(goal)).collect()
    }
}
