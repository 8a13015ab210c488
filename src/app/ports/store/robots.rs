//! Storage of robots.

use super::StoreError;
use crate::app::model::{Keyset, RobotId, RobotView};
use async_trait::async_trait;

/// A robot to keep; the store counts its version.
#[derive(Debug, Clone)]
pub struct NewRobot {
    /// What is shown of it; `version` is ignored.
    pub view: RobotView,
    /// The URDF.
    pub urdf: String,
}

/// Robots, kept until they are deleted, which no job may use then.
#[async_trait]
pub trait Robots: Send + Sync {
    /// Keeps a robot as the next version of its name.
    async fn insert_robot(&self, new: NewRobot) -> Result<RobotView, StoreError>;
    /// One robot.
    async fn robot(&self, id: &RobotId) -> Result<RobotView, StoreError>;
    /// Its URDF.
    async fn robot_urdf(&self, id: &RobotId) -> Result<String, StoreError>;
    /// Robots.
    async fn robots(&self, keyset: &Keyset) -> Result<Vec<RobotView>, StoreError>;
    /// Deletes a robot that no job names.
    async fn delete_robot(&self, id: &RobotId) -> Result<(), StoreError>;
}
