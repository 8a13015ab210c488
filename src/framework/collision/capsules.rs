//! Capsules for links whose shape is unknown: from the link's own origin to the origins of the joints that it carries.

use super::solid::{Solid, Surround};
use crate::robot::RobotModel;
use nalgebra::Vector3;

/// Shortest capsule, metres; shorter ones are left out.
const MIN_LENGTH_M: f64 = 1e-6;

/// One capsule per joint that is not at the origin of `link`; empty for a link that only turns another one.
pub(super) fn to_joints(model: &RobotModel, link: usize, around: Surround, radius_m: f64) -> Vec<Solid> {
    let carried = model.joints().iter().filter(|joint| joint.parent == link);
    carried
        .map(|joint| joint.x_pc.translation.vector)
        .filter(|origin| origin.norm() > MIN_LENGTH_M)
        .map(|origin| Solid::capsule(around, [Vector3::zeros(), origin], radius_m))
        .collect()
}
