//! The immutable robot model: links, joints, one root.
//!
//! Invariants: `joints[i].parent` and `.child` index `links`; every link except the root is the child of exactly one
//! joint; axes have unit length; a mimic refers to a joint that does not mimic.

use super::check::check;
use super::error::ModelError;
use super::geometry::{LinkGeometry, pose};
use nalgebra::{Isometry3, Unit, Vector3};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Kind of a joint, by its motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum JointKind {
    /// Rotation within limits, rad.
    Revolute,
    /// Rotation without limits, rad.
    Continuous,
    /// Translation within limits, m.
    Prismatic,
    /// No motion.
    Fixed,
    /// Six degrees of freedom; readable, but not allowed in a chain.
    Floating,
    /// Motion in a plane; readable, but not allowed in a chain.
    Planar,
    /// Ball joint; readable, but not allowed in a chain.
    Spherical,
}

impl JointKind {
    /// The URDF's name of the kind.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Revolute => "revolute",
            Self::Continuous => "continuous",
            Self::Prismatic => "prismatic",
            Self::Fixed => "fixed",
            Self::Floating => "floating",
            Self::Planar => "planar",
            Self::Spherical => "spherical",
        }
    }

    /// Whether the position is a single number.
    #[must_use]
    pub fn is_movable(self) -> bool {
        matches!(self, Self::Revolute | Self::Continuous | Self::Prismatic)
    }
}

/// q = multiplier * q_source + offset.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mimic {
    /// Index of the leading joint, which does not mimic.
    pub source: usize,
    /// Factor, with mimics of mimics already multiplied out.
    pub multiplier: f64,
    /// Offset, rad or m.
    pub offset: f64,
}

/// One joint of the model.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Unique name.
    pub name: String,
    /// Kind of motion.
    pub kind: JointKind,
    /// Index of the parent link.
    pub parent: usize,
    /// Index of the child link.
    pub child: usize,
    /// Pose of the joint frame at position 0 in the parent link's frame.
    pub x_pc: Isometry3<f64>,
    /// Unit axis in the joint frame.
    pub axis: Unit<Vector3<f64>>,
    /// Position limits `[lower, upper]`, rad or m; `None` if the URDF has none.
    pub limits: Option<[f64; 2]>,
    /// Velocity limit (> 0), rad/s or m/s; `None` if the URDF has none.
    pub velocity: Option<f64>,
    /// The joint it follows; `None` if it does not mimic.
    pub mimic: Option<Mimic>,
}

/// A robot as described by its URDF; immutable.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotModel {
    name: String,
    links: Vec<String>,
    geometry: Vec<LinkGeometry>,
    joints: Vec<Joint>,
    parent_joint: Vec<Option<usize>>,
    root: usize,
}

impl RobotModel {
    /// Reads a URDF: first the tree check, then urdf-rs.
    ///
    /// # Errors
    /// [`ModelError`] with the joint's or link's name, the value and a remedy.
    pub fn from_urdf(urdf: &str) -> Result<Self, ModelError> {
        let checked = check(urdf)?;
        let robot = urdf_rs::read_from_string(&checked.text)?;
        let links: Vec<String> = robot.links.iter().map(|l| l.name.clone()).collect();
        let link_index: BTreeMap<&str, usize> = links.iter().enumerate().map(|(i, l)| (l.as_str(), i)).collect();
        let joint_index: BTreeMap<&str, usize> =
            robot.joints.iter().enumerate().map(|(i, j)| (j.name.as_str(), i)).collect();
        let mut joints = Vec::with_capacity(robot.joints.len());
        let mut parent_joint = vec![None; links.len()];
        for (index, joint) in robot.joints.iter().enumerate() {
            let declared = checked.declared.get(&joint.name).copied().unwrap_or_default();
            let child = link_index[joint.child.link.as_str()];
            parent_joint[child] = Some(index);
            joints.push(Joint {
                name: joint.name.clone(),
                kind: kind_of(&joint.joint_type),
                parent: link_index[joint.parent.link.as_str()],
                child,
                x_pc: pose(&joint.origin),
                axis: Unit::new_normalize(Vector3::from(joint.axis.xyz.0)),
                limits: declared.position.then_some([joint.limit.lower, joint.limit.upper]),
                velocity: declared.velocity.then_some(joint.limit.velocity),
                mimic: resolve_mimic(&robot.joints, &joint_index, index),
            });
        }
        let root = parent_joint.iter().position(Option::is_none).ok_or(ModelError::NoLink)?;
        let geometry = robot.links.iter().map(LinkGeometry::read).collect();
        Ok(Self { name: robot.name, links, geometry, joints, parent_joint, root })
    }

    /// Name of the robot in the URDF.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Link names, in the URDF's order.
    #[must_use]
    pub fn links(&self) -> &[String] {
        &self.links
    }

    /// Shapes of each link, in the order of [`links`](Self::links).
    #[must_use]
    pub fn geometry(&self) -> &[LinkGeometry] {
        &self.geometry
    }

    /// Joints, in the URDF's order.
    #[must_use]
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// Index of the root link.
    #[must_use]
    pub fn root(&self) -> usize {
        self.root
    }

    /// Index of the joint whose child is `link`; `None` for the root.
    #[must_use]
    pub fn parent_joint(&self, link: usize) -> Option<usize> {
        self.parent_joint[link]
    }

    /// Index of the link named `name`.
    #[must_use]
    pub fn link_index(&self, name: &str) -> Option<usize> {
        self.links.iter().position(|l| l == name)
    }

    /// Indices of the links without children.
    #[must_use]
    pub fn leaves(&self) -> Vec<usize> {
        (0..self.links.len()).filter(|&l| self.joints.iter().all(|j| j.parent != l)).collect()
    }

    /// Joint indices from link `base` down to link `tip`; `None` if `base` is not an ancestor of `tip`.
    #[must_use]
    pub fn path(&self, base: usize, tip: usize) -> Option<Vec<usize>> {
        let mut path = Vec::new();
        let mut link = tip;
        while link != base {
            let joint = self.parent_joint[link]?;
            path.push(joint);
            link = self.joints[joint].parent;
        }
        path.reverse();
        Some(path)
    }
}

fn kind_of(kind: &urdf_rs::JointType) -> JointKind {
    match kind {
        urdf_rs::JointType::Revolute => JointKind::Revolute,
        urdf_rs::JointType::Continuous => JointKind::Continuous,
        urdf_rs::JointType::Prismatic => JointKind::Prismatic,
        urdf_rs::JointType::Fixed => JointKind::Fixed,
        urdf_rs::JointType::Floating => JointKind::Floating,
        urdf_rs::JointType::Planar => JointKind::Planar,
        urdf_rs::JointType::Spherical => JointKind::Spherical,
    }
}

/// Follows mimics of mimics to the leading joint; the tree check has excluded cycles.
fn resolve_mimic(joints: &[urdf_rs::Joint], index_of: &BTreeMap<&str, usize>, joint: usize) -> Option<Mimic> {
    let mut at = joint;
    let (mut multiplier, mut offset) = (1.0, 0.0);
    while let Some(mimic) = joints[at].mimic.as_ref() {
        offset += multiplier * mimic.offset.unwrap_or(0.0);
        multiplier *= mimic.multiplier.unwrap_or(1.0);
        at = index_of[mimic.joint.as_str()];
    }
    (at != joint).then_some(Mimic { source: at, multiplier, offset })
}
