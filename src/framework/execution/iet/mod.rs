//! IET, Incrementally Evolved Trajectories (paper algorithm 1): one run of one seed, sans-I/O.
//!
//! For goal j an optimiser searches U_j. A candidate is judged by the discrepancy of O_1..O_j against X_1..X_j after
//! re-executing [`Iet::prefix`] U_1..U_j-1 and then the candidate; the best is appended. The machine asks for
//! candidates to be executed ([`Iet::ask`]) and takes observation vectors ([`Iet::tell`]); it knows neither world nor
//! clock.
//!
//! # Invariants
//! - Result bits depend on problem and seed only: not on batch sizes, saves and resumes, or threads.
//! - A method that plans the whole run proposes one pose at a time, and its results appear together at the end.

mod start;
mod tell;

use super::discrepancy::PartialDiscrepancy;
use super::error::ProblemError;
use super::goal_search::GoalSearch;
use super::path::{PathPose, along_goals};
use super::result::{GoalResult, Progress, RunResult, digest};
use super::setup::Setup;
use super::state::GoalState;
use super::whole_run_driver::WholeRunDriver;
use crate::method::per_goal::{Batch, PerGoalMethod};
use crate::method::whole_run::{NextTrial, Trial};
use crate::robot::Chain;
use crate::world::{self, World};

/// Candidate id for executing a winner that was never executed.
const CONFIRMATION: u64 = u64::MAX;

/// The search for the joints.
enum Search {
    /// One search per goal; `goal` is `None` exactly when the run is finished.
    PerGoal { method: Box<dyn PerGoalMethod>, goal: Option<GoalSearch> },
    /// All goals at once.
    WholeRun(WholeRunDriver),
}

/// One run of a problem.
pub struct Iet {
    setup: Setup,
    seed: u64,
    discrepancy: PartialDiscrepancy,
    search: Search,
    goal: GoalState,
    /// [`RunResult::painted_percent`] up to the last finished goal.
    painted: Option<f64>,
    results: Vec<GoalResult>,
    evaluations: u64,
    /// Scratch space for the goals' m features of an observation.
    seen: Vec<f64>,
}

impl Iet {
    /// The driver of a method that plans the whole run.
    fn driver(&self) -> Option<&WholeRunDriver> {
        if let Search::WholeRun(driver) = &self.search { Some(driver) } else { None }
    }

    /// The chain whose joints are searched.
    #[must_use]
    pub fn chain(&self) -> &Chain {
        &self.setup.chain
    }

    /// Whether the method plans the whole run: such a method proposes one pose at a time and may compute long for each.
    #[must_use]
    pub fn plans_whole_run(&self) -> bool {
        self.driver().is_some()
    }

    /// The seed of this run.
    #[must_use]
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// The simulated world of this run, as described or disturbed (`reality` of the problem).
    ///
    /// # Errors
    /// [`ProblemError::World`]; cannot occur for a run that could be created.
    pub fn world(&self) -> Result<Box<dyn World>, ProblemError> {
        let reality = self.setup.spec.reality.as_ref();
        Ok(world::simulated(&self.setup.world, reality, &self.setup.chain, self.seed)?)
    }

    /// Poses to execute, in order, before each candidate: U_1..U_j-1, or the accepted poses of a method that plans the
    /// whole run.
    pub fn prefix(&self) -> impl Iterator<Item = &[f64]> {
        let accepted = self.driver().into_iter().flat_map(WholeRunDriver::prefix);
        let results = if self.plans_whole_run() { &[] } else { self.results.as_slice() };
        accepted.chain(results.iter().map(|r| r.joints.as_slice()))
    }

    /// All trials so far of a method that plans the whole run; a later run on the same robot may start from them.
    #[must_use]
    pub fn log(&self) -> &[Trial] {
        self.driver().map_or(&[], WholeRunDriver::log)
    }

    /// Whether every goal has ended.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.results.len() == self.setup.goals.len()
    }

    /// Goal the next candidates are for, from 0; the number of goals once the run is finished.
    #[must_use]
    pub fn goal_index(&self) -> usize {
        if self.is_finished() {
            return self.results.len();
        }
        self.driver().map_or(self.results.len(), WholeRunDriver::goal)
    }

    /// Number of features of the world, and so of values in an observation.
    #[must_use]
    pub fn world_features(&self) -> usize {
        self.setup.world_features
    }

    /// Adds candidates of the current goal to `batch`; none if the run is finished.
    ///
    /// If a goal's winner was never executed, it is requested once more to measure its true discrepancy. An empty batch
    /// of an unfinished run means that the goal ended without execution: tell no observations, then bring the world to
    /// the grown [`Iet::prefix`] and ask again.
    pub fn ask(&mut self, batch: &mut Batch) {
        match &mut self.search {
            Search::WholeRun(driver) => {
                if let (NextTrial::Execute { joints, .. }, false) = (&driver.next, batch.is_full()) {
                    batch.push(self.evaluations, joints);
                }
            }
            Search::PerGoal { goal: None, .. } => {}
            Search::PerGoal { goal: Some(search), .. } => {
                if self.goal.ended.is_none() {
                    search.ask(batch);
                }
                if batch.is_empty()
                    && self.goal.ended.or(search.stop()).is_some()
                    && let Some(best) = search.best()
                    && !best.provenance.is_executed()
                {
                    batch.push(CONFIRMATION, best.joints);
                }
            }
        }
    }

    /// Progress of the run.
    #[must_use]
    pub fn progress(&self) -> Progress {
        Progress {
            goal_index: self.goal_index(),
            goals: self.setup.goals.len(),
            evaluations: self.evaluations,
            goal_evaluations: if self.is_finished() { 0 } else { self.goal.evaluations },
            best_discrepancy: if self.is_finished() { None } else { self.goal.best },
            finished: self.is_finished(),
            results: self.results.clone(),
        }
    }

    /// Number of evaluations over all goals so far.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// Returns the finished run.
    ///
    /// # Errors
    /// [`ProblemError::Unfinished`] before the last goal has ended.
    pub fn finish(mut self) -> Result<RunResult, ProblemError> {
        let goals = self.setup.goals.len();
        let path = if self.is_finished() { self.path() } else { Vec::new() };
        let unfinished = ProblemError::Unfinished { goal: self.results.len(), goals };
        let Some(last) = self.results.last().filter(|_| self.is_finished()) else { return Err(unfinished) };
        let (discrepancy, true_discrepancy, valid) = (last.discrepancy, last.true_discrepancy, last.feasible);
        let estimate = match &mut self.search {
            Search::WholeRun(driver) => driver.estimate(&self.setup, &self.results, self.seed),
            Search::PerGoal { .. } => None,
        };
        Ok(RunResult {
            seed: self.seed,
            evaluations: self.evaluations,
            discrepancy,
            true_discrepancy,
            estimate,
            valid,
            painted_percent: self.painted,
            tally: self.results.iter().map(|goal| goal.tally).sum(),
            digest: digest(&self.results),
            goals: self.results,
            path,
        })
    }

    fn path(&mut self) -> Vec<PathPose> {
        match &mut self.search {
            Search::WholeRun(driver) => driver.path(&self.setup, &self.results),
            Search::PerGoal { .. } => along_goals(self.results.iter().map(GoalResult::executed)),
        }
    }
}
