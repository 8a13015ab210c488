//! Optimisers behind one ask/tell interface, one algorithm a file.
//!
//! # Architecture Invariants
//! - An optimiser owns no objective and no world: it names candidates by id and is told what became of them.
//! - The seed is mandatory; [`Optimizer::state`] holds everything, the random stream included: a resumed optimiser
//!   goes on with the same bits.
//! - Genes are radians or metres. A failed trial is [`Outcome::Failed`], never NaN.

mod affg_pso;
mod batch;
mod bounds;
mod cma_es;
mod fi_pso;
mod incumbent;
mod pso;
mod sst;
mod swarm;
mod waiting;

pub use affg_pso::{AffgPsoSpec, AffgState};
pub use batch::Batch;
pub use bounds::BoundsRule;
pub use cma_es::{CmaEs, CmaEsSpec, CmaEsState};
pub use fi_pso::FiPsoSpec;
pub(crate) use incumbent::Incumbent;
pub use pso::PsoSpec;
pub use sst::{Sst, SstSpec, SstState};
pub use swarm::{Leader, SwarmSpec, SwarmState, VelocityClamp};

use super::catalogue::MethodSpec;
use super::parameters::Parameters;
use super::range::OutOfRange;
use crate::constraint::ConstrainedState;
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
    /// The search ended without a candidate that satisfies the constraints.
    Infeasible,
    /// No pose is expected to come nearer: the result is the best residual.
    OutOfReach,
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

/// Where fitness values come from and what was done about infeasible candidates, by count.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, ToSchema)]
pub struct Tally {
    /// Executed in simulation.
    pub simulated: u64,
    /// Executed on a robot.
    pub real: u64,
    /// Fitness inherited.
    pub inherited: u64,
    /// Fitness taken from a granule.
    pub granule: u64,
    /// Fitness that is a penalty, not executed.
    pub penalised: u64,
    /// Executed candidates whose fitness was made worse because they are infeasible.
    pub worsened: u64,
    /// Candidates rejected; another took the place of each.
    pub rejected: u64,
    /// Candidates moved to a feasible place before they were executed.
    pub repaired: u64,
}

impl std::iter::Sum for Tally {
    fn sum<I: Iterator<Item = Self>>(tallies: I) -> Self {
        tallies.fold(Self::default(), |a, b| Self {
            simulated: a.simulated + b.simulated,
            real: a.real + b.real,
            inherited: a.inherited + b.inherited,
            granule: a.granule + b.granule,
            penalised: a.penalised + b.penalised,
            worsened: a.worsened + b.worsened,
            rejected: a.rejected + b.rejected,
            repaired: a.repaired + b.repaired,
        })
    }
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

    /// Whether candidate `id` (asked and not told) may be the result of its goal.
    fn is_feasible(&self, id: u64) -> bool {
        let _ = id;
        true
    }

    /// The smallest violations of an infeasible candidate so far, one a constraint (m or rad).
    fn nearest_violations(&self) -> Option<&[f64]> {
        None
    }

    /// Fitness values so far that were no evaluations; executions are not counted here.
    fn tally(&self) -> Tally {
        Tally::default()
    }
}

/// The saved state of an optimiser, by method.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum OptimizerState {
    /// Steady-state tournament.
    Sst(SstState),
    /// Particle swarm.
    Pso(SwarmState),
    /// Particle swarm with fitness inheritance.
    FiPso(SwarmState),
    /// Particle swarm with fitness granulation.
    AffgPso(AffgState),
    /// Covariance matrix adaptation.
    CmaEs(CmaEsState),
    /// Any of these under constraints.
    Constrained(Box<ConstrainedState>),
}

impl OptimizerState {
    /// Name of the method it was saved from.
    #[must_use]
    pub fn method(&self) -> &'static str {
        match self {
            Self::Sst(_) => "sst",
            Self::Pso(_) => "pso",
            Self::FiPso(_) => "fi_pso",
            Self::AffgPso(_) => "affg_pso",
            Self::CmaEs(_) => "cma_es",
            Self::Constrained(state) => state.method(),
        }
    }
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

/// Why a method cannot be run.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum OptimizerError {
    /// A parameter out of its range.
    #[error("{method}: {number}")]
    Parameter {
        /// Method name.
        method: &'static str,
        /// The parameter, its value and its range.
        number: OutOfRange,
    },
    /// A method that has no search of one goal.
    #[error("{method} owns the whole run: it cannot search for one goal alone")]
    OwnsTheRun {
        /// Method name.
        method: &'static str,
    },
    /// A method that stands for another.
    #[error("auto stands for a method: choose one for the problem first")]
    Undecided,
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
    /// A state of another method.
    #[error("the saved state is one of {found}, the method is {expected}: it belongs to another job")]
    Method {
        /// Method of the state.
        found: &'static str,
        /// Method of the problem.
        expected: &'static str,
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

impl OptimizerError {
    /// # Errors
    /// [`OptimizerError::Parameter`] for a parameter of `method` that is out of its range.
    fn check(method: &'static str, parameters: &impl Parameters) -> Result<(), Self> {
        parameters.check_ranges().map_err(|number| Self::Parameter { method, number })
    }
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
        MethodSpec::Auto(_) => Err(OptimizerError::Undecided),
        MethodSpec::Sst(spec) => Ok(Box::new(Sst::new(spec, space, seed, stream)?)),
        MethodSpec::Pso(spec) => pso::start(spec, space, seed, stream),
        MethodSpec::FiPso(spec) => fi_pso::start(spec, space, seed, stream),
        MethodSpec::AffgPso(spec) => affg_pso::start(spec, space, seed, stream),
        MethodSpec::CmaEs(spec) => Ok(Box::new(CmaEs::new(spec, space, seed, stream)?)),
        MethodSpec::Broyden(_) | MethodSpec::Model(_) | MethodSpec::Particle(_) | MethodSpec::Search(_) => {
            Err(OptimizerError::OwnsTheRun { method: method.name() })
        }
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
        (MethodSpec::Pso(spec), OptimizerState::Pso(state)) => pso::resume(spec, space, state),
        (MethodSpec::FiPso(spec), OptimizerState::FiPso(state)) => fi_pso::resume(spec, space, state),
        (MethodSpec::AffgPso(spec), OptimizerState::AffgPso(state)) => affg_pso::resume(spec, space, state),
        (MethodSpec::CmaEs(spec), OptimizerState::CmaEs(state)) => Ok(Box::new(CmaEs::resume(spec, space, state)?)),
        (method, state) => Err(OptimizerError::Method { found: state.method(), expected: method.name() }),
    }
}
