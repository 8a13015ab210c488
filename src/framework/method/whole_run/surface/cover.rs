//! The bookkeeping of effects that accumulate (a share of a surface): what each trial gained, what was accepted.
//!
//! # Architecture Invariants
//! - A gain is counted in cells of the surface.
//! - If the world can be put back, every trial that gains something is accepted, except one that gains more than the
//!   next goal asks for, while trials that gain less can be had; if it cannot, every trial stays.
//! - The current goal is the first that the accepted trials have not come within half a cell of.
//! - A goal is served by the accepted trial whose share is nearest to it, or by the start, if that is nearest, never by
//!   an earlier trial than the goal before.

use crate::CellSet;
use crate::method::contract::{Effects, Method, Profile, SimulatorUse};
use crate::method::parameters::parameters;
use crate::method::whole_run::{GoalOutcome, NextTrial, Trial};
use crate::world::Surface;

/// Share of a surface that is wholly covered, %.
const WHOLE: f64 = 100.0;
/// Evaluations after which a run gives up, unless its parameters say otherwise: the fewest, the most, and per cell.
const FEWEST: usize = 400;
const MOST: usize = 10_000;
const PER_CELL: usize = 4;
/// This many gains in a row that are more than the goal asks for are refused at most.
const STRAIGHT: u32 = 2;
/// Number of refusals that a gain that fits gives the right to, and the most that are kept.
const EARNED: u32 = 3;
const PATIENCE: u32 = 6;
/// How far a trial may go beyond a goal, as a share of the smallest rise between goals.
const BEYOND: f64 = 0.25;
/// Rounding of shares, in cells.
const SLACK: f64 = 1e-6;

parameters! {
    /// Parameters of SEARCH-IET.
    pub struct CoverSpec {
        /// The run gives up after this many evaluations; if absent, after 4 per cell of the surface, at least 400 and at most
        /// 10000.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub max_evaluations: Option<u32> = None, in 1..=100_000;
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
    /// Evaluations after which the run gives up.
    limit: usize,
    /// Whether the world is put back between trials.
    resets: bool,
    /// The goals' shares, in cells.
    goals: Vec<f64>,
    /// Share of one cell, features' unit.
    cell: f64,
    pub log: Vec<Trial>,
    /// Indices of the accepted trials, in order.
    pub accepted: Vec<usize>,
    /// Number of cells shown after the accepted trials.
    level: f64,
    /// The cells shown then; empty if cells are not seen.
    cells: CellSet,
    /// Number of refused trials since the last that was not.
    straight: u32,
    /// Number of gains of more than the goal asks for that may still be refused.
    patience: u32,
    /// Number of trials since the last one that gained something.
    misses: u32,
}

/// Effect of a trial.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::method::whole_run) struct TrialEffect {
    /// Cells gained over the accepted trials; `None` if the observation was lost.
    pub gain: Option<f64>,
    /// The cells gained; `None` if cells are not seen.
    pub fresh: Option<CellSet>,
    pub accepted: bool,
}

impl Ledger {
    /// An empty log for `goals` (n rows, the share in the first column) on `surface`.
    pub fn new(max_evaluations: Option<u32>, surface: Surface, goals: &[Vec<f64>]) -> Self {
        let cells = surface.cells().max(1);
        let cell = WHOLE / cells as f64;
        let limit = max_evaluations.map_or((PER_CELL * cells).clamp(FEWEST, MOST), |limit| limit as usize);
        Self {
            limit,
            resets: surface.resets,
            goals: goals.iter().map(|goal| goal[0] / cell).collect(),
            cell,
            log: Vec::new(),
            accepted: Vec::new(),
            level: 0.0,
            cells: CellSet::default(),
            straight: 0,
            patience: PATIENCE,
            misses: 0,
        }
    }

    /// The first goal that the share shown is not yet as near to as whole cells can be; `None` if there is none.
    pub fn goal(&self) -> Option<usize> {
        self.goals.iter().position(|goal| goal - self.level >= 0.5 - SLACK)
    }

