//! The contract of a search for one goal, by ask and tell, and of a method that begins such searches.

use super::batch::Batch;
use super::error::OptimizerError;
use super::provenance::{Provenance, StopReason, Tally};
use super::state::OptimizerState;

/// Outcome of a candidate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outcome<'a> {
    /// Executed.
    Observed {
        /// Discrepancy, smaller is better, finite.
        fitness: f64,
        /// The m features seen.
        observation: &'a [f64],
        /// Place of execution: a simulation or a robot.
        provenance: Provenance,
    },
    /// Judged without being executed: its fitness is a penalty.
    Penalised {
        /// The penalty, finite.
        fitness: f64,
    },
    /// Not allowed to be executed: the optimiser proposes another in its place, made in the same way.
    Rejected,
    /// Not executed or not observed, because something failed.
    Failed,
}

/// The best candidate so far.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Best<'a> {
    /// n genes, rad or m.
    pub joints: &'a [f64],
    /// Its discrepancy.
    pub fitness: f64,
    /// The m features seen.
    pub observation: &'a [f64],
    /// Origin of its fitness.
    pub provenance: Provenance,
}

/// Space that an optimiser searches, and the target at which it may stop early.
#[derive(Debug, Clone, PartialEq)]
pub struct SearchSpace {
    /// Lower limit of each gene.
    pub lower: Vec<f64>,
    /// Upper limit of each gene.
    pub upper: Vec<f64>,
    /// Number of features m of an observation.
    pub features: usize,
    /// Discrepancy that is good enough.
    pub target: Option<f64>,
    /// The previous goal's result (rad or m), from which some methods start.
    pub near: Option<Vec<f64>>,
}

/// A search for the joint vector of one goal.
pub trait Optimizer: Send {
    /// Adds candidates to `batch` until it is full or the next depends on outcomes still missing. Each candidate is
    /// proposed once, except after a resume: then those without an outcome are proposed again, in the same order.
    fn ask(&mut self, batch: &mut Batch);

    /// Takes the outcome of candidate `id`. Outcomes may come in any order; one of an unknown or settled candidate is
    /// ignored.
    fn tell(&mut self, id: u64, outcome: Outcome<'_>);

    /// The best candidate so far: an executed one, unless only penalised ones are known or an option lets others win.
    fn best(&self) -> Option<Best<'_>>;

    /// The reason why the search ended by its own rules; `None` while it goes on.
    fn stop(&self) -> Option<StopReason>;

    /// Everything needed to continue with the same bits.
    fn state(&self) -> OptimizerState;

    /// Number of generations completed; 0 for a method without generations.
    fn generation(&self) -> u64 {
        0
    }

    /// The individuals that candidate `id`, still without an outcome, was bred from; none for a random one.
    fn origins(&self, id: u64) -> [Option<&[f64]>; 2];

    /// Moves candidate `id`, still without an outcome, to `joints`.
    fn amend(&mut self, id: u64, joints: &[f64]);

    /// Count of fitness values that took no execution; executions are not counted here.
    fn tally(&self) -> Tally {
        Tally::default()
    }
}

/// A method that begins one search per goal.
pub trait PerGoalMethod: Send + Sync {
    /// A fresh search of `space`; `goal` separates the goals of one seed.
    ///
    /// # Errors
    /// [`OptimizerError::Parameter`] for a parameter out of its range.
    fn start(&self, space: SearchSpace, seed: u64, goal: u64) -> Result<Box<dyn Optimizer>, OptimizerError>;

    /// Resumes a saved search of `space`.
    ///
    /// # Errors
    /// [`OptimizerError`] if the state does not fit the method and the space.
    fn resume(&self, space: SearchSpace, state: OptimizerState) -> Result<Box<dyn Optimizer>, OptimizerError>;

    /// Whether a candidate that was never executed may be a goal's result.
    fn unexecuted_may_win(&self) -> bool {
        false
    }
}
