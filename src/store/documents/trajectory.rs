//! A trajectory with its points.

use super::{complete, document, unchanged, versions};
use crate::app::model::{JobId, RobotId, RunId, Timestamp, TrajectoryId, TrajectoryPoint, TrajectoryView};
use crate::framework::trajectory::{LimitKind, Tightest};
use serde_json::Value;
use std::collections::BTreeMap;

document! {
    /// A trajectory with its points.
    Trajectory keeps TrajectoryView {
        id: TrajectoryId,
        run: RunId,
        job: JobId,
        robot: RobotId,
        joint_names: Vec<String>,
        fixed_joints: BTreeMap<String, f64>,
        duration_s: f64,
        pose_times_s: Vec<f64>,
        goal_times_s: Vec<f64>,
        notes: Vec<String>,
        sha256: String,
        created_at: Timestamp,
    }
    each { points: Point, tightest: UsedLimit, }
}
versions! { Trajectory keeps TrajectoryView, "trajectory", [unchanged, with_poses] }

/// Version 1 of the builds whose trajectories had one pose per goal.
fn with_poses(mut trajectory: Value) -> Value {
    let goal_times_s = trajectory.get("goal_times_s").cloned().unwrap_or_default();
    complete(&mut trajectory, "pose_times_s", goal_times_s);
    trajectory
}

document! {
    /// A point of a trajectory.
    Point keeps TrajectoryPoint {
        t_s: f64,
        positions: Vec<f64>,
        velocities: Vec<f64>,
        accelerations: Vec<f64>,
    }
}

document! {
    /// The most used limit of one kind.
    UsedLimit keeps Tightest {
        kind: LimitKind,
        joint: String,
        time_s: f64,
        value: f64,
        limit: f64,
        ratio: f64,
    }
}
