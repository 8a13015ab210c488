//! Plans respect limits everywhere on the curve and are smooth; what is invalid is rejected.

use super::*;
use crate::preset::shipped;
use crate::robot::{Chain, RobotModel, RobotSpec};
use proptest::prelude::*;
use std::collections::BTreeMap;
use std::fmt::Write as _;

fn arm() -> Chain {
    let problem = shipped("wax").unwrap().problem;
    Chain::new(&RobotModel::from_urdf(&problem.urdf).unwrap(), &problem.robot).unwrap()
}

/// Everything at its limit, without a rest.
fn fastest() -> PlanSpec {
    PlanSpec { speed: 1.0, acceleration: 1.0, dwell_s: 0.0, ..PlanSpec::default() }
}

/// A joint of a random arm: prismatic, half its range, velocity, acceleration and jerk limits.
type Joint = (bool, f64, f64, Option<f64>, Option<f64>);

fn chain_of(joints: &[Joint]) -> Chain {
    let mut urdf = String::from("<robot name=\"random\"><link name=\"l0\"/>");
    let mut spec = RobotSpec::default();
    for (index, (prismatic, half, velocity, acceleration, jerk)) in joints.iter().enumerate() {
        let (name, kind) = (format!("j{index}"), if *prismatic { "prismatic" } else { "revolute" });
        let _ = write!(
            urdf,
            "<link name=\"l{}\"/><joint name=\"{name}\" type=\"{kind}\"><parent link=\"l{index}\"/><child \
             link=\"l{}\"/><axis xyz=\"0 0 1\"/><origin xyz=\"0.1 0 0\"/><limit lower=\"-{half}\" upper=\"{half}\" \
             velocity=\"{velocity}\" effort=\"1\"/></joint>",
            index + 1,
            index + 1
        );
        spec.acceleration.extend(acceleration.map(|value| (name.clone(), value)));
        spec.jerk.extend(jerk.map(|value| (name.clone(), value)));
    }
    Chain::new(&RobotModel::from_urdf(&(urdf + "</robot>")).unwrap(), &spec).unwrap()
}

fn arms() -> impl Strategy<Value = Vec<Joint>> {
    let limit = || prop::option::of(0.5..20.0_f64);
    let joint = (any::<bool>(), 0.1..3.0_f64, 0.2..4.0_f64, limit(), prop::option::of(2.0..200.0_f64));
    prop::collection::vec(joint, 3..=7)
}

/// Positions as shares of half the range, with repeated poses, resting joints and limits touched now and then.
fn ways() -> impl Strategy<Value = Vec<(Vec<f64>, bool, bool)>> {
    let share = prop_oneof![4 => -1.0..1.0_f64, 1 => Just(1.0), 1 => Just(-1.0), 2 => Just(0.25)];
    prop::collection::vec((prop::collection::vec(share, 7), any::<bool>(), any::<bool>()), 1..8)
}

fn specs() -> impl Strategy<Value = PlanSpec> {
    (0.05..1.0_f64, 0.05..1.0_f64, prop_oneof![Just(0.0), 0.01..0.5_f64], any::<bool>(), any::<bool>()).prop_map(
        |(speed, acceleration, dwell_s, blend, keeps_time)| PlanSpec {
            speed,
            acceleration,
            dwell_s,
            blend,
            timing: if keeps_time { Timing::Demonstration } else { Timing::Limits },
            ..PlanSpec::default()
        },
    )
}

/// Value of a polynomial's derivative of some order, term by term: the oracle shares no code with the checker.
fn derivative(coefficients: &[f64; 6], order: u32, t: f64) -> f64 {
    let term = |(power, coefficient): (u32, &f64)| {
        let falling: f64 = (power - order + 1..=power).map(f64::from).product();
        coefficient * falling * t.powf(f64::from(power - order))
    };
    (0..).zip(coefficients).skip(order as usize).map(term).sum()
}

