//! The paper's arm and its constraint chain, for the tests of this module.

use super::spec::{ChainJoint, PointSpec};
use crate::robot::{Chain, RobotModel, RobotSpec};
use crate::world::{ToolPositionSpec, WorldSpec};

pub(super) struct Arm {
    pub model: RobotModel,
    pub robot: RobotSpec,
    pub chain: Chain,
}

pub(super) fn arm() -> Arm {
    let model = RobotModel::from_urdf(include_str!("../../../examples/robots/teo_right_arm.urdf")).unwrap();
    let robot = RobotSpec {
        free_joints: Some(["shoulder_pitch", "shoulder_roll", "elbow_pitch"].map(str::to_owned).to_vec()),
        fixed: [("wrist_yaw".to_owned(), -std::f64::consts::FRAC_PI_4)].into(),
        ..RobotSpec::default()
    };
    let chain = Chain::new(&model, &robot).unwrap();
    Arm { model, robot, chain }
}

/// A world without a surface.
pub(super) fn world() -> WorldSpec {
    WorldSpec::ToolPosition(ToolPositionSpec { unit: "mm".to_owned() })
}

/// The chain on which the published runs checked their boxes.
pub(super) fn constraint_point() -> PointSpec {
    let joint = |joint: &str, offset_m: [f64; 3], axis: [f64; 3]| ChainJoint { joint: joint.into(), offset_m, axis };
    PointSpec::Chain {
        joints: vec![
            joint("shoulder_pitch", [0.0, -0.338, 0.7982], [0.0, -1.0, 0.0]),
            joint("shoulder_roll", [0.0; 3], [-1.0, 0.0, 0.0]),
            joint("elbow_pitch", [0.0, 0.0, -0.32901], [0.0, -1.0, 0.0]),
        ],
        tip_m: [0.0, 0.0, -0.4692],
    }
}
