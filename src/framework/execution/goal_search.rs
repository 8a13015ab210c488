//! The search for one goal: an optimiser and, if there are constraints, the judge between it and the world.

use crate::constraint::{Judge, JudgeState};
use crate::method::per_goal::{Batch, Best, Optimizer, OptimizerState, Outcome, StopReason, Tally};

/// An optimiser at work on one goal.
pub(super) struct GoalSearch {
    optimizer: Box<dyn Optimizer>,
    judge: Option<Box<Judge>>,
}

impl GoalSearch {
    pub fn new(optimizer: Box<dyn Optimizer>, judge: Option<Judge>) -> Self {
        Self { optimizer, judge: judge.map(Box::new) }
    }

    /// Fills `batch` with candidates that may be executed.
    pub fn ask(&mut self, batch: &mut Batch) {
        match &mut self.judge {
            Some(judge) => judge.ask(self.optimizer.as_mut(), batch),
            None => self.optimizer.ask(batch),
        }
    }

    /// Takes the outcome of candidate `id`.
    pub fn tell(&mut self, id: u64, outcome: Outcome<'_>) {
        match &mut self.judge {
            Some(judge) => judge.tell(self.optimizer.as_mut(), id, outcome),
            None => self.optimizer.tell(id, outcome),
        }
    }

    /// The best candidate so far that may be the goal's result.
    pub fn best(&self) -> Option<Best<'_>> {
        match &self.judge {
            Some(judge) => judge.best(self.optimizer.as_ref()),
            None => self.optimizer.best(),
        }
    }

    /// Reason for which the search has ended by its own rules; `None` while it goes on.
    pub fn stop(&self) -> Option<StopReason> {
        match &self.judge {
            Some(judge) => judge.stop(self.optimizer.as_ref()),
            None => self.optimizer.stop(),
        }
    }

    /// Whether candidate `id` (asked and not told) may be the goal's result.
    pub fn is_feasible(&self, id: u64) -> bool {
        self.judge.as_ref().is_none_or(|judge| judge.is_feasible(id))
    }

    /// The smallest violations of an infeasible candidate so far, one per constraint (m or rad).
    pub fn nearest_violations(&self) -> Option<&[f64]> {
        self.judge.as_deref().and_then(Judge::nearest_violations)
    }

    /// Number of fitness values so far that were not evaluations, by origin.
    pub fn tally(&self) -> Tally {
        match &self.judge {
            Some(judge) => judge.tally(self.optimizer.as_ref()),
            None => self.optimizer.tally(),
        }
    }

    /// State from which a resumed search continues bit for bit.
    pub fn state(&self) -> (OptimizerState, Option<JudgeState>) {
        (self.optimizer.state(), self.judge.as_ref().map(|judge| judge.state().clone()))
    }
}