/// Asserts that the curve is continuous up to its acceleration and within `shares` of the limits, looking every
/// millisecond and at both ends of each piece.
fn assert_within(chain: &Chain, limits: &[JointLimits], trajectory: &CheckedTrajectory, shares: [f64; 4]) {
    let mut time_s = 0.0;
    let mut before: Option<Vec<[f64; 3]>> = None;
    for piece in trajectory.pieces() {
        assert!((piece.start_s - time_s).abs() < 1e-9, "a gap at {time_s} s");
        let steps = (piece.duration_s / 1e-3).ceil();
        let mut end = Vec::new();
        for (joint, limit) in limits.iter().enumerate() {
            let c = &piece.joints[joint].0;
            let scale = [1.0, limit.velocity, limit.acceleration];
            let rest = [derivative(c, 0, 0.0), 0.0, 0.0];
            let left = before.as_ref().map_or(rest, |all| all[joint]);
            for order in 0..3 {
                let gap = derivative(c, order, 0.0) - left[order as usize];
                assert!(
                    gap.abs() < 1e-6 * scale[order as usize],
                    "order {order} of {joint} jumps by {gap} at {time_s} s"
                );
            }
            for step in (0_u32..).map(f64::from).take_while(|&step| step <= steps) {
                let t = piece.duration_s * step / steps;
                let q = derivative(c, 0, t);
                let (middle, half) = (f64::midpoint(limit.lower, limit.upper), (limit.upper - limit.lower) / 2.0);
                let used = [
                    (q - middle).abs() / half,
                    derivative(c, 1, t).abs() / limit.velocity,
                    derivative(c, 2, t).abs() / limit.acceleration,
                    derivative(c, 3, t).abs() / limit.jerk,
                ];
                for (order, (used, share)) in used.into_iter().zip(shares).enumerate() {
                    assert!(
                        used <= share * (1.0 + 1e-8),
                        "order {order} of {}: {used} of {share}",
                        chain.genes()[joint].name
                    );
                }
            }
            end.push([0, 1, 2].map(|order| derivative(c, order, piece.duration_s)));
        }
        before = Some(end);
        time_s += piece.duration_s;
    }
    for (end, limit) in before.unwrap().iter().zip(limits) {
        assert!(end[1].abs() < 1e-6 * limit.velocity && end[2].abs() < 1e-6 * limit.acceleration, "moves at the end");
    }
    assert!((time_s - trajectory.duration_s()).abs() < 1e-6);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn plans_pass_their_waypoints_within_the_limits(joints in arms(), way in ways(), spec in specs(), interval_s in 0.1..3.0_f64) {
        let chain = chain_of(&joints);
        let mut goals = 0..;
        let waypoints: Vec<Waypoint> = way.iter().map(|(shares, is_goal, rest)| Waypoint {
            joints: shares.iter().zip(&joints).map(|(share, joint)| share * joint.1).collect(),
            goal: is_goal.then(|| goals.next().unwrap()),
            rest: *rest,
        }).collect();
        let trajectory = plan(&chain, chain.home(), &waypoints, Some(interval_s), &spec).unwrap();
        let times_s = trajectory.waypoint_times_s();
        prop_assert_eq!(times_s.len(), waypoints.len());
        for (time_s, waypoint) in times_s.iter().zip(&waypoints) {
            let point = trajectory.points().iter().find(|point| point.time_s == *time_s).unwrap();
            for (at, curve) in [&point.positions, &trajectory.positions_at(*time_s)].into_iter().flatten().zip(waypoint.joints.iter().cycle()) {
                prop_assert!((at - curve).abs() < 1e-12);
            }
            if !spec.blend {
                prop_assert!(point.velocities.iter().chain(&point.accelerations).all(|v| *v == 0.0));
            }
        }
        assert_within(&chain, &limits(&chain).0, &trajectory, [1.0, spec.speed, spec.acceleration, spec.acceleration]);
        for point in trajectory.points() {
            let curve = trajectory.positions_at(point.time_s);
            prop_assert!(point.positions.iter().zip(&curve).all(|(a, b)| (a - b).abs() < 1e-12));
        }
        let goal_times_s = trajectory.goal_times_s();
        if spec.timing == Timing::Demonstration && trajectory.notes().iter().all(|note| !note.contains("too fast")) {
            for (goal, time_s) in goal_times_s.iter().enumerate() {
                let wanted_s = (goal as f64 + 1.0) * interval_s;
                prop_assert!((time_s - wanted_s).abs() < 1e-6 * wanted_s, "goal {} at {} s, not {} s", goal, time_s, wanted_s);
            }
        }
    }
}

