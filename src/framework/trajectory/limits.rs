//! Limits of a chain's joints for planning: stated by the robot's description, lowered by the user, or assumed.

use super::spec::{MotionLimits, PlanSpec};
use crate::robot::{Chain, Gene, JointKind};

/// Velocity limit assumed if the URDF has none, rad/s or m/s.
pub const DEFAULT_VELOCITY: f64 = 0.5;
/// Acceleration limit assumed if the robot's description has none (a URDF never does), rad/s^2 or m/s^2.
pub const DEFAULT_ACCELERATION: f64 = 2.0;
/// Jerk limit assumed if the robot's description has none (a URDF never does), rad/s^3 or m/s^3.
pub const DEFAULT_JERK: f64 = 20.0;

/// Planning limits of one joint.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct JointLimits {
    pub name: String,
    pub lower: f64,
    pub upper: f64,
    pub velocity: f64,
    pub acceleration: f64,
    pub jerk: f64,
}

impl JointLimits {
    /// The same joint, of whose limits only the shares of `spec` are used.
    pub(super) fn shared(&self, spec: &PlanSpec) -> Self {
        Self {
            velocity: self.velocity * spec.speed,
            acceleration: self.acceleration * spec.acceleration,
            jerk: self.jerk * spec.acceleration,
            ..self.clone()
        }
    }
}

/// Limits of a chain's joints without any of the user's, with a note for each assumed one.
pub(crate) fn limits(chain: &Chain) -> (Vec<JointLimits>, Vec<String>) {
    limits_under(chain, &PlanSpec::default())
}

/// Limits of a chain's joints under those of `spec`, with a note for each assumed one.
pub(super) fn limits_under(chain: &Chain, spec: &PlanSpec) -> (Vec<JointLimits>, Vec<String>) {
    let mut notes = Vec::new();
    let mut of = |gene: &Gene| {
        let unit = if gene.kind == JointKind::Prismatic { "m" } else { "rad" };
        let [lower, upper] = gene.motion_range();
        let mut limit = |what: &str, per: &str, own: Option<f64>, stated: Option<f64>, default: f64| {
            own.or(stated).unwrap_or_else(|| {
                notes.push(format!("joint {:?} has no {what} limit: {default} {unit}/{per} assumed", gene.name));
                default
            })
        };
        let own = spec.joint_limits.get(&gene.name).copied().unwrap_or_default();
        let MotionLimits { velocity, acceleration, jerk } = own;
        JointLimits {
            name: gene.name.clone(),
            lower,
            upper,
            velocity: limit("velocity", "s", velocity, gene.velocity, DEFAULT_VELOCITY),
            acceleration: limit("acceleration", "s^2", acceleration, gene.acceleration, DEFAULT_ACCELERATION),
            jerk: limit("jerk", "s^3", jerk, gene.jerk, DEFAULT_JERK),
        }
    };
    let limits = chain.genes().iter().map(&mut of).collect();
    (limits, notes)
}
