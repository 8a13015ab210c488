//! Exports of a trajectory: CSV, JSON, and ROS 2 `trajectory_msgs/JointTrajectory` as YAML.
//!
//! A controller moves only the joints that a trajectory names, and a `joint_trajectory_controller` refuses goals that
//! leave out some of its joints. Exports therefore name the held joints too, at their constant position.

use super::checked::CheckedTrajectory;
use super::point::Point;
use super::tightest::Tightest;
use crate::robot::Chain;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Names and joints of an export.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ExportSpec {
    /// Text in front of each joint's name, for example `left_`.
    pub prefix: String,
    /// Names that a controller has for joints, by the robot's own names; the prefix is put in front of them too.
    pub rename: BTreeMap<String, String>,
    /// Whether the held joints are left out.
    pub omit_held: bool,
}

impl ExportSpec {
    /// Checks that the joints of `chain` can have these names.
    ///
    /// # Errors
    /// [`ExportError`] as for [`Exported::new`].
    pub fn check(&self, chain: &Chain) -> Result<(), ExportError> {
        let joints: Vec<String> = chain.genes().iter().map(|gene| gene.name.clone()).collect();
        let fixed_joints = chain.fixed_joints().iter().cloned().collect();
        let empty = Sampled { joints: &joints, fixed_joints: &fixed_joints, points: &[], tightest: &[], notes: &[] };
        Exported::new(empty, self).map(drop)
    }
}

/// Names that make no export.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ExportError {
    /// A name to be replaced belongs to no joint.
    #[error("rename names {joint:?}: name one of {joints:?}")]
    UnknownJoint {
        /// Name given.
        joint: String,
        /// The trajectory's joints.
        joints: Vec<String>,
    },
    /// A joint would have no name.
    #[error("joint {joint:?} would have an empty name: give it another one")]
    Unnamed {
        /// Its name in the trajectory.
        joint: String,
    },
    /// Two joints would have the same name.
    #[error("two joints would be named {name:?}: give each its own name")]
    SameName {
        /// Name in the export.
        name: String,
    },
}

/// A sampled motion.
#[derive(Debug, Clone, Copy)]
pub struct Sampled<'a> {
    /// Joint names, in the order of each point's values.
    pub joints: &'a [String],
    /// Joints held at a constant value, rad or m.
    pub fixed_joints: &'a BTreeMap<String, f64>,
    /// The samples.
    pub points: &'a [Point],
    /// The most used limit of each kind.
    pub tightest: &'a [Tightest],
    /// Assumptions made in planning.
    pub notes: &'a [String],
}

impl<'a> From<&'a CheckedTrajectory> for Sampled<'a> {
    fn from(trajectory: &'a CheckedTrajectory) -> Self {
        Self {
            joints: trajectory.joints(),
            fixed_joints: trajectory.fixed_joints(),
            points: trajectory.points(),
            tightest: trajectory.tightest(),
            notes: trajectory.notes(),
        }
    }
}

/// A motion with the names of an export, ready to be written.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Exported {
    joints: Vec<String>,
    fixed_joints: BTreeMap<String, f64>,
    points: Vec<Row>,
    tightest: Vec<Tightest>,
    notes: Vec<String>,
}

/// One sample; held joints follow the free ones.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct Row {
    time_s: f64,
    positions: Vec<f64>,
    velocities: Vec<f64>,
    accelerations: Vec<f64>,
    waypoint: Option<usize>,
    goal: Option<usize>,
}

impl Exported {
    /// Names the joints of `motion` as `spec` says.
    ///
    /// # Errors
    /// [`ExportError`] if names do not fit the joints, are empty or equal.
    pub fn new<'a>(motion: impl Into<Sampled<'a>>, spec: &ExportSpec) -> Result<Self, ExportError> {
        let Sampled { joints, fixed_joints, points, tightest, notes } = motion.into();
        let all = || joints.iter().chain(fixed_joints.keys());
        if let Some(joint) = spec.rename.keys().find(|name| all().all(|joint| joint != *name)) {
            return Err(ExportError::UnknownJoint { joint: joint.clone(), joints: all().cloned().collect() });
        }
        let held: Vec<(&String, f64)> =
            fixed_joints.iter().filter(|_| !spec.omit_held).map(|(joint, value)| (joint, *value)).collect();
        let named = |joint: &String| format!("{}{}", spec.prefix, spec.rename.get(joint).unwrap_or(joint));
        let names: Vec<String> = joints.iter().chain(held.iter().map(|(joint, _)| *joint)).map(named).collect();
        check_names(&names, all())?;
        let row = |point: &Point| {
            let still = || std::iter::repeat_n(0.0, held.len());
            Row {
                time_s: point.time_s,
                positions: point.positions.iter().copied().chain(held.iter().map(|(_, value)| *value)).collect(),
                velocities: point.velocities.iter().copied().chain(still()).collect(),
                accelerations: point.accelerations.iter().copied().chain(still()).collect(),
                waypoint: point.waypoint,
                goal: point.goal,
            }
        };
        Ok(Self {
            joints: names,
            fixed_joints: fixed_joints.iter().map(|(joint, value)| (named(joint), *value)).collect(),
            points: points.iter().map(row).collect(),
            tightest: tightest.iter().map(|t| Tightest { joint: named(&t.joint), ..t.clone() }).collect(),
            notes: notes.to_vec(),
        })
    }

    /// CSV with header: `time_s`, then position, velocity and acceleration of each joint, then the pose of the run's path
    /// and the goal reached, each from 0.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut text = String::from("time_s");
        for what in ["position", "velocity", "acceleration"] {
            for joint in &self.joints {
                text.push(',');
                text.push_str(&quoted(&format!("{joint}_{what}")));
            }
        }
        text.push_str(",waypoint,goal\n");
        for point in &self.points {
            let _ = write!(text, "{}", point.time_s);
            for value in point.positions.iter().chain(&point.velocities).chain(&point.accelerations) {
                let _ = write!(text, ",{value}");
            }
            for mark in [point.waypoint, point.goal] {
                match mark {
                    Some(index) => _ = write!(text, ",{index}"),
                    None => text.push(','),
                }
            }
            text.push('\n');
        }
        text
    }

    /// JSON: joints, those of them that are held, points, tightest limits, notes.
    ///
    /// # Errors
    /// Never for a checked trajectory, whose numbers are finite.
    pub fn json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string_pretty(self)
    }

    /// YAML of `trajectory_msgs/msg/JointTrajectory` (ROS 2), as accepted by `ros2 topic pub`. Positions in rad or m.
    #[must_use]
    pub fn ros2_joint_trajectory(&self) -> String {
        let names: Vec<String> = self.joints.iter().map(|joint| scalar(joint)).collect();
        let mut text = format!(
            "header:\n  stamp: {{sec: 0, nanosec: 0}}\n  frame_id: ''\njoint_names: [{}]\npoints:\n",
            names.join(", ")
        );
        for point in &self.points {
            let (seconds, nanoseconds) = stamp(point.time_s);
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
}

fn check_names<'a>(names: &[String], joints: impl Iterator<Item = &'a String>) -> Result<(), ExportError> {
    for (index, (name, joint)) in names.iter().zip(joints).enumerate() {
        if name.is_empty() {
            return Err(ExportError::Unnamed { joint: joint.clone() });
        }
        if names[..index].contains(name) {
            return Err(ExportError::SameName { name: name.clone() });
        }
    }
    Ok(())
}

