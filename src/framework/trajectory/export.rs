//! Exports of a checked trajectory: CSV, JSON, and ROS 2 `trajectory_msgs/JointTrajectory` as YAML.

use super::checked::{CheckedTrajectory, Point};
use std::fmt::Write as _;

/// CSV with header: `time_s`, then position, velocity and acceleration of each joint, then the waypoint reached.
#[must_use]
pub fn csv(trajectory: &CheckedTrajectory) -> String {
    let mut text = String::from("time_s");
    for what in ["position", "velocity", "acceleration"] {
        for joint in trajectory.joints() {
            text.push(',');
            text.push_str(&quoted(&format!("{joint}_{what}")));
        }
    }
    text.push_str(",waypoint\n");
    for point in trajectory.points() {
        let _ = write!(text, "{}", point.time_s);
        for value in point.positions.iter().chain(&point.velocities).chain(&point.accelerations) {
            let _ = write!(text, ",{value}");
        }
        match point.waypoint {
            Some(index) => _ = writeln!(text, ",{index}"),
            None => text.push_str(",\n"),
        }
    }
    text
}

/// A CSV field, quoted if necessary.
fn quoted(field: &str) -> String {
    if field.contains(['"', ',', '\n', '\r']) {
        format!("\"{}\"", field.replace('"', "\"\""))
    } else {
        field.to_owned()
    }
}

/// JSON: joints, fixed joints, points, tightest limits, notes.
///
/// # Errors
/// Never for a checked trajectory, whose numbers are finite.
pub fn json(trajectory: &CheckedTrajectory) -> Result<String, serde_json::Error> {
    serde_json::to_string_pretty(trajectory)
}

/// YAML of `trajectory_msgs/msg/JointTrajectory` (ROS 2), as accepted by `ros2 topic pub`. Positions in rad or m.
#[must_use]
pub fn ros2_joint_trajectory(trajectory: &CheckedTrajectory) -> String {
    let names: Vec<String> = trajectory.joints().iter().map(|j| scalar(j)).collect();
    let mut text = format!(
        "header:\n  stamp: {{sec: 0, nanosec: 0}}\n  frame_id: ''\njoint_names: [{}]\npoints:\n",
        names.join(", ")
    );
    for point in trajectory.points() {
        let (seconds, nanoseconds) = stamp(point);
        for (field, values, lead) in [
            ("positions", &point.positions, "-"),
            ("velocities", &point.velocities, " "),
            ("accelerations", &point.accelerations, " "),
        ] {
            let values: Vec<String> = values.iter().map(|v| format!("{v:?}")).collect();
            let _ = writeln!(text, "{lead} {field}: [{}]", values.join(", "));
        }
        let _ = writeln!(text, "  time_from_start: {{sec: {seconds}, nanosec: {nanoseconds}}}");
    }
    text
}

/// A YAML scalar that is always read as a string.
fn scalar(text: &str) -> String {
    format!("'{}'", text.replace('\'', "''"))
}

/// Seconds and nanoseconds, rounded to the nearest nanosecond.
fn stamp(point: &Point) -> (u64, u64) {
    let duration = std::time::Duration::try_from_secs_f64(point.time_s).unwrap_or_default();
    (duration.as_secs(), u64::from(duration.subsec_nanos()))
}
