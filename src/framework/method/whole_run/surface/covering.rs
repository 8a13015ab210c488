//! The common part of the methods that cover a surface: the ledger answers everything but the next pose.

use super::cover::Ledger;
use crate::method::whole_run::planner::{GoalOutcome, NextTrial, Trial, WholeRun};

/// A method that covers a surface, told apart by the pose it tries next. Every one is a [`WholeRun`].
pub(in crate::method::whole_run) trait Covering: Send {
    /// The trials so far and the goals they reached.
    fn ledger(&self) -> &Ledger;

    /// The pose to try next (rad or m); `None` if no pose promises anything.
    fn pose(&mut self) -> Option<Vec<f64>>;

    /// Enters a trial into the ledger and learns from it.
    fn learn(&mut self, trial: Trial);
}

impl<C: Covering> WholeRun for C {
    fn ask(&mut self) -> NextTrial {
        if self.ledger().is_over() {
            return NextTrial::Finished;
        }
        self.pose().map_or(NextTrial::Finished, |joints| self.ledger().propose(joints))
    }

    fn tell(&mut self, trial: Trial) {
        self.learn(trial);
    }

    fn log(&self) -> &[Trial] {
        &self.ledger().log
    }

    fn accepted(&self) -> &[usize] {
        &self.ledger().accepted
    }

    fn outcomes(&mut self) -> Vec<GoalOutcome> {
        self.ledger().outcomes()
    }

    fn is_used_up(&self, _: usize) -> bool {
        self.ledger().is_used_up()
    }
}
