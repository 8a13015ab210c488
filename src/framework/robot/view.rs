//! What people and programs are shown of a robot: links, joints, limits, the tree, and what keeps it from being armed.

use super::chain::{Chain, Gene};
use super::model::{JointKind, RobotModel};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// A robot model, summarised.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RobotSummary {
    /// Name in the URDF.
    pub name: String,
    /// The link everything hangs from.
    pub root_link: String,
    /// All links, in the URDF's order.
    pub links: Vec<String>,
    /// Links without children: possible tips.
    pub leaf_links: Vec<String>,
    /// All joints, in the URDF's order.
    pub joints: Vec<JointSummary>,
    /// What is missing before a real robot may be moved with this model.
    pub notes: Vec<RobotNote>,
}

/// One joint, summarised.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct JointSummary {
    /// Unique name.
    pub name: String,
    /// How it moves.
    pub kind: JointKind,
    /// Link it hangs from.
    pub parent_link: String,
    /// Link it carries.
    pub child_link: String,
    /// Position limits, rad or m, where given.
    pub limits: Option<[f64; 2]>,
    /// Velocity limit, rad/s or m/s, where given.
    pub velocity: Option<f64>,
    /// The joint it follows, if it mimics one.
    pub mimics: Option<String>,
}

/// Something the URDF does not say.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RobotNote {
    /// The joint concerned.
    pub joint: String,
    /// Stable code: `no_position_limits`, `no_velocity_limit` or `not_drivable`.
    pub code: String,
    /// What it means and what to do.
    pub message: String,
}

/// Summarises `model`.
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
                note(name, "not_drivable", format!("{kind} joint {name:?} can be shown, but no chain may pass it"));
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

/// The chain a job moves, summarised.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ChainSummary {
    /// Positions are expressed in this link's frame.
    pub base_link: String,
    /// The link that carries the tool.
    pub tip_link: String,
    /// Free joints in gene order.
    pub free_joints: Vec<Gene>,
    /// Joints of the chain held at one value (rad or m).
    pub fixed_joints: std::collections::BTreeMap<String, f64>,
}

/// Summarises `chain`.
#[must_use]
pub fn summarize_chain(chain: &Chain) -> ChainSummary {
    ChainSummary {
        base_link: chain.base_link().to_owned(),
        tip_link: chain.tip_link().to_owned(),
        free_joints: chain.genes().to_vec(),
        fixed_joints: chain.fixed_joints().iter().cloned().collect(),
    }
}
