//! Robots: the request for one, and how it is shown.

use super::id::RobotId;
use super::time::Timestamp;
use crate::framework::robot::{ChainSummary, RobotSpec, RobotSummary};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// A new robot, or a new version of one when the name is taken.
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
    /// Its id.
    pub id: RobotId,
    /// Display name; versions of one robot share it.
    pub name: String,
    /// 1 for the first of that name, then counted up.
    pub version: u32,
    /// Chain, free joints, tool, as they were given.
    pub spec: RobotSpec,
    /// The part that moves.
    pub chain: ChainSummary,
    /// The whole robot.
    pub summary: RobotSummary,
    /// SHA-256 of the URDF, hexadecimal.
    pub urdf_sha256: String,
    /// When it was created.
    pub created_at: Timestamp,
}
