//! Trajectories: waypoints joined into a time-parameterised joint motion, checked, exported.
//!
//! # Architecture Invariants
//! - A [`CheckedTrajectory`] exists only if it is finite, its time increases, it starts and ends at rest, its position,
//!   velocity and acceleration are continuous, and every extremum of its polynomials respects the position, velocity,
//!   acceleration and jerk limits of its chain.
//! - It passes each waypoint, to the last bits of its numbers, in the order given.

mod blend;
mod check;
mod checked;
mod error;
pub mod export;
mod limits;
mod piece;
mod plan;
mod point;
mod polynomial;
mod profile;
mod spec;
#[cfg(test)]
mod tests;
mod tightest;
mod timing;
mod waypoint;

pub use check::check_stored;
pub use checked::CheckedTrajectory;
pub use error::TrajectoryError;
pub use limits::{DEFAULT_ACCELERATION, DEFAULT_JERK, DEFAULT_VELOCITY};
pub(crate) use limits::{JointLimits, limits};
pub use piece::{Piece, State};
pub(crate) use plan::late;
pub use plan::plan;
pub use point::Point;
pub use polynomial::Polynomial;
pub use spec::{MotionLimits, PlanError, PlanSpec, Timing};
pub use tightest::{LimitKind, Tightest};
pub use waypoint::Waypoint;
