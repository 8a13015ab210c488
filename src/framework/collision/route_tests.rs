//! Routes of a gantry among walls and of a crane around a post.

use super::*;
use crate::robot::{Chain, RobotModel, RobotSpec};

/// A ball that two slides of 1 m each way carry along x and y.
const GANTRY: &str = r#"<robot name="gantry"><link name="floor"/><link name="bridge"/>
    <link name="ball"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>
    <joint name="x" type="prismatic"><parent link="floor"/><child link="bridge"/><axis xyz="1 0 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
    <joint name="y" type="prismatic"><parent link="bridge"/><child link="ball"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>"#;

/// A slide along x and a turn about z, which carries a ball 1 m away.
const CRANE: &str = r#"<robot name="crane"><link name="rail"/><link name="trolley"/>
    <link name="arm"><collision><origin xyz="1 0 0"/><geometry><sphere radius="0.05"/></geometry></collision></link>
    <joint name="slide" type="prismatic"><parent link="rail"/><child link="trolley"/><axis xyz="1 0 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
    <joint name="turn" type="revolute"><parent link="trolley"/><child link="arm"/><axis xyz="0 0 1"/>
    <limit lower="-1.5" upper="1.5" effort="1" velocity="1"/></joint></robot>"#;

/// A wall along x from `from` to `to`, 0.1 m thick, at height y.
fn wall(name: &str, y: f64, from: f64, to: f64) -> Obstacle {
    let size_m = [to - from, 0.1, 1.0];
    let shape = BoxObstacle { size_m, center_m: [f64::midpoint(from, to), y, 0.0], rpy_rad: [0.0; 3] };
    Obstacle { name: name.to_owned(), shape: ObstacleShape::Box(shape) }
}

fn built(urdf: &str, obstacles: &[Obstacle]) -> CollisionModel {
    let model = RobotModel::from_urdf(urdf).unwrap();
    let chain = Chain::new(&model, &RobotSpec::default()).unwrap();
    CollisionModel::new(&model, &chain, obstacles, &CollisionOptions::default()).unwrap()
}

/// The route, each part of which is checked anew.
fn checked(model: &CollisionModel, from: &[f64], to: &[f64], seed: u64) -> Vec<Vec<f64>> {
    let found = route(model, from, to, seed, &RouteBudget::default()).unwrap();
    let mut workspace = model.workspace();
    let mut at = from.to_vec();
    for next in found.iter().map(Vec::as_slice).chain([to]) {
        assert_eq!(model.check_motion(&at, next, &mut workspace), None, "{at:?} to {next:?} of {found:?}");
        at = next.to_vec();
    }
    found
}

#[test]
fn a_free_motion_needs_no_via_point() {
    let model = built(GANTRY, &[wall("wall", 0.5, -1.5, 1.5)]);
    assert!(checked(&model, &[-0.5, -0.5], &[0.5, 0.3], 1).is_empty());
}

#[test]
fn one_via_point_leads_around_a_post() {
    let post = SphereObstacle { center_m: [1.0, 0.0, 0.0], radius_m: 0.1 };
    let post = Obstacle { name: "post".to_owned(), shape: ObstacleShape::Sphere(post) };
    let model = built(CRANE, &[post]);
    let (from, to) = ([0.0, -0.6], [0.0, 0.6]);
    assert!(model.check_motion(&from, &to, &mut model.workspace()).is_some());
    assert_eq!(checked(&model, &from, &to, 1).len(), 1);
}

#[test]
fn trees_find_the_way_through_the_gaps_of_three_walls() {
    let walls = [wall("first", -0.5, -1.5, 0.6), wall("second", 0.0, -0.6, 1.5), wall("third", 0.5, -1.5, 0.6)];
    let model = built(GANTRY, &walls);
    for seed in 0..10 {
        let found = checked(&model, &[-0.8, -0.9], &[-0.8, 0.9], seed);
        assert!(found.len() >= 3, "{found:?}");
        assert_eq!(found, checked(&model, &[-0.8, -0.9], &[-0.8, 0.9], seed), "the same bits");
    }
}

#[test]
fn no_way_through_a_closed_wall_is_found_in_bounded_time() {
    let model = built(GANTRY, &[wall("wall", 0.0, -1.5, 1.5)]);
    assert_eq!(route(&model, &[-0.5, -0.5], &[-0.5, 0.5], 1, &RouteBudget::default()), None);
    assert_eq!(route(&model, &[-0.5, -0.5], &[-0.5, 0.0], 1, &RouteBudget::default()), None, "an end in the wall");
}

#[test]
fn a_curve_is_checked_where_it_bulges() {
    let model = built(GANTRY, &[wall("thin", 0.6, 0.28, 0.32)]);
    let mut workspace = model.workspace();
    let (from, to) = ([-0.5, 0.0], [0.5, 0.0]);
    assert_eq!(model.check_motion(&from, &to, &mut workspace), None);
    // a parabola of height 0.85 is at y = 0.544 where x is 0.3, inside the wall
    let bulge = |height: f64| {
        move |s: f64, joints: &mut [f64]| {
            joints[0] = s - 0.5;
            joints[1] = 4.0 * height * s * (1.0 - s);
        }
    };
    let hit = model.check_curve(bulge(0.85), &[1.0, 3.4], &mut workspace).unwrap();
    assert_eq!(hit.pair, ["ball", "thin"]);
    assert!((0.7..0.86).contains(&hit.at), "{hit:?}");
    assert_eq!(model.check_curve(bulge(0.4), &[1.0, 1.6], &mut workspace), None);
}