    /// The largest number of cells that the current goal asks for, at least 1: as many as bring the share nearest to it,
    /// or beyond it by a quarter of the smallest rise between goals.
    pub fn asked(&self) -> f64 {
        let rise = self.goal().map_or(1.0, |goal| self.goals[goal] - self.level);
        (rise + (BEYOND * self.smallest_rise()).max(0.5) + SLACK).floor().max(1.0)
    }

    /// Number of trials since the last one that gained something.
    pub fn misses(&self) -> u32 {
        self.misses
    }

    pub fn is_over(&self) -> bool {
        self.goal().is_none() || self.is_used_up()
    }

    /// Whether the run's trials are used up.
    pub fn is_used_up(&self) -> bool {
        self.log.len() >= self.limit
    }

    pub fn propose(&self, joints: Vec<f64>) -> NextTrial {
        self.goal().map_or(NextTrial::Finished, |goal| NextTrial::Execute { joints, goal })
    }

    pub fn tell(&mut self, trial: Trial) -> TrialEffect {
        let shown = trial.observation.as_ref().map(|seen| seen[0] / self.cell);
        let gain = shown.map(|shown| shown - self.level);
        let is_hit = gain.is_some_and(|gain| gain >= 0.5);
        let is_more = gain.is_some_and(|gain| gain >= self.asked() + 0.5);
        let accepted = !self.resets || (is_hit && !(is_more && self.refuses()));
        let fresh = trial.cells.as_ref().map(|cells| cells.difference(&self.cells));
        if accepted {
            self.accepted.push(self.log.len());
            self.level = shown.unwrap_or(self.level);
            if let Some(cells) = &trial.cells {
                self.cells.clone_from(cells);
            }
        }
        self.misses = if is_hit { 0 } else { self.misses + 1 };
        let is_refused = is_more && !accepted;
        self.straight = if is_refused { self.straight + 1 } else { 0 };
        if is_refused {
            self.patience -= 1;
        } else if is_hit && !is_more {
            self.patience = (self.patience + EARNED).min(PATIENCE);
        }
        self.log.push(trial);
        TrialEffect { gain, fresh, accepted }
    }

    /// Whether a gain of more than the goal asks for is refused, in the hope of one that fits.
    fn refuses(&self) -> bool {
        self.straight < STRAIGHT && self.patience > 0
    }

    /// For each goal, the accepted trial whose share is nearest, or the start. A goal is reached if that is as near as
    /// whole cells can be, or if the share has passed the goal at less than half of the smallest rise between goals.
    /// Nothing serves a goal as long as nothing was observed.
    pub fn outcomes(&self) -> Vec<GoalOutcome> {
        let shown = |&index: &usize| Some((Some(index), self.log[index].observation.as_ref()?[0] / self.cell));
        let steps: Vec<(Option<usize>, f64)> =
            std::iter::once((None, 0.0)).chain(self.accepted.iter().filter_map(shown)).collect();
        if self.log.iter().all(|trial| trial.observation.is_none()) {
            return vec![GoalOutcome { trial: None, distance: f64::INFINITY, reached: false }; self.goals.len()];
        }
        let near = 0.5 * self.smallest_rise();
        let mut first = 0;
        let mut outcome = |goal: &f64| {
            let away = |step: usize| (steps[step].1 - goal).abs();
            first = (first..steps.len()).reduce(|best, step| if away(step) < away(best) { step } else { best })?;
            let is_passed = self.level >= goal - 0.5 - SLACK;
            let reached = away(first) <= 0.5 + SLACK || (is_passed && away(first) < near);
            Some(GoalOutcome { trial: steps[first].0, distance: away(first) * self.cell, reached })
        };
        self.goals.iter().filter_map(|goal| outcome(goal)).collect()
    }

    /// Smallest rise from one goal to the next, in cells; 0 if there is none.
    fn smallest_rise(&self) -> f64 {
        let rises = self.goals.windows(2).map(|pair| pair[1] - pair[0]).filter(|rise| *rise > SLACK);
        rises.reduce(f64::min).unwrap_or(0.0)
    }
}
