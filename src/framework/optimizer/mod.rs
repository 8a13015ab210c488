//! Optimisers behind one ask/tell interface, one algorithm a file.
//!
//! # Architecture Invariants
//! - An optimiser owns no objective and no world: it names candidates by id and is told what became of them.
//! - The seed is mandatory; [`Optimizer::state`] holds everything, the random stream included: a resumed optimiser
//!   goes on with the same bits.
//! - Genes are radians or metres. A failed trial is [`Outcome::Failed`], never NaN.

mod batch;
mod rng;
mod spec;
mod sst;

pub use batch::Batch;
pub use rng::RandomStream;
pub use spec::{BoundsRule, MethodSpec, SstSpec};
pub use sst::{Sst, SstState};

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Where a fitness value comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Provenance {
    /// Executed in a simulated world.
    Simulated,
    /// Executed on a robot.
    Real,
    /// Taken from relatives without executing.
    Inherited,
    /// Taken from a similar individual without executing.
    Granule,
    /// A penalty, without executing.
    Penalised,
}

impl Provenance {
    /// Whether the candidate was executed: only such a value is an evaluation.
    #[must_use]
    pub fn is_executed(self) -> bool {
        matches!(self, Self::Simulated | Self::Real)
    }
}

/// Why a goal ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum StopReason {
    /// Too many generations without strict improvement.
    Stagnation,
    /// The target discrepancy was reached.
    Target,
    /// An observation came within the tolerance of the goal.
    Tolerance,
    /// The goal's evaluations are used up.
    MaxEvaluations,
}

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

/// A search for the joint vector of one goal.
pub trait Optimizer: Send {
    /// Adds candidates to `batch` until it is full or none can be named before others are told. Each is named once,
    /// except after a resume: then those never told are named again, in the same order.
    fn ask(&mut self, batch: &mut Batch);

    /// Takes what became of candidate `id`; any subset of the asked, in any order. An id not waited for is ignored:
    /// it is late news of a candidate told before.
    fn tell(&mut self, id: u64, outcome: Outcome<'_>);

    /// The best executed candidate so far.
    fn best(&self) -> Option<Best<'_>>;

    /// Why the search has ended by its own rules, if it has.
    fn stop(&self) -> Option<StopReason>;

    /// Everything needed to go on with the same bits.
    fn state(&self) -> OptimizerState;
}

/// The saved state of an optimiser, by method.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum OptimizerState {
    /// Steady-state tournament.
    Sst(SstState),
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
}

/// Why a method cannot be run.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum OptimizerError {
    /// A parameter out of its range.
    #[error("{method}: {parameter} is {value}, {expected}")]
    Parameter {
        /// Method name.
        method: &'static str,
        /// Parameter name.
        parameter: &'static str,
        /// The value given.
        value: f64,
        /// The range.
        expected: &'static str,
    },
    /// A state saved by another version.
    #[error("the saved {method} state has version {found}, this program reads {expected}: run the job again")]
    Version {
        /// Method name.
        method: &'static str,
        /// Version of the state.
        found: u32,
        /// Version understood.
        expected: u32,
    },
    /// A state of another problem.
    #[error("the saved {method} state holds {found} {what}, the problem needs {expected}: it belongs to another job")]
    Shape {
        /// Method name.
        method: &'static str,
        /// What does not fit.
        what: &'static str,
        /// Number found.
        found: usize,
        /// Number needed.
        expected: usize,
    },
}

/// A fresh search by `method`; `stream` separates the goals of one seed.
///
/// # Errors
/// [`OptimizerError::Parameter`] for a parameter out of its range.
pub fn start(
    method: &MethodSpec,
    space: SearchSpace,
    seed: u64,
    stream: u64,
) -> Result<Box<dyn Optimizer>, OptimizerError> {
    match method {
        MethodSpec::Sst(spec) => Ok(Box::new(Sst::new(spec, space, seed, stream)?)),
    }
}

/// Goes on from a saved state.
///
/// # Errors
/// [`OptimizerError`] if the state does not fit the method and space.
pub fn resume(
    method: &MethodSpec,
    space: SearchSpace,
    state: OptimizerState,
) -> Result<Box<dyn Optimizer>, OptimizerError> {
    match (method, state) {
        (MethodSpec::Sst(spec), OptimizerState::Sst(state)) => Ok(Box::new(Sst::resume(spec, space, state)?)),
    }
}
