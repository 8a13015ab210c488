//! The constrained point of the robot, as a function of the joints.

use super::error::ConstraintError;
use super::geometry::finite;
use super::spec::{ChainJoint, PointSpec};
use crate::robot::{Chain, RobotModel, RobotSpec, tool_position};
use nalgebra::{Rotation3, Unit, Vector3};

/// One revolute joint of an explicit chain.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Turn {
    offset_m: Vector3<f64>,
    axis: Unit<Vector3<f64>>,
    gene: usize,
}

/// Definition of the constrained point.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Point {
    Tool(Chain),
    /// The tool of a shorter chain, with the index of the robot's gene for each of its genes.
    Link(Chain, Vec<usize>),
    Written(Vec<Turn>, Vector3<f64>),
}

impl Point {
    pub fn new(
        spec: &PointSpec,
        model: &RobotModel,
        robot: &RobotSpec,
        chain: &Chain,
    ) -> Result<Self, ConstraintError> {
        match spec {
            PointSpec::Tool => Ok(Self::Tool(chain.clone())),
            PointSpec::Link { link, offset_m } => {
                finite("offset_m", offset_m)?;
                let shorter = Chain::new(model, &shorter(model, robot, chain, link, *offset_m))?;
                let genes =
                    shorter.genes().iter().map(|gene| free_joint(chain, &gene.name)).collect::<Result<_, _>>()?;
                Ok(Self::Link(shorter, genes))
            }
            PointSpec::Chain { joints, tip_m } => {
                finite("tip_m", tip_m)?;
                let turns = joints.iter().map(|joint| turn(joint, chain)).collect::<Result<_, _>>()?;
                Ok(Self::Written(turns, Vector3::from(*tip_m)))
            }
        }
    }

    /// Position of the point in the base frame, m; `joints` are the robot's free joints.
    pub fn position(&self, joints: &[f64]) -> Vector3<f64> {
        match self {
            Self::Tool(chain) => tool_position(chain, joints),
            Self::Link(chain, genes) => {
                let own: Vec<f64> = genes.iter().map(|&gene| joints[gene]).collect();
                tool_position(chain, &own)
            }
            Self::Written(turns, tip) => turns.iter().rev().fold(*tip, |point, turn| {
                turn.offset_m + Rotation3::from_axis_angle(&turn.axis, joints[turn.gene]) * point
            }),
        }
    }
}

/// The chain cut off at `link`; joints beyond it are left out.
fn shorter(model: &RobotModel, robot: &RobotSpec, chain: &Chain, link: &str, offset_m: [f64; 3]) -> RobotSpec {
    let path = model.link_index(chain.base_link()).zip(model.link_index(link)).and_then(|(b, l)| model.path(b, l));
    let leaders = path.unwrap_or_default().into_iter().map(|joint| {
        let source = model.joints()[joint].mimic.map_or(joint, |mimic| mimic.source);
        model.joints()[source].name.clone()
    });
    let moving: Vec<String> = leaders.collect();
    let keeps = |name: &String| moving.contains(name);
    let free = chain.genes().iter().map(|gene| gene.name.clone()).filter(keeps).collect();
    RobotSpec {
        base_link: Some(chain.base_link().to_owned()),
        tip_link: Some(link.to_owned()),
        free_joints: Some(free),
        fixed: robot.fixed.iter().filter(|(name, _)| keeps(name)).map(|(n, v)| (n.clone(), *v)).collect(),
        tool_offset_m: offset_m,
        limits: robot.limits.iter().filter(|(name, _)| keeps(name)).map(|(n, v)| (n.clone(), *v)).collect(),
        ..RobotSpec::default()
    }
}

fn free_joint(chain: &Chain, name: &str) -> Result<usize, ConstraintError> {
    chain.genes().iter().position(|gene| gene.name == name).ok_or_else(|| ConstraintError::UnknownJoint {
        joint: name.to_owned(),
        free: chain.genes().iter().map(|gene| gene.name.clone()).collect(),
    })
}

fn turn(joint: &ChainJoint, chain: &Chain) -> Result<Turn, ConstraintError> {
    finite("offset_m", &joint.offset_m)?;
    finite("axis", &joint.axis)?;
    let axis = Unit::try_new(Vector3::from(joint.axis), f64::MIN_POSITIVE)
        .ok_or(ConstraintError::NoDirection { normal: joint.axis })?;
    Ok(Turn { offset_m: Vector3::from(joint.offset_m), axis, gene: free_joint(chain, &joint.joint)? })
}

#[cfg(test)]
mod tests {
    use super::super::fixtures;
    use super::*;
    use proptest::prelude::*;

    /// The paper's p_c as a formula: S_c + Ry(q0) Rx(q1) [(0, 0, -0.32901) + Ry(q3) (0, 0, -0.4692)], q = -g.
    fn by_formula(g: &[f64]) -> Vector3<f64> {
        let ry = |angle: f64| Rotation3::from_axis_angle(&Vector3::y_axis(), angle);
        let rx = |angle: f64| Rotation3::from_axis_angle(&Vector3::x_axis(), angle);
        let upper = Vector3::new(0.0, 0.0, -0.32901) + ry(-g[2]) * Vector3::new(0.0, 0.0, -0.4692);
        Vector3::new(0.0, -0.338, 0.7982) + ry(-g[0]) * (rx(-g[1]) * upper)
    }

    #[test]
    fn unknown_joints_and_links_are_named() {
        let arm = fixtures::arm();
        let stray = ChainJoint { joint: "knee".into(), offset_m: [0.0; 3], axis: [0.0, 0.0, 1.0] };
        let spec = PointSpec::Chain { joints: vec![stray], tip_m: [0.0; 3] };
        let message = Point::new(&spec, &arm.model, &arm.robot, &arm.chain).unwrap_err().to_string();
        assert!(message.contains("knee") && message.contains("elbow_pitch"), "{message}");
        let spec = PointSpec::Link { link: "tail".into(), offset_m: [0.0; 3] };
        let message = Point::new(&spec, &arm.model, &arm.robot, &arm.chain).unwrap_err().to_string();
        assert!(message.contains("tail"), "{message}");
    }

    proptest! {
        #[test]
        fn a_written_chain_is_the_papers_formula(g in prop::array::uniform3(-0.26..1.74_f64)) {
            let arm = fixtures::arm();
            let point = Point::new(&fixtures::constraint_point(), &arm.model, &arm.robot, &arm.chain).unwrap();
            prop_assert!((point.position(&g) - by_formula(&g)).norm() < 1e-12);
        }

        #[test]
        fn the_elbow_keeps_its_distance_to_shoulder_and_tool(g in prop::array::uniform3(-0.26..1.74_f64)) {
            let arm = fixtures::arm();
            let spec = PointSpec::Link { link: "elbow".into(), offset_m: [0.0; 3] };
            let elbow = Point::new(&spec, &arm.model, &arm.robot, &arm.chain).unwrap().position(&g);
            let tool = Point::new(&PointSpec::Tool, &arm.model, &arm.robot, &arm.chain).unwrap().position(&g);
            let shoulder = Vector3::new(0.0, -0.34692, 0.7982);
            prop_assert!(((elbow - shoulder).norm() - 0.329).abs() < 1e-12);
            prop_assert!(((elbow - tool).norm() - 0.4692_f64.hypot(0.00892)).abs() < 1e-9);
        }
    }
}
