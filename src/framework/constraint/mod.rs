//! Constraints: what a candidate must satisfy, and what is done when it does not.
//!
//! # Architecture Invariants
//! - A constraint measures; it moves nothing and knows no optimiser. Its violation is 0 exactly where it is satisfied.
//! - All strategies work on every optimiser through one judge ([`Constrained`]) between proposing and executing.
//! - Every search for a feasible candidate is bounded; a goal without one ends with a typed reason, not with a hang.

mod constrained;
mod error;
#[cfg(test)]
mod fixtures;
mod geometry;
mod hull;
mod penalty;
mod plane;
mod point;
mod set;
mod spec;
mod state;
#[cfg(test)]
mod tests;

pub use constrained::{Constrained, Rules};
pub use error::ConstraintError;
pub use set::{Constraints, Proposal};
pub use spec::{
    ChainJoint, ConstraintSpec, GeometrySpec, HalfSpace, HandlingSpec, JointStepSpec, OnInfeasible, PenaltyForm,
    PenaltyKind, PenaltySpec, PointSpec, PopulationVelocitySpec, RegionSpec, Side,
};
pub use state::ConstrainedState;
