//! Robots, as requested and as shown.

use super::id::RobotId;
use super::time::Timestamp;
use crate::framework::robot::{ChainSummary, RobotSpec, RobotSummary};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Request for a new robot, or for a new version if the name exists.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct CreateRobot {
    /// Display name.
    pub name: String,
    /// The URDF, as text.
    pub urdf: String,
    /// Chain, free joints, tool.
    #[serde(default)]
    pub spec: RobotSpec,
}

/// One immutable version of a robot, without its URDF.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RobotView {
    /// Id of this version.
    pub id: RobotId,
    /// Display name; versions of one robot share it.
    pub name: String,
    /// Version number: 1 for the first of that name, then counting up.
    pub version: u32,
    /// Chain, free joints, tool, as requested.
    pub spec: RobotSpec,
    /// The chain that moves.
    pub chain: ChainSummary,
    /// Summary of the whole robot.
    pub summary: RobotSummary,
    /// SHA-256 of the URDF, hexadecimal.
    pub urdf_sha256: String,
    /// Creation time.
    pub created_at: Timestamp,
}
