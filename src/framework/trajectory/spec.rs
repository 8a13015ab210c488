//! The user's choices for a trajectory, and their ranges.

use crate::range::{OutOfRange, Range, above};
use crate::robot::Chain;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Parameters of a trajectory.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields, default)]
pub struct PlanSpec {
    /// Share of each joint's velocity limit to use, 0.001 to 1.
    pub speed: f64,
    /// Share of each joint's acceleration and jerk limits to use, 0.001 to 1.
    pub acceleration: f64,
    /// Time at rest at each goal but the last, seconds, 0 to 60; without effect if `blend`.
    pub dwell_s: f64,
    /// Whether the arm passes through the goals without stopping. The joints then follow a smooth curve, not straight
    /// lines between the goals.
    pub blend: bool,
    /// Decides when goals are reached.
    pub timing: Timing,
    /// Limits by free joint that are lower than those of the robot's description, or replace the ones that would be
    /// assumed because it has none.
    pub joint_limits: BTreeMap<String, MotionLimits>,
    /// Time between two points of the trajectory, seconds, 0.0001 to 10; each goal is an additional point.
    pub sample_s: f64,
}

/// Decides when goals are reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = PlanTiming))]
#[serde(rename_all = "snake_case")]
pub enum Timing {
    /// As early as the limits allow.
    #[default]
    Limits,
    /// At the interval of the demonstrations, or later where the limits forbid it.
    Demonstration,
}

/// Limits of one joint's motion; those that are absent stay as they are.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields, default)]
pub struct MotionLimits {
    /// Velocity limit, rad/s or m/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub velocity: Option<f64>,
    /// Acceleration limit, rad/s^2 or m/s^2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub acceleration: Option<f64>,
    /// Jerk limit, rad/s^3 or m/s^3.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub jerk: Option<f64>,
}

/// A choice that is not allowed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PlanError {
    /// A number is out of range.
    #[error(transparent)]
    Number(#[from] OutOfRange),
    /// A joint's limit is not positive, or above the one that the robot's description states.
    #[error("joint {joint:?}: {number}: a limit that the robot's description states can only be lowered")]
    JointLimit {
        /// Name of the joint.
        joint: String,
        /// The limit.
        number: OutOfRange,
    },
    /// A limit is given for a joint that does not move.
    #[error("joint_limits names {joint:?}: name one of the free joints {free:?}")]
    UnknownJoint {
        /// Name given.
        joint: String,
        /// Names of the free joints.
        free: Vec<String>,
    },
}

impl PlanError {
    /// Place of the choice in its [`PlanSpec`], outermost name first.
    #[must_use]
    pub fn place(&self) -> Vec<&str> {
        match self {
            Self::Number(number) => vec![number.parameter],
            Self::JointLimit { joint, number } => vec!["joint_limits", joint, number.parameter],
            Self::UnknownJoint { joint, .. } => vec!["joint_limits", joint],
        }
    }
}

impl Default for PlanSpec {
    fn default() -> Self {
        Self {
            speed: 0.5,
            acceleration: 0.5,
            dwell_s: 0.1,
            blend: false,
            timing: Timing::default(),
            joint_limits: BTreeMap::new(),
            sample_s: 0.02,
        }
    }
}

impl PlanSpec {
    /// Range of `speed` and `acceleration`.
    pub const SHARE: Range = Range { minimum: Some(1e-3), exclusive_minimum: None, maximum: Some(1.0) };
    /// Range of `dwell_s`, s.
    pub const DWELL_S: Range = Range { minimum: Some(0.0), exclusive_minimum: None, maximum: Some(60.0) };
    /// Range of `sample_s`, s.
    pub const SAMPLE_S: Range = Range { minimum: Some(1e-4), exclusive_minimum: None, maximum: Some(10.0) };

    /// Whether nothing was chosen.
    #[must_use]
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }

    /// Checks every choice against its range and against the joints of `chain`.
    ///
    /// # Errors
    /// [`PlanError`] for the first choice that is not allowed.
    pub fn check(&self, chain: &Chain) -> Result<(), PlanError> {
        Self::SHARE.check("speed", None, self.speed)?;
        Self::SHARE.check("acceleration", None, self.acceleration)?;
        Self::DWELL_S.check("dwell_s", Some("s"), self.dwell_s)?;
        Self::SAMPLE_S.check("sample_s", Some("s"), self.sample_s)?;
        self.joint_limits.iter().try_for_each(|(joint, own)| check_joint(chain, joint, *own))
    }
}

fn check_joint(chain: &Chain, joint: &str, own: MotionLimits) -> Result<(), PlanError> {
    let Some(gene) = chain.genes().iter().find(|gene| gene.name == joint) else {
        let free = chain.genes().iter().map(|gene| gene.name.clone()).collect();
        return Err(PlanError::UnknownJoint { joint: joint.to_owned(), free });
    };
    for (parameter, value, stated, unit) in [
        ("velocity", own.velocity, gene.velocity, "rad/s or m/s"),
        ("acceleration", own.acceleration, gene.acceleration, "rad/s^2 or m/s^2"),
        ("jerk", own.jerk, gene.jerk, "rad/s^3 or m/s^3"),
    ] {
        let Some(value) = value else { continue };
        let range = above(0.0).up_to(stated.unwrap_or(1e6));
        range
            .check(parameter, Some(unit), value)
            .map_err(|number| PlanError::JointLimit { joint: joint.to_owned(), number })?;
    }
    Ok(())
}
