//! A trajectory with its points.

use super::{document, unchanged, versions};
use crate::app::model::{JobId, RobotId, RunId, Timestamp, TrajectoryId, TrajectoryPoint, TrajectoryView};
use crate::framework::trajectory::Tightest;
use std::collections::BTreeMap;

document! {
    /// A trajectory.
    Trajectory keeps TrajectoryView {
        id: TrajectoryId,
        run: RunId,
        job: JobId,
        robot: RobotId,
        joint_names: Vec<String>,
        fixed_joints: BTreeMap<String, f64>,
        duration_s: f64,
        goal_times_s: Vec<f64>,
        tightest: Vec<Tightest>,
        notes: Vec<String>,
        sha256: String,
        created_at: Timestamp,
    }
    each { points: Point, }
}
versions! { Trajectory keeps TrajectoryView, "trajectory", [unchanged] }

document! {
    /// A point of a trajectory.
    Point keeps TrajectoryPoint {
        t_s: f64,
        positions: Vec<f64>,
        velocities: Vec<f64>,
        accelerations: Vec<f64>,
    }
}
