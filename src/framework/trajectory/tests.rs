//! Plans respect limits and are smooth; invalid input is rejected; exports contain every sample.

use super::*;
use crate::preset::shipped;
use crate::robot::{Chain, RobotModel, RobotSpec};
use proptest::prelude::*;

fn arm() -> Chain {
    let problem = shipped("wax").unwrap().problem;
    Chain::new(&RobotModel::from_urdf(&problem.urdf).unwrap(), &problem.robot).unwrap()
}

fn poses() -> impl Strategy<Value = Vec<Vec<f64>>> {
    prop::collection::vec(prop::collection::vec(-0.26..1.74_f64, 3), 1..6)
}

proptest! {
    #[test]
    fn plans_pass_their_waypoints_at_rest_within_the_limits(waypoints in poses(), speed in 0.1..1.0_f64) {
        let chain = arm();
        let spec = PlanSpec { speed, ..PlanSpec::default() };
        let trajectory = plan(&chain, chain.home(), &waypoints, &spec).unwrap();
        let reached: Vec<&Point> = trajectory.points().iter().filter(|p| p.waypoint.is_some()).collect();
        prop_assert_eq!(reached.len(), waypoints.len());
        for (point, waypoint) in reached.iter().zip(&waypoints) {
            prop_assert_eq!(&point.positions, waypoint);
            prop_assert!(point.velocities.iter().all(|v| *v == 0.0));
        }
        for tightest in trajectory.tightest() {
            let most = if tightest.kind == LimitKind::Position { 1.0 } else { speed };
            prop_assert!(tightest.ratio <= most + 1e-9, "{:?}", tightest);
        }
        for joint in 0..3 {
            for pair in trajectory.points().windows(2) {
                let dt = pair[1].time_s - pair[0].time_s;
                let moved = pair[1].positions[joint] - pair[0].positions[joint];
                let mean = f64::midpoint(pair[0].velocities[joint], pair[1].velocities[joint]);
                // trapezoid rule over 0.02 s with jerk below 60 |dq| / T^3
                prop_assert!((moved - mean * dt).abs() < 1e-3, "{} against {}", moved, mean * dt);
            }
        }
    }
}

#[test]
fn a_segment_takes_the_least_time_of_its_tightest_joint() {
    let chain = arm();
    // 1 rad at 3 rad/s and 6 rad/s^2: 1.875 / 3 = 0.625 s and sqrt(5.7735 / 6) = 0.98095 s
    let spec = PlanSpec { dwell_s: 0.0, ..PlanSpec::default() };
    let trajectory = plan(&chain, &[0.0; 3], &[vec![1.0, 0.2, 0.0]], &spec).unwrap();
    assert!((trajectory.duration_s() - 0.980_95).abs() < 1e-4, "{}", trajectory.duration_s());
    let used = trajectory.tightest().iter().find(|t| t.kind == LimitKind::Acceleration).unwrap();
    assert!(used.ratio > 0.99 && used.joint == "shoulder_pitch", "{used:?}");
}

#[test]
fn a_pose_outside_the_limits_is_told_with_joint_value_and_limit() {
    let chain = arm();
    let error = plan(&chain, &[0.0; 3], &[vec![0.0, 2.0, 0.0]], &PlanSpec::default()).unwrap_err();
    let TrajectoryError::Limit { kind, joint, limit, .. } = &error else { panic!("{error}") };
    assert_eq!((*kind, joint.as_str()), ("position", "shoulder_roll"));
    assert!((limit - 100.0_f64.to_radians()).abs() < 1e-12);
}

#[test]
fn refuses_shapes_and_parameters() {
    let chain = arm();
    let default = PlanSpec::default();
    assert_eq!(plan(&chain, &[0.0; 3], &[], &default), Err(TrajectoryError::Empty));
    assert!(matches!(plan(&chain, &[0.0; 2], &[vec![0.0; 3]], &default), Err(TrajectoryError::Ragged { .. })));
    let nan = plan(&chain, &[0.0; 3], &[vec![0.0, f64::NAN, 0.0]], &default);
    assert!(matches!(nan, Err(TrajectoryError::NonFinite { .. })));
    let slow = PlanSpec { sample_s: 1e-4, speed: 1e-3, ..default };
    let far = plan(&chain, &[0.0; 3], &[vec![1.7; 3], vec![0.0; 3]], &slow).unwrap_err().to_string();
    assert!(far.contains("million samples"), "{far}");
    let fast = PlanSpec { speed: 1.5, ..default };
    assert!(matches!(plan(&chain, &[0.0; 3], &[vec![0.0; 3]], &fast), Err(TrajectoryError::OutOfRange(_))));
}

#[test]
fn assumed_limits_are_noted() {
    let urdf = shipped("wax").unwrap().problem.urdf.replace(r#" velocity="3""#, "");
    let chain = Chain::new(&RobotModel::from_urdf(&urdf).unwrap(), &RobotSpec::default()).unwrap();
    let trajectory = plan(&chain, chain.home(), &[vec![0.1; 6]], &PlanSpec::default()).unwrap();
    assert_eq!(trajectory.notes().len(), 12);
    assert!(trajectory.notes()[0].contains("no velocity limit: 0.5 rad/s assumed"), "{:?}", trajectory.notes());
}

#[test]
fn standing_still_is_a_trajectory() {
    let chain = arm();
    let trajectory = plan(&chain, &[0.1; 3], &[vec![0.1; 3]], &PlanSpec::default()).unwrap();
    assert_eq!(trajectory.points().len(), 2);
    assert_eq!(trajectory.points()[0].waypoint, Some(0));
}

#[test]
fn exports_hold_every_sample() {
    let chain = arm();
    let waypoints = vec![vec![0.3, 0.1, 0.4], vec![0.0, 0.5, 1.0]];
    let trajectory = plan(&chain, chain.home(), &waypoints, &PlanSpec::default()).unwrap();
    let csv = export::csv(&trajectory);
    assert_eq!(csv.lines().count(), trajectory.points().len() + 1);
    assert!(csv.starts_with("time_s,shoulder_pitch_position,shoulder_roll_position,elbow_pitch_position,"));
    let last: Vec<&str> = csv.lines().last().unwrap().split(',').collect();
    assert_eq!((last[1], last[2], last[3], last[10]), ("0", "0.5", "1", "1"));
    let json: serde_json::Value = serde_json::from_str(&export::json(&trajectory).unwrap()).unwrap();
    assert_eq!(json["points"].as_array().unwrap().len(), trajectory.points().len());
    assert_eq!(json["fixed_joints"]["wrist_yaw"], -std::f64::consts::FRAC_PI_4);
    let ros = export::ros2_joint_trajectory(&trajectory);
    assert_eq!(ros.matches("time_from_start").count(), trajectory.points().len());
    assert!(ros.contains("joint_names: ['shoulder_pitch', 'shoulder_roll', 'elbow_pitch']"));
    assert!(ros.contains("- positions: [0.0, 0.0, 0.0]\n  velocities: [0.0, 0.0, 0.0]\n"));
}
