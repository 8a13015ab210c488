//! Constraints: conditions on candidates, and the treatment of candidates that violate them.
//!
//! # Architecture Invariants
//! - A constraint only measures; it changes nothing and knows no optimiser. Its violation is 0 exactly if it is
//!   satisfied.
//! - All strategies work with every optimiser through one judge ([`Judge`]) between proposal and execution.
//! - A pose that a hard constraint forbids (`collision_free`) is never executed, whatever the handling.
//! - Every search for a feasible candidate is bounded; a goal without one ends with a typed reason instead of hanging.

mod collision_free;
#[cfg(test)]
mod collision_tests;
mod error;
#[cfg(test)]
mod fixtures;
mod geometry;
mod hull;
mod judge;
mod penalty;
mod plane;
mod point;
mod set;
mod spec;
mod state;
#[cfg(test)]
mod tests;

pub use collision_free::{CollisionFreeSpec, WORKED_SURFACE};
pub use error::ConstraintError;
pub use judge::{Judge, Rules};
pub use set::{Constraints, Proposal};
pub use spec::{
    ChainJoint, ConstraintSpec, GeometrySpec, HalfSpace, HandlingSpec, JointStepSpec, OnInfeasible, PenaltyForm,
    PenaltyKind, PenaltySpec, PointSpec, PopulationVelocitySpec, RegionSpec, Side,
};
pub use state::JudgeState;
