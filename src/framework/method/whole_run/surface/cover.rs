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

    /// For each goal, the accepted trial whose share is nearest, or the start. Nothing serves a goal as long as nothing was
    /// observed, unless all of them hold before any trial.
    pub fn outcomes(&self) -> Vec<GoalOutcome> {
        let shown = |&index: &usize| Some((Some(index), self.log[index].observation.as_ref()?[0] / self.cell));
        let steps: Vec<(Option<usize>, f64)> =
            std::iter::once((None, 0.0)).chain(self.accepted.iter().filter_map(shown)).collect();
        let is_unseen = self.log.iter().all(|trial| trial.observation.is_none());
        if is_unseen && !(self.log.is_empty() && self.goal().is_none()) {
            return vec![GoalOutcome { trial: None, distance: f64::INFINITY }; self.goals.len()];
        }
        let mut first = 0;
        let outcome = |goal: &f64| {
            let away = |step: usize| (steps[step].1 - goal).abs();
            first = (first..steps.len()).reduce(|best, step| if away(step) < away(best) { step } else { best })?;
            Some(GoalOutcome { trial: steps[first].0, distance: away(first) * self.cell })
        };
        self.goals.iter().filter_map(outcome).collect()
    }

    /// Smallest rise from one goal to the next, in cells; 0 if there is none.
    fn smallest_rise(&self) -> f64 {
        let rises = self.goals.windows(2).map(|pair| pair[1] - pair[0]).filter(|rise| *rise > SLACK);
        rises.reduce(f64::min).unwrap_or(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::Ledger;
    use crate::method::whole_run::Trial;
    use crate::world::Surface;
    use proptest::prelude::*;
    use rstest::rstest;

    fn ledger(cells: usize, resets: bool, goals: &[f64]) -> Ledger {
        let surface = Surface { columns: cells, rows: 1, resets, cells_seen: false };
        Ledger::new(None, surface, &goals.iter().map(|goal| vec![*goal]).collect::<Vec<_>>())
    }

    /// Tells that `cells` of the surface's are covered after a trial; returns whether it was accepted.
    fn tell(ledger: &mut Ledger, cells: f64) -> bool {
        let observation = Some(vec![cells * ledger.cell]);
        ledger.tell(Trial { joints: vec![cells], observation, cells: None, goal: 0 }).accepted
    }

    #[rstest]
    #[case::one_cell(&[0.0, 1.0, 2.0], 1.0)]
    #[case::the_nearest_to_a_goal_between_cells(&[0.0, 1.6, 3.0], 2.0)]
    #[case::a_goal_too_near_the_start_is_skipped(&[0.3, 1.0, 2.0], 1.0)]
    #[case::coarse_goals_leave_room(&[0.0, 40.0, 80.0], 50.0)]
    fn a_goal_asks_for_the_cells_up_to_it(#[case] goals: &[f64], #[case] asked: f64) {
        assert_eq!(ledger(100, true, goals).asked(), asked);
    }

    #[test]
    fn every_goal_is_served_by_the_nearest_share_and_the_first_by_the_start() {
        let mut ledger = ledger(100, true, &[0.0, 10.0, 20.0, 30.0]);
        assert!(tell(&mut ledger, 8.0) && tell(&mut ledger, 11.0) && tell(&mut ledger, 18.0));
        assert!(!tell(&mut ledger, 18.0), "nothing gained");
        assert!(tell(&mut ledger, 22.0));
        let outcomes = ledger.outcomes();
        let served: Vec<_> = outcomes.iter().map(|outcome| (outcome.trial, outcome.distance)).collect();
        assert_eq!(served, [(None, 0.0), (Some(1), 1.0), (Some(2), 2.0), (Some(4), 8.0)]);
    }

    #[test]
    fn nothing_observed_serves_nothing() {
        let mut ledger = ledger(4, true, &[0.0, 25.0]);
        ledger.tell(Trial { joints: vec![0.0], observation: None, cells: None, goal: 1 });
        assert!(ledger.outcomes().iter().all(|outcome| outcome.trial.is_none() && outcome.distance.is_infinite()));
    }

    #[test]
    fn goals_that_hold_before_any_trial_are_served_by_the_start() {
        let ledger = ledger(4, true, &[0.0, 0.0]);
        assert!(ledger.is_over());
        assert!(ledger.outcomes().iter().all(|outcome| outcome.trial.is_none() && outcome.distance == 0.0));
    }

    #[rstest]
    #[case(4, 400)]
    #[case(600, 2400)]
    #[case(1 << 20, 10_000)]
    fn large_surfaces_get_more_evaluations(#[case] cells: usize, #[case] limit: usize) {
        assert_eq!(ledger(cells, true, &[100.0]).limit, limit);
    }

    proptest! {
        /// A tool that always covers several cells, on goals of one cell each: refusals end, so that the run goes on.
        #[test]
        fn big_gains_are_not_refused_for_ever(gains in prop::collection::vec(2_u32..9, 40)) {
            let goals: Vec<f64> = (0..=100).map(f64::from).collect();
            let mut ledger = ledger(100, true, &goals);
            let mut shown = 0.0;
            for gain in gains {
                let more = f64::min(shown + f64::from(gain), 100.0);
                if tell(&mut ledger, more) {
                    shown = more;
                }
            }
            prop_assert!(shown > 60.0, "{shown} cells");
        }

        #[test]
        fn trials_serve_goals_in_order_and_the_nearest_serves_each(
            goals in prop::collection::vec(0.0..100.0_f64, 1..12),
            gains in prop::collection::vec(0_u32..9, 1..40),
        ) {
            let mut ledger = ledger(100, true, &goals);
            let mut shown = 0.0;
            for gain in gains {
                let more = f64::min(shown + f64::from(gain), 100.0);
                if tell(&mut ledger, more) {
                    shown = more;
                }
            }
            let outcomes = ledger.outcomes();
            prop_assert!(outcomes.iter().map(|outcome| outcome.trial).is_sorted());
            for (goal, outcome) in goals.iter().zip(&outcomes) {
                let shown = outcome.trial.map_or(0.0, |index| ledger.log[index].joints[0]);
                prop_assert!((outcome.distance - (shown - goal).abs()).abs() < 1e-9);
            }
        }
    }
}
