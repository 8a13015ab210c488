//! Storage of robots.

use super::StoreError;
use crate::app::model::{Keyset, RobotId, RobotView};
use async_trait::async_trait;

/// A robot to keep; the store counts its version.
#[derive(Debug, Clone)]
pub struct NewRobot {
    /// The robot, as shown; `version` is ignored.
    pub view: RobotView,
    /// The URDF.
    pub urdf: String,
}

/// Robots, kept until they are deleted; a robot that a job uses cannot be deleted.
#[async_trait]
pub trait Robots: Send + Sync {
    /// Keeps a robot as the next version of its name.
    async fn insert_robot(&self, new: NewRobot) -> Result<RobotView, StoreError>;
    /// Reads one robot.
    async fn robot(&self, id: &RobotId) -> Result<RobotView, StoreError>;
    /// The URDF of a robot, as uploaded.
    async fn robot_urdf(&self, id: &RobotId) -> Result<String, StoreError>;
    /// Lists robots.
    async fn robots(&self, keyset: &Keyset) -> Result<Vec<RobotView>, StoreError>;
    /// Deletes a robot that no job names.
    async fn delete_robot(&self, id: &RobotId) -> Result<(), StoreError>;
}
