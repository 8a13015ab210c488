//! The contract of a search for one goal, by ask and tell, and of a method that begins such searches.

use super::batch::Batch;
use super::error::OptimizerError;
use super::provenance::{Provenance, StopReason, Tally};
use super::state::OptimizerState;

/// What became of a candidate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outcome<'a> {
    /// It was executed.
    Observed {
        /// Discrepancy, smaller is better, finite.
        fitness: f64,
        /// The m features seen.
        observation: &'a [f64],
        /// Where it was executed.
        provenance: Provenance,
    },
    /// It was judged without executing: its fitness is a penalty.
    Penalised {
        /// The penalty, finite.
        fitness: f64,
    },
    /// It may not be executed: another takes its place, made in the same way, as if this one had never been.
    Rejected,
    /// It could not be executed or observed.
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
    /// Where its fitness comes from.
    pub provenance: Provenance,
}

/// What an optimiser searches in and when it may stop early.
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
    /// The previous goal's result (rad or m): where a method that can do so begins.
    pub near: Option<Vec<f64>>,
}

/// A search for the joint vector of one goal.
pub trait Optimizer: Send {
    /// Adds candidates to `batch` until it is full or none can be named before others are told. Each is named once,
    /// except after a resume: then those never told are named again, in the same order.
    fn ask(&mut self, batch: &mut Batch);

    /// Takes what became of candidate `id`; any subset of the asked, in any order. An id not waited for is ignored:
    /// it is late news of a candidate told before.
    fn tell(&mut self, id: u64, outcome: Outcome<'_>);

    /// The best candidate so far: executed, unless only penalised ones are known or an option lets others win.
    fn best(&self) -> Option<Best<'_>>;

    /// Why the search has ended by its own rules, if it has.
    fn stop(&self) -> Option<StopReason>;

    /// Everything needed to go on with the same bits.
    fn state(&self) -> OptimizerState;

    /// Generations ended so far; 0 where a method has none.
    fn generation(&self) -> u64 {
        0
    }

    /// The individuals candidate `id` (asked and not told) was bred from; none for a random one.
    fn origins(&self, id: u64) -> [Option<&[f64]>; 2];

    /// Candidate `id` (asked and not told) will be executed at `joints` instead.
    fn amend(&mut self, id: u64, joints: &[f64]);

    /// Fitness values so far that were no evaluations; executions are not counted here.
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

    /// Goes on from a saved search of `space`.
    ///
    /// # Errors
    /// [`OptimizerError`] if the state does not fit the method and the space.
    fn resume(&self, space: SearchSpace, state: OptimizerState) -> Result<Box<dyn Optimizer>, OptimizerError>;

    /// Whether a candidate that was never executed may be a goal's result.
    fn unexecuted_may_win(&self) -> bool {
        false
    }
}
