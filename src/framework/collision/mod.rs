//! Collisions of a robot with itself and with obstacles: the clearance of a pose, and the first contact of a motion.
//!
//! # Architecture Invariants
//! - Pure and deterministic: same inputs, same bits. Pairs are visited in a fixed order and ties go to the first.
//! - Kinematics are those of [`robot`](crate::robot); everything is expressed in the chain's base frame, metres.
//! - [`CollisionModel`] is immutable; scratch space is a [`Workspace`] owned by the caller, and no check of a
//!   pose allocates.
//! - In doubt there is a collision: if the search for closest points does not converge, the distance is 0.

mod capsules;
mod error;
mod joint_space;
mod links;
mod model;
mod obstacle;
mod options;
#[cfg(test)]
mod oracle_tests;
mod pairs;
mod route;
#[cfg(test)]
mod route_tests;
#[cfg(test)]
mod sampled_tests;
mod solid;
mod surface;
mod sweep;
#[cfg(test)]
mod tests;
mod tree;

pub use error::CollisionError;
pub use links::ShapeNote;
pub use model::{Clearance, CollisionModel, Workspace};
pub use obstacle::{BoxObstacle, HalfSpaceObstacle, HullObstacle, Obstacle, ObstacleShape, SphereObstacle};
pub use options::{CollisionOptions, HomeContacts};
pub use pairs::{ExcludedPair, Exclusion, TOOL};
pub use route::{RouteBudget, route};
pub use surface::surface_obstacle;
pub use sweep::MotionCollision;