/// A CSV field, quoted if necessary.
fn quoted(field: &str) -> String {
    if field.contains(['"', ',', '\n', '\r']) {
        format!("\"{}\"", field.replace('"', "\"\""))
    } else {
        field.to_owned()
    }
}

/// A YAML scalar that is always read as a string.
fn scalar(text: &str) -> String {
    format!("'{}'", text.replace('\'', "''"))
}

/// Seconds and nanoseconds, rounded to the nearest nanosecond.
fn stamp(time_s: f64) -> (u64, u64) {
    let duration = std::time::Duration::try_from_secs_f64(time_s).unwrap_or_default();
    (duration.as_secs(), u64::from(duration.subsec_nanos()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::preset::shipped;
    use crate::robot::RobotModel;
    use crate::trajectory::{PlanSpec, Waypoint, plan};

    fn waxing() -> CheckedTrajectory {
        let problem = shipped("wax").unwrap().problem;
        let chain = Chain::new(&RobotModel::from_urdf(&problem.urdf).unwrap(), &problem.robot).unwrap();
        let way = Waypoint::goals(&[vec![0.3, 0.1, 0.4], vec![0.0, 0.5, 1.0]]);
        plan(&chain, chain.home(), &way, None, &PlanSpec::default()).unwrap()
    }

    #[test]
    fn exports_hold_every_sample_of_every_joint() {
        let trajectory = waxing();
        let export = Exported::new(&trajectory, &ExportSpec::default()).unwrap();
        let csv = export.csv();
        assert_eq!(csv.lines().count(), trajectory.points().len() + 1);
        assert!(csv.starts_with("time_s,shoulder_pitch_position,shoulder_roll_position,elbow_pitch_position,"));
        let held = trajectory.fixed_joints().len();
        let header: Vec<&str> = csv.lines().next().unwrap().split(',').collect();
        assert_eq!(header.len(), 3 + 3 * (3 + held));
        assert_eq!(header[header.len() - 2..], ["waypoint", "goal"]);
        assert!(held > 0 && header.contains(&"wrist_yaw_position"), "{header:?}");
        let last: Vec<&str> = csv.lines().last().unwrap().split(',').collect();
        assert_eq!((last[1], last[2], last[3], last[header.len() - 1]), ("0", "0.5", "1", "1"));
        let json: serde_json::Value = serde_json::from_str(&export.json().unwrap()).unwrap();
        assert_eq!(json["points"].as_array().unwrap().len(), trajectory.points().len());
        assert_eq!(json["fixed_joints"]["wrist_yaw"], -std::f64::consts::FRAC_PI_4);
        let ros = export.ros2_joint_trajectory();
        assert_eq!(ros.matches("time_from_start").count(), trajectory.points().len());
        assert!(ros.contains("joint_names: ['shoulder_pitch', 'shoulder_roll', 'elbow_pitch', "), "{ros}");
    }

    #[test]
    fn joints_take_the_controllers_names() {
        let trajectory = waxing();
        let spec = ExportSpec {
            prefix: "right_".to_owned(),
            rename: BTreeMap::from([("elbow_pitch".to_owned(), "elbow".to_owned())]),
            omit_held: true,
        };
        let ros = Exported::new(&trajectory, &spec).unwrap().ros2_joint_trajectory();
        assert!(ros.contains("joint_names: ['right_shoulder_pitch', 'right_shoulder_roll', 'right_elbow']"), "{ros}");
        assert!(ros.contains("- positions: [0.0, 0.0, 0.0]\n  velocities: [0.0, 0.0, 0.0]\n"));
        for (from, to, told) in [
            ("knee", "elbow", "rename names \"knee\""),
            ("elbow_pitch", "shoulder_roll", "two joints would be named \"right_shoulder_roll\""),
        ] {
            let rename = BTreeMap::from([(from.to_owned(), to.to_owned())]);
            let error = Exported::new(&trajectory, &ExportSpec { rename, ..spec.clone() }).unwrap_err().to_string();
            assert!(error.starts_with(told), "{error}");
        }
    }
}
