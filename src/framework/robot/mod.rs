//! Robots: a URDF becomes an immutable model; kinematics are free functions over model and workspace.
//!
//! Monogram notation: `p_AB_C` is the position of point B measured from A, expressed in frame C (omitted if C = A);
//! `X_AB` is the pose of frame B in A; `B` is the base, `T` the tool. Metres and radians.
//!
//! # Architecture Invariants
//! - [`RobotModel`] and [`Chain`] are immutable; scratch space is a [`Workspace`] owned by the caller.
//! - Limits are data here, not clamps: positions are used as given, even outside a chain's limits.

mod chain;
mod check;
mod distort;
mod error;
mod geometry;
mod kinematics;
mod model;
mod placement;
mod spec;
#[cfg(test)]
mod tests;
mod view;

pub use chain::{Chain, Gene};
pub use check::{MAX_LINKS, MAX_NODES};
pub use error::{ChainError, ModelError};
pub use geometry::{LinkGeometry, LinkShape, PlacedShape};
pub use kinematics::{Workspace, forward_kinematics, jacobian, moving_frames, tool_position};
pub use model::{Joint, JointKind, Mimic, RobotModel};
pub use placement::{Placement, travel_bound};
pub use spec::RobotSpec;
pub use view::{ChainSummary, JointSummary, RobotNote, RobotSummary, summarize, summarize_chain};
