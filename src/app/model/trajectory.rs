//! Trajectories, as shown.

use super::id::{JobId, RobotId, RunId, TrajectoryId};
use super::time::Timestamp;
use crate::framework::trajectory::Tightest;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use utoipa::ToSchema;

/// A time-parameterised joint trajectory that passed all checks.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct TrajectoryView {
    /// Id of the trajectory.
    pub id: TrajectoryId,
    /// Run it was planned for.
    pub run: RunId,
    /// Id of the job.
    pub job: JobId,
    /// Robot it is valid for.
    pub robot: RobotId,
    /// Free joints, in the order of `positions`.
    pub joint_names: Vec<String>,
    /// Joints of the chain held at a constant value throughout, rad or m.
    pub fixed_joints: BTreeMap<String, f64>,
    /// Duration, seconds.
    pub duration_s: f64,
    /// Points in order of time; the first is at 0 s.
    pub points: Vec<TrajectoryPoint>,
    /// Times at which the poses of the run's path are reached, seconds from the start.
    pub pose_times_s: Vec<f64>,
    /// Times at which the goals are reached, seconds from the start; of goals that one pose serves, the same.
    pub goal_times_s: Vec<f64>,
    /// The most used limit of each kind.
    pub tightest: Vec<Tightest>,
    /// Assumptions made in planning.
    pub notes: Vec<String>,
    /// SHA-256 of the points' bits, hexadecimal.
    pub sha256: String,
    /// Creation time.
    pub created_at: Timestamp,
}

/// One point of a trajectory.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct TrajectoryPoint {
    /// Time from the start, seconds.
    pub t_s: f64,
    /// Joint positions, rad or m.
    pub positions: Vec<f64>,
    /// Joint velocities, rad/s or m/s.
    pub velocities: Vec<f64>,
    /// Joint accelerations, rad/s^2 or m/s^2.
    pub accelerations: Vec<f64>,
}
