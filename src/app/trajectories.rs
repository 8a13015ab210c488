//! Trajectories: checked joint trajectories of runs.

use crate::app::demonstrations::Export;
use crate::app::id::{JobId, RobotId, RunId, TrajectoryId};
use crate::app::{App, AppError, Timestamp, unknown_format};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// A time-parameterised joint trajectory that passed its check.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct TrajectoryView {
    /// Its id.
    pub id: TrajectoryId,
    /// The run it was made of.
    pub run: RunId,
    /// The job.
    pub job: JobId,
    /// The robot it fits.
    pub robot: RobotId,
    /// Free joints, in the order of `positions`.
    pub joint_names: Vec<String>,
    /// Duration, seconds.
    pub duration_s: f64,
    /// Points; the first at 0 s.
    pub points: Vec<TrajectoryPoint>,
    /// Times at which the goals are reached, seconds.
    pub goal_times_s: Vec<f64>,
    /// SHA-256 of the points' bits, hexadecimal.
    pub sha256: String,
    /// When it was made.
    pub created_at: Timestamp,
}

/// One point of a trajectory.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct TrajectoryPoint {
    /// Time from the start, seconds.
    pub t_s: f64,
    /// rad or m.
    pub positions: Vec<f64>,
    /// rad/s or m/s.
    pub velocities: Vec<f64>,
    /// rad/s^2 or m/s^2.
    pub accelerations: Vec<f64>,
}

impl App {
    /// One trajectory with its points.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn get_trajectory(&self, id: &TrajectoryId) -> Result<TrajectoryView, AppError> {
        Ok(self.ports.store.trajectory(id).await?)
    }

    /// The trajectory as `csv`, `json` or `ros2`.
    ///
    /// # Errors
    /// `NotFound`; `Malformed` format.
    pub async fn export_trajectory(&self, id: &TrajectoryId, format: &str) -> Result<Export, AppError> {
        let trajectory = self.get_trajectory(id).await?;
        match format {
            "json" => {
                let bytes = serde_json::to_vec(&trajectory).map_err(AppError::internal)?;
                Ok(Export::new("application/json", id.as_str(), "json", bytes))
            }
            other => Err(unknown_format(other, "csv, json or ros2")),
        }
    }
}
