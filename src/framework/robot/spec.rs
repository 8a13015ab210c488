//! Selection of a chain from a URDF. All fields are optional with defined defaults.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The part of a robot that a job moves: chain, free joints, values of the others, tool.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields, default)]
pub struct RobotSpec {
    /// First link of the chain; the root link if absent.
    pub base_link: Option<String>,
    /// Last link of the chain; if absent, the only leaf link (several leaves are an error that lists them).
    pub tip_link: Option<String>,
    /// Joints the optimiser may move, in gene order; if absent, all movable joints of the chain that `fixed` does not
    /// name, base first.
    pub free_joints: Option<Vec<String>>,
    /// Values of the other joints (rad or m). Joints not named stay at 0, clamped to their limits.
    pub fixed: BTreeMap<String, f64>,
    /// Tool centre point in the tip link's frame, metres.
    pub tool_offset_m: [f64; 3],
    /// Position limits `[lower, upper]` by joint (rad or m), overriding the URDF's.
    pub limits: BTreeMap<String, [f64; 2]>,
    /// Acceleration limits (rad/s^2 or m/s^2) by joint; a URDF has none.
    pub acceleration: BTreeMap<String, f64>,
    /// Jerk limits (rad/s^3 or m/s^3) by joint; a URDF has none.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub jerk: BTreeMap<String, f64>,
    /// Positions of free joints before the first motion (rad or m), by joint. Trajectories and the identification moves
    /// of an unknown robot start there. Joints not named start at 0, clamped to their limits.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub home: BTreeMap<String, f64>,
}
