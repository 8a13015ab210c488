//! Exported trajectories against the contract of ROS 2's `joint_trajectory_controller`: the checks that it makes of a
//! `FollowJointTrajectory` goal (`validate_trajectory_msg`, without partial goals and without a velocity at the end),
//! and rest at both ends. Reader and checker share no code with the exporter.

use rstest::rstest;
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

/// A `trajectory_msgs/JointTrajectory`.
struct JointTrajectory {
    joint_names: Vec<String>,
    points: Vec<Point>,
}

#[derive(Default)]
struct Point {
    positions: Vec<f64>,
    velocities: Vec<f64>,
    accelerations: Vec<f64>,
    time_from_start: (i64, i64),
}

/// The items of a flow sequence or mapping of one line.
fn items(text: &str) -> Vec<&str> {
    let inner = text.trim();
    let inner = inner.strip_prefix(['[', '{']).and_then(|text| text.strip_suffix([']', '}'])).unwrap();
    inner.split(',').map(str::trim).filter(|item| !item.is_empty()).collect()
}

fn numbers(text: &str) -> Vec<f64> {
    items(text).into_iter().map(|item| item.parse().unwrap()).collect()
}

fn time(text: &str) -> (i64, i64) {
    let field = |name: &str| {
        let item = items(text).into_iter().find_map(|item| item.strip_prefix(name)?.trim().strip_prefix(':'));
        item.unwrap().trim().parse().unwrap()
    };
    (field("sec"), field("nanosec"))
}

/// Reads the block mapping of a message; every key must be one of the message.
fn read(yaml: &str) -> JointTrajectory {
    let mut message = JointTrajectory { joint_names: Vec::new(), points: Vec::new() };
    for line in yaml.lines() {
        if line.starts_with("- ") {
            message.points.push(Point::default());
        }
        let (key, value) = line.trim_start_matches(['-', ' ']).split_once(':').unwrap();
        match (key, message.points.last_mut()) {
            ("header" | "points", _) => assert_eq!(value, ""),
            ("stamp", None) => assert_eq!(time(value), (0, 0), "a stamp of 0 starts at once"),
            ("frame_id", None) => assert_eq!(value.trim(), "''"),
            ("joint_names", None) => {
                let unquoted = |item: &str| item.strip_prefix('\'').unwrap().strip_suffix('\'').unwrap().to_owned();
                message.joint_names = items(value).into_iter().map(unquoted).collect();
            }
            ("positions", Some(point)) => point.positions = numbers(value),
            ("velocities", Some(point)) => point.velocities = numbers(value),
            ("accelerations", Some(point)) => point.accelerations = numbers(value),
            ("time_from_start", Some(point)) => point.time_from_start = time(value),
            _ => panic!("{line:?} does not belong to a JointTrajectory"),
        }
    }
    message
}

/// Asserts all that a controller of `joints` asks of a goal.
fn check(message: &JointTrajectory, joints: &BTreeSet<String>) {
    let named: BTreeSet<String> = message.joint_names.iter().cloned().collect();
    assert_eq!(named.len(), message.joint_names.len(), "a joint is named twice");
    assert_eq!(&named, joints, "goals must name all joints of the controller and no other");
    assert!(message.points.len() >= 2);
    let mut before = -1;
    for point in &message.points {
        let (seconds, nanoseconds) = point.time_from_start;
        assert!(seconds >= 0 && (0..1_000_000_000).contains(&nanoseconds), "{seconds} s {nanoseconds} ns");
        let time = seconds * 1_000_000_000 + nanoseconds;
        assert!(time > before, "{time} ns is not after {before} ns");
        before = time;
        for values in [&point.positions, &point.velocities, &point.accelerations] {
            assert_eq!(values.len(), joints.len());
            assert!(values.iter().all(|value| value.is_finite()));
        }
    }
    let (first, last) = (&message.points[0], &message.points[message.points.len() - 1]);
    assert_eq!(first.time_from_start, (0, 0));
    for end in [first, last] {
        assert!(end.velocities.iter().chain(&end.accelerations).all(|value| *value == 0.0), "moves at an end");
    }
}

/// All joints that can move, as a controller of the arm has them.
fn movable(urdf: &Path, named: impl Fn(&str) -> String) -> BTreeSet<String> {
    let text = std::fs::read_to_string(urdf).unwrap();
    let document = roxmltree::Document::parse(&text).unwrap();
    let joints =
        document.descendants().filter(|node| node.has_tag_name("joint") && node.attribute("type") != Some("fixed"));
    joints.map(|joint| named(joint.attribute("name").unwrap())).collect()
}

#[rstest]
#[case::three_joints_of_six("wax", "teo_right_arm", &[])]
#[case::passing_through_the_goals("wax-left", "teo_left_arm", &["--blend", "--speed", "1", "--acceleration", "1"])]
#[case::seven_joints("circle-seven-joints", "seven_joint_arm", &["--dwell", "0", "--sample", "0.001"])]
fn a_controller_accepts_the_export(#[case] preset: &str, #[case] robot: &str, #[case] options: &[&str]) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let out = tempfile::tempdir().unwrap();
    let search =
        ["run", "--preset", preset, "--method", "sst", "--max-evaluations-per-goal", "30", "--repetitions", "2"];
    let names = ["--prefix", "arm_", "--rename", "joint_1=base", "--rename", "shoulder_pitch=shoulder"];
    // A name that is not a joint of this robot is refused, so each robot gets its own.
    let rename = if robot == "seven_joint_arm" { &names[..4] } else { &[names[0], names[1], names[4], names[5]][..] };
    let output = Command::new(env!("CARGO_BIN_EXE_cgda"))
        .args(search.iter().chain(options).chain(rename))
        .arg("--out")
        .arg(out.path())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let renamed = |joint: &str| match joint {
        "joint_1" => "arm_base".to_owned(),
        "shoulder_pitch" => "arm_shoulder".to_owned(),
        other => format!("arm_{other}"),
    };
    let joints = movable(&root.join(format!("examples/robots/{robot}.urdf")), renamed);
    let files = std::fs::read_dir(out.path()).unwrap().map(|entry| entry.unwrap().path());
    let files: Vec<_> = files.filter(|file| file.extension().is_some_and(|ending| ending == "yaml")).collect();
    assert_eq!(files.len(), 2);
    for file in files {
        let message = read(&std::fs::read_to_string(file).unwrap());
        check(&message, &joints);
        assert!(message.points.len() > 100);
    }
}

#[test]
#[should_panic(expected = "goals must name all joints")]
fn a_partial_goal_is_refused() {
    let yaml = "joint_names: ['a']\npoints:\n- positions: [0.0]\n  velocities: [0.0]\n  accelerations: [0.0]\n  \
                time_from_start: {sec: 0, nanosec: 0}\n";
    check(&read(yaml), &BTreeSet::from(["a".to_owned(), "b".to_owned()]));
}