#[test]
fn a_segment_takes_the_least_time_of_its_tightest_joint() {
    let chain = arm();
    // 1.2 rad at 3 rad/s, 6 rad/s^2 and 20 rad/s^3: Tj = 6/20 = 0.3 s, Ta = 0.15 + sqrt(0.15^2 + 1.2/6) = 0.621699 s,
    // and 6 (Ta - Tj) = 1.93 rad/s stay below 3 rad/s: 2 Ta = 1.243398 s. The other joint moves a sixth of that way.
    let trajectory = plan(&chain, &[0.0; 3], &Waypoint::goals(&[vec![1.2, 0.2, 0.0]]), None, &fastest()).unwrap();
    assert!((trajectory.duration_s() - 1.243_398_113_205_66).abs() < 1e-12, "{}", trajectory.duration_s());
    for kind in [LimitKind::Acceleration, LimitKind::Jerk] {
        let used = trajectory.tightest().iter().find(|t| t.kind == kind).unwrap();
        assert!((used.ratio - 1.0).abs() < 1e-9 && used.joint == "shoulder_pitch", "{used:?}");
    }
    assert_eq!(trajectory.pieces().len(), 6);
}

#[test]
fn by_default_half_the_limits_are_used_and_the_arm_stops_at_each_goal() {
    let chain = arm();
    let way = Waypoint::goals(&[vec![1.0, 0.2, 0.0], vec![0.0, 0.4, 0.9]]);
    let trajectory = plan(&chain, chain.home(), &way, None, &PlanSpec::default()).unwrap();
    for used in trajectory.tightest().iter().filter(|used| used.kind != LimitKind::Position) {
        assert!(used.ratio <= 0.5 + 1e-9, "{used:?}");
    }
    let held = trajectory.points().windows(2).find(|pair| pair[0].positions == pair[1].positions).unwrap();
    assert!((held[1].time_s - held[0].time_s - 0.1).abs() < 1e-9 && held[0].goal == Some(0));
}

#[test]
fn blending_is_faster_and_stops_only_at_the_end() {
    let chain = arm();
    let poses: Vec<Vec<f64>> = (1..=6).map(|i| vec![0.2 * f64::from(i), 0.1 * f64::from(i), 0.3]).collect();
    let way = Waypoint::goals(&poses);
    let stopping = plan(&chain, chain.home(), &way, None, &fastest()).unwrap();
    let blending = plan(&chain, chain.home(), &way, None, &PlanSpec { blend: true, ..fastest() }).unwrap();
    assert!(blending.duration_s() < 0.75 * stopping.duration_s(), "{} s", blending.duration_s());
    let reached: Vec<&Point> = blending.points().iter().filter(|point| point.goal.is_some()).collect();
    assert!(reached[..5].iter().all(|point| point.velocities[0] > 0.1), "{reached:?}");
    assert_eq!(reached[5].velocities, [0.0; 3]);
}

#[test]
fn a_demonstration_of_9_9_s_takes_9_9_s_again_unless_the_limits_forbid_it() {
    let chain = arm();
    let poses: Vec<Vec<f64>> = (0..9).map(|i| vec![0.1 * f64::from(i), 0.1, 0.1]).collect();
    let way = Waypoint::goals(&poses);
    for blend in [false, true] {
        let spec = PlanSpec { timing: Timing::Demonstration, blend, ..PlanSpec::default() };
        let trajectory = plan(&chain, chain.home(), &way, Some(1.1), &spec).unwrap();
        assert!(
            (trajectory.duration_s() - 9.9).abs() < 0.01,
            "{} s, {:?}",
            trajectory.duration_s(),
            trajectory.notes()
        );
        let hasty = plan(&chain, chain.home(), &way, Some(0.3), &spec).unwrap();
        assert!(hasty.duration_s() > 2.7 && hasty.notes().last().unwrap().contains("too fast for the limits"));
        let unknown = plan(&chain, chain.home(), &way, None, &spec).unwrap();
        assert!(unknown.notes().last().unwrap().contains("the limits decide"), "{:?}", unknown.notes());
    }
}

#[test]
fn a_pose_outside_the_limits_is_told_with_joint_value_and_limit() {
    let chain = arm();
    for blend in [false, true] {
        let spec = PlanSpec { blend, ..PlanSpec::default() };
        let error = plan(&chain, &[0.0; 3], &Waypoint::goals(&[vec![0.0, 2.0, 0.0]]), None, &spec).unwrap_err();
        let TrajectoryError::Limit { kind, joint, limit, .. } = &error else { panic!("{error}") };
        assert_eq!((*kind, joint.as_str()), (LimitKind::Position, "shoulder_roll"));
        assert!((limit - 100.0_f64.to_radians()).abs() < 1e-12);
    }
}

