//! Robots: a URDF and the part of it that moves; every version is immutable.

use crate::app::id::RobotId;
use crate::app::{App, AppError, Page, PageQuery, Timestamp};
use crate::framework::robot::RobotSpec;
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
    /// Chain, free joints, tool.
    pub spec: RobotSpec,
    /// What the chain is made of.
    pub summary: RobotSummary,
    /// SHA-256 of the URDF, hexadecimal.
    pub urdf_sha256: String,
    /// When it was created.
    pub created_at: Timestamp,
}

/// What a chain is made of.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RobotSummary {
    /// Number of links of the whole robot.
    pub links: u32,
    /// First link of the chain.
    pub base_link: String,
    /// Last link of the chain.
    pub tip_link: String,
    /// Movable joints of the chain, base first.
    pub joints: Vec<JointSummary>,
}

/// One movable joint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct JointSummary {
    /// Joint name.
    pub name: String,
    /// `revolute`, `continuous` or `prismatic`.
    pub kind: String,
    /// Whether an optimiser moves it.
    pub free: bool,
    /// Lower limit, rad or m; absent without limit.
    pub lower: Option<f64>,
    /// Upper limit, rad or m; absent without limit.
    pub upper: Option<f64>,
    /// Velocity limit, rad/s or m/s.
    pub velocity: Option<f64>,
    /// Acceleration limit, rad/s^2 or m/s^2.
    pub acceleration: Option<f64>,
}

impl App {
    /// Checks and keeps a robot.
    ///
    /// # Errors
    /// `Invalid` when the URDF or the chain is wrong.
    pub async fn create_robot(&self, request: CreateRobot) -> Result<RobotView, AppError> {
        let _ = request;
        Err(self.unfinished())
    }

    /// Newest first.
    ///
    /// # Errors
    /// `Malformed` page.
    pub async fn list_robots(&self, page: PageQuery) -> Result<Page<RobotView>, AppError> {
        let _ = page;
        Err(self.unfinished())
    }

    /// One robot.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn get_robot(&self, id: &RobotId) -> Result<RobotView, AppError> {
        let _ = id;
        Err(self.unfinished())
    }

    /// Its URDF, as it was uploaded.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn robot_urdf(&self, id: &RobotId) -> Result<String, AppError> {
        let _ = id;
        Err(self.unfinished())
    }

    /// Deletes it unless a job names it.
    ///
    /// # Errors
    /// `NotFound`; `Conflict` when jobs name it.
    pub async fn delete_robot(&self, id: &RobotId) -> Result<(), AppError> {
        let _ = id;
        Err(self.unfinished())
    }
}
