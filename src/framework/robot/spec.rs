//! What picks a chain out of a URDF: everything but the URDF text is optional with a defined default.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use utoipa::ToSchema;

/// The part of a robot a job moves: chain, free joints, values of the others, tool.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RobotSpec {
    /// First link of the chain; the root link when absent.
    pub base_link: Option<String>,
    /// Last link of the chain; when absent, the only leaf link (several leaves are an error that lists them).
    pub tip_link: Option<String>,
    /// Joints an optimiser may move, in gene order; when absent, all movable joints of the chain that `fixed` does not
    /// name, base first.
    pub free_joints: Option<Vec<String>>,
    /// Values of the other joints (rad or m); those not named stay at 0, moved into their limits if 0 is outside.
    pub fixed: BTreeMap<String, f64>,
    /// Tool centre point in the tip link's frame, metres.
    pub tool_offset_m: [f64; 3],
    /// Narrower or wider position limits than the URDF's (rad or m), by joint: `[lower, upper]`.
    pub limits: BTreeMap<String, [f64; 2]>,
    /// Acceleration limits (rad/s^2 or m/s^2) by joint: a URDF carries none.
    pub acceleration: BTreeMap<String, f64>,
    /// Where free joints stand before the first motion (rad or m), by joint: trajectories start there, and so do the
    /// moves by which an unknown robot is identified. Those not named stand at 0, moved into their limits.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub home: BTreeMap<String, f64>,
}