#[test]
fn refuses_shapes_and_parameters() {
    let chain = arm();
    let default = PlanSpec::default();
    let to = |pose: Vec<f64>| Waypoint::goals(&[pose]);
    assert_eq!(plan(&chain, &[0.0; 3], &[], None, &default), Err(TrajectoryError::Empty));
    let ragged = plan(&chain, &[0.0; 2], &to(vec![0.0; 3]), None, &default);
    assert!(matches!(ragged, Err(TrajectoryError::Ragged { .. })));
    let nan = plan(&chain, &[0.0; 3], &to(vec![0.0, f64::NAN, 0.0]), None, &default);
    assert!(matches!(nan, Err(TrajectoryError::NonFinite { .. })));
    let slow = PlanSpec { sample_s: 1e-4, speed: 1e-3, ..default.clone() };
    let far = plan(&chain, &[0.0; 3], &to(vec![1.7; 3]), None, &slow).unwrap_err().to_string();
    assert!(far.contains("million samples"), "{far}");
    let fast = PlanSpec { speed: 1.5, ..default };
    assert!(matches!(plan(&chain, &[0.0; 3], &to(vec![0.0; 3]), None, &fast), Err(TrajectoryError::Plan(_))));
}

#[test]
fn a_joints_own_limit_lowers_the_stated_one_and_replaces_the_assumed_one() {
    let chain = arm();
    let own = |joint: &str, limits: MotionLimits| PlanSpec {
        joint_limits: BTreeMap::from([(joint.to_owned(), limits)]),
        ..fastest()
    };
    let way = Waypoint::goals(&[vec![1.0, 0.2, 0.0]]);
    let slower = own("shoulder_pitch", MotionLimits { velocity: Some(0.1), ..MotionLimits::default() });
    assert!(plan(&chain, &[0.0; 3], &way, None, &slower).unwrap().duration_s() > 10.0);
    let jerky = own("shoulder_pitch", MotionLimits { jerk: Some(1000.0), ..MotionLimits::default() });
    let trajectory = plan(&chain, &[0.0; 3], &way, None, &jerky).unwrap();
    assert!(
        trajectory.duration_s() < 1.0 && trajectory.notes().iter().all(|note| !note.contains("shoulder_pitch")),
        "{trajectory:?}"
    );
    for (spec, place, told) in [
        (
            own("shoulder_pitch", MotionLimits { velocity: Some(4.0), ..MotionLimits::default() }),
            vec!["joint_limits", "shoulder_pitch", "velocity"],
            "give more than 0 and at most 3 rad/s or m/s",
        ),
        (own("wrist", MotionLimits::default()), vec!["joint_limits", "wrist"], "name one of the free joints"),
        (PlanSpec { dwell_s: -1.0, ..fastest() }, vec!["dwell_s"], "give 0 to 60 s"),
        (PlanSpec { acceleration: f64::NAN, ..fastest() }, vec!["acceleration"], "give 0.001 to 1"),
    ] {
        let error = spec.check(&chain).unwrap_err();
        assert_eq!(error.place(), place);
        assert!(error.to_string().contains(told), "{error}");
    }
}

#[test]
fn assumed_limits_are_noted() {
    let urdf = shipped("wax").unwrap().problem.urdf.replace(r#" velocity="3""#, "");
    let chain = Chain::new(&RobotModel::from_urdf(&urdf).unwrap(), &RobotSpec::default()).unwrap();
    let trajectory = plan(&chain, chain.home(), &Waypoint::goals(&[vec![0.1; 6]]), None, &PlanSpec::default()).unwrap();
    assert_eq!(trajectory.notes().len(), 18);
    assert!(trajectory.notes()[0].contains("no velocity limit: 0.5 rad/s assumed"), "{:?}", trajectory.notes());
    assert!(trajectory.notes()[2].contains("no jerk limit: 20 rad/s^3 assumed"), "{:?}", trajectory.notes());
}

#[test]
fn standing_still_is_a_trajectory() {
    let chain = arm();
    for blend in [false, true] {
        let spec = PlanSpec { blend, ..PlanSpec::default() };
        let trajectory = plan(&chain, &[0.1; 3], &Waypoint::goals(&[vec![0.1; 3]]), None, &spec).unwrap();
        assert_eq!((trajectory.points().len(), trajectory.points()[0].waypoint), (2, Some(0)));
    }
}
