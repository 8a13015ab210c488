//! Optimisers behind one ask/tell interface, one algorithm per file.
//!
//! # Architecture Invariants
//! - An optimiser owns no objective and no world: it proposes candidates by id and receives their outcomes.
//! - The seed is mandatory; [`Optimizer::state`] holds everything, the random stream included: a resumed optimiser
//!   continues with the same bits.
//! - Genes are radians or metres. A failed trial is [`Outcome::Failed`], never NaN.

mod affg_pso;
mod batch;
mod bounds;
mod cma_es;
mod differential_evolution;
mod error;
mod fi_pso;
mod incumbent;
mod optimizer;
mod provenance;
mod pso;
mod sst;
mod state;
mod swarm;
mod waiting;

pub use affg_pso::{AffgPsoSpec, AffgState};
pub use batch::Batch;
pub use bounds::BoundsRule;
pub use cma_es::{CmaEs, CmaEsSpec, CmaEsState};
pub use differential_evolution::DeSpec;
pub use error::OptimizerError;
pub use fi_pso::FiPsoSpec;
pub(crate) use incumbent::Incumbent;
pub use optimizer::{Best, Optimizer, Outcome, PerGoalMethod, SearchSpace};
pub use provenance::{Provenance, StopReason, Tally};
pub use pso::PsoSpec;
pub use sst::{Sst, SstSpec, SstState};
pub use state::OptimizerState;
pub use swarm::{Leader, SwarmSpec, SwarmState, VelocityClamp};
