//! Robots: a URDF becomes an immutable model; kinematics are free functions over model and workspace.
//!
//! Monogram notation: `p_AB_C` is the position of point B measured from A, expressed in frame C (omitted when C = A);
//! `X_AB` the pose of frame B in A; `B` base, `T` tool. Metres and radians.

mod spec;

pub use spec::RobotSpec;
