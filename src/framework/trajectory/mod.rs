//! Trajectories: waypoints joined into a time-parameterised joint motion, checked, exported.
//!
//! # Architecture Invariants
//! - A [`CheckedTrajectory`] exists only if it is finite, its time increases, it starts and ends at rest, and every
//!   sample and segment respects the position, velocity and acceleration limits of its chain.

mod checked;
pub mod export;
mod plan;
#[cfg(test)]
mod tests;

pub(crate) use checked::JointLimits;
pub use checked::{CheckedTrajectory, LimitKind, Point, Tightest, TrajectoryError};
pub use plan::{DEFAULT_ACCELERATION, DEFAULT_VELOCITY, PlanSpec, plan};
pub(crate) use plan::{late, limits};
