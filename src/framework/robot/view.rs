//! Summary of a robot for people and programs: links, joints, limits, the tree, and what prevents real motion.

use super::chain::{Chain, Gene};
use super::model::{JointKind, RobotModel};
use serde::{Deserialize, Serialize};

/// Summary of a robot model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct RobotSummary {
    /// Name in the URDF.
    pub name: String,
    /// Root of the tree of links.
    pub root_link: String,
    /// All links, in the URDF's order.
    pub links: Vec<String>,
    /// Links without children: possible tips of a chain.
    pub leaf_links: Vec<String>,
    /// All joints, in the URDF's order.
    pub joints: Vec<JointSummary>,
    /// Information that must be added before a real robot may be moved with this model.
    pub notes: Vec<RobotNote>,
}

/// Summary of one joint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct JointSummary {
    /// Unique name.
    pub name: String,
    /// Kind of motion.
    pub kind: JointKind,
    /// Link on the base side.
    pub parent_link: String,
    /// Link on the tip side.
    pub child_link: String,
    /// Position limits `[lower, upper]`, rad or m; absent if the URDF has none.
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub limits: Option<[f64; 2]>,
    /// Velocity limit, rad/s or m/s; absent if the URDF has none.
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub velocity: Option<f64>,
    /// Name of the joint it follows; absent if it does not mimic.
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub mimics: Option<String>,
}

/// Information missing from the URDF.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct RobotNote {
    /// Name of the joint.
    pub joint: String,
    /// Stable code: `no_position_limits`, `no_velocity_limit` or `not_drivable`.
    pub code: String,
    /// Explanation and remedy.
    pub message: String,
}

/// Summarises a model.
#[must_use]
pub fn summarize(model: &RobotModel) -> RobotSummary {
    let link = |index: usize| model.links()[index].clone();
    let mut notes = Vec::new();
    let mut note = |joint: &str, code: &str, message: String| {
        notes.push(RobotNote { joint: joint.to_owned(), code: code.to_owned(), message });
    };
    for joint in model.joints() {
        let name = &joint.name;
        if !joint.kind.is_movable() {
            if joint.kind != JointKind::Fixed {
                let kind = joint.kind.name();
                note(
                    name,
                    "not_drivable",
                    format!("{kind} joint {name:?} can be shown, but is not allowed in a chain"),
                );
            }
            continue;
        }
        if joint.limits.is_none() && joint.kind != JointKind::Continuous {
            let message = format!("joint {name:?} has no position limits: it cannot be armed; add lower and upper");
            note(name, "no_position_limits", message);
        }
        if joint.velocity.is_none() {
            let message = format!("joint {name:?} has no velocity limit: it cannot be armed; add velocity");
            note(name, "no_velocity_limit", message);
        }
    }
    RobotSummary {
        name: model.name().to_owned(),
        root_link: link(model.root()),
        links: model.links().to_vec(),
        leaf_links: model.leaves().into_iter().map(link).collect(),
        joints: model
            .joints()
            .iter()
            .map(|joint| JointSummary {
                name: joint.name.clone(),
                kind: joint.kind,
                parent_link: link(joint.parent),
                child_link: link(joint.child),
                limits: joint.limits,
                velocity: joint.velocity,
                mimics: joint.mimic.map(|m| model.joints()[m.source].name.clone()),
            })
            .collect(),
        notes,
    }
}

/// Summary of the chain a job moves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct ChainSummary {
    /// Base link; positions are expressed in its frame.
    pub base_link: String,
    /// Link that carries the tool.
    pub tip_link: String,
    /// Free joints in gene order.
    pub free_joints: Vec<Gene>,
    /// Joints of the chain held at a constant value (rad or m).
    pub fixed_joints: std::collections::BTreeMap<String, f64>,
}

/// Summarises a chain.
#[must_use]
pub fn summarize_chain(chain: &Chain) -> ChainSummary {
    ChainSummary {
        base_link: chain.base_link().to_owned(),
        tip_link: chain.tip_link().to_owned(),
        free_joints: chain.genes().to_vec(),
        fixed_joints: chain.fixed_joints().iter().cloned().collect(),
    }
}
