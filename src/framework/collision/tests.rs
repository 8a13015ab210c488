//! Collisions: known values, the motion bound, thin walls, exclusions and rejected inputs.

use super::*;
use crate::robot::{Chain, RobotModel, RobotSpec};
use crate::world::{CoverageSpec, SurfaceView};
use rstest::rstest;

const TEO_ARM: &str = include_str!("../../../examples/robots/teo_right_arm.urdf");

fn sphere(name: &str, center_m: [f64; 3], radius_m: f64) -> Obstacle {
    Obstacle { name: name.to_owned(), shape: ObstacleShape::Sphere(SphereObstacle { center_m, radius_m }) }
}

fn cuboid(name: &str, center_m: [f64; 3], size_m: [f64; 3]) -> Obstacle {
    let shape = ObstacleShape::Box(BoxObstacle { size_m, center_m, rpy_rad: [0.0; 3] });
    Obstacle { name: name.to_owned(), shape }
}

/// A slide along x and a turn about z, which carries an arm of 1 m along x with the given shape at its end.
fn crane(shape: &str) -> (RobotModel, Chain) {
    let urdf = format!(
        r#"<robot name="crane"><link name="rail"/><link name="trolley"/>
        <link name="arm"><collision><origin xyz="1 0 0"/><geometry>{shape}</geometry></collision></link>
        <joint name="slide" type="prismatic"><parent link="rail"/><child link="trolley"/><axis xyz="1 0 0"/>
        <limit lower="-5" upper="5" effort="1" velocity="1"/></joint>
        <joint name="turn" type="revolute"><parent link="trolley"/><child link="arm"/><axis xyz="0 0 1"/>
        <limit lower="-4" upper="4" effort="1" velocity="1"/></joint></robot>"#
    );
    let model = RobotModel::from_urdf(&urdf).unwrap();
    let chain = Chain::new(&model, &RobotSpec::default()).unwrap();
    (model, chain)
}

fn built(robot: &(RobotModel, Chain), obstacles: &[Obstacle]) -> CollisionModel {
    CollisionModel::new(&robot.0, &robot.1, obstacles, &CollisionOptions::default()).unwrap()
}

fn teo(obstacles: &[Obstacle], options: &CollisionOptions) -> CollisionModel {
    let model = RobotModel::from_urdf(TEO_ARM).unwrap();
    let chain = Chain::new(&model, &RobotSpec::default()).unwrap();
    CollisionModel::new(&model, &chain, obstacles, options).unwrap()
}

const BALL: &str = r#"<sphere radius="0.1"/>"#;
const BOX: &str = r#"<box size="0.2 0.4 0.6"/>"#;
const CYLINDER: &str = r#"<cylinder radius="0.1" length="0.6"/>"#;
const CAPSULE: &str = r#"<capsule radius="0.1" length="0.6"/>"#;

/// The arm's shape is centred at (1, 0, 0); the tool, a sphere of 1 mm at the base's origin, is never the closest.
#[rstest]
#[case::sphere_to_sphere(BALL, sphere("ball", [1.0, 0.6, 0.8], 0.3), 1.0 - 0.1 - 0.3)]
#[case::box_face_to_sphere(BOX, sphere("ball", [2.0, 0.0, 0.0], 0.3), 1.0 - 0.1 - 0.3)]
#[case::box_corner_to_sphere(BOX, sphere("ball", [1.4, 0.6, 0.3], 0.1), 0.5 - 0.1)]
#[case::box_corner_to_box_corner(BOX, cuboid("box", [1.5, 0.9, 0.8], [0.4, 0.6, 0.2]), (0.2_f64.powi(2) + 0.4_f64.powi(2) + 0.4_f64.powi(2)).sqrt())]
#[case::cylinder_side_to_box(CYLINDER, cuboid("box", [2.0, 0.0, 0.0], [0.2, 0.2, 0.2]), 0.8)]
#[case::cylinder_end_to_box(CYLINDER, cuboid("box", [1.0, 0.0, 1.0], [0.2, 0.2, 0.2]), 0.6)]
#[case::capsule_end_to_box(CAPSULE, cuboid("box", [1.0, 0.0, 1.0], [0.2, 0.2, 0.2]), 0.5)]
#[case::capsule_end_to_box_corner(CAPSULE, cuboid("box", [1.7, 0.8, 1.1], [0.8, 0.8, 0.8]), (0.3_f64.powi(2) + 0.4_f64.powi(2) + 0.4_f64.powi(2)).sqrt() - 0.1)]
#[case::overlap(BOX, sphere("ball", [1.0, 0.0, 0.0], 0.3), 0.0)]
fn distances_equal_known_values(#[case] shape: &str, #[case] obstacle: Obstacle, #[case] known: f64) {
    let model = built(&crane(shape), &[obstacle]);
    let found = model.check(&[0.0; 2], &mut model.workspace()).unwrap();
    assert!((found.distance_m - known).abs() < 1e-7, "{found:?}, not {known}");
}

#[test]
fn a_half_space_is_solid_behind_its_normal() {
    let shape = ObstacleShape::HalfSpace(HalfSpaceObstacle { point_m: [0.0, 0.0, -1.0], normal: [0.0, 0.0, 2.0] });
    let model = built(&crane(CAPSULE), &[Obstacle { name: "floor".to_owned(), shape }]);
    let found = model.check(&[0.0; 2], &mut model.workspace()).unwrap();
    assert!((found.distance_m - 0.6).abs() < 1e-12 && found.pair == ["arm", "floor"], "{found:?}");
}

#[test]
fn a_hull_of_a_box_is_as_far_as_the_box() {
    let corner = |i: u8| [0, 1, 2].map(|axis| if i >> axis & 1 == 1 { 2.0 } else { 1.5 });
    let points_m = (0..8).map(corner).collect();
    let hull = Obstacle { name: "hull".to_owned(), shape: ObstacleShape::Hull(HullObstacle { points_m }) };
    let (robot, twin) = (crane(BOX), cuboid("twin", [1.75; 3], [0.5; 3]));
    let distance = |obstacle: &Obstacle| {
        let model = built(&robot, std::slice::from_ref(obstacle));
        model.check(&[0.3, 0.4], &mut model.workspace()).unwrap().distance_m
    };
    assert!((distance(&hull) - distance(&twin)).abs() < 1e-7);
}

/// A disc of 0.2 mm against a wall of 0.2 mm: both far thinner than the step.
#[rstest]
#[case::slide([-2.0, 0.0], [2.0, 0.0])]
#[case::slide_from_an_odd_place([-1.777_77, 0.0], [2.123_4, 0.0])]
#[case::turn([0.0, -1.1], [0.0, 1.2])]
fn a_motion_never_skips_a_thin_wall(#[case] from: [f64; 2], #[case] to: [f64; 2]) {
    let thin = if from[1] == 0.0 { "0.0002 0.2 0.2" } else { "0.2 0.0002 0.2" };
    let size = if from[1] == 0.0 { [0.000_2, 3.0, 3.0] } else { [3.0, 0.000_2, 3.0] };
    let robot = crane(&format!(r#"<box size="{thin}"/>"#));
    let options = CollisionOptions {
        margin_m: 1e-6,
        tool_radius_m: 1e-6,
        excluded: vec![[TOOL.to_owned(), "wall".to_owned()]],
        ..CollisionOptions::default()
    };
    let wall = cuboid("wall", [1.0, 0.0, 0.0], size);
    let model = CollisionModel::new(&robot.0, &robot.1, &[wall], &options).unwrap();
    let mut workspace = model.workspace();
    assert!(!model.collides(&from, &mut workspace) && !model.collides(&to, &mut workspace), "both ends are free");
    let hit = model.check_motion(&from, &to, &mut workspace).unwrap();
    let joints = [0, 1].map(|i| from[i] + hit.at * (to[i] - from[i]));
    assert!(hit.distance_m <= 1e-6 && hit.pair == ["arm", "wall"], "{hit:?}");
    assert!(model.collides(&joints, &mut workspace), "the pose of the first contact collides");
    assert!((joints[0] + joints[1]).abs() < 0.11, "the contact is at the wall: {joints:?}");
}

#[test]
fn the_home_pose_of_the_arm_is_free_and_touching_pairs_are_reported() {
    let model = teo(&[], &CollisionOptions::default());
    let mut workspace = model.workspace();
    let home = model.chain().home().to_vec();
    let found = model.check(&home, &mut workspace).unwrap();
    assert!(!model.collides(&home, &mut workspace) && found.distance_m > 0.01, "{found:?}");
    let reason = |a: &str, b: &str| {
        let pair = model.excluded().iter().find(|pair| pair.names == [a, b]);
        pair.map(|pair| pair.reason)
    };
    assert_eq!(reason("torso", "shoulder"), Some(Exclusion::Adjacent));
    assert_eq!(reason("shoulder", "upper_arm"), Some(Exclusion::ContactAtHome));
    assert_eq!(reason("torso", "upper_arm"), None, "the arm can hit the torso");
    assert!(model.notes().is_empty(), "{:?}", model.notes());
}

#[test]
fn the_upper_arm_enters_the_torso_at_the_lower_limit_of_the_shoulder_roll() {
    let model = teo(&[], &CollisionOptions::default());
    let inwards = [0.0, -0.261, 0.0, 0.0, 0.0, 0.0];
    let mut workspace = model.workspace();
    assert!(model.collides(&inwards, &mut workspace));
    let hit = model.check_motion(model.chain().home(), &inwards, &mut workspace).unwrap();
    assert!(hit.pair[0] == "torso" && hit.at > 0.1, "{hit:?}");
}

#[test]
fn given_pairs_are_not_checked() {
    let arm = ["upper_arm", "elbow", "forearm", "hand", "object", TOOL];
    let body = |link: &str| ["base", "torso"].map(|body| [body.to_owned(), link.to_owned()]);
    let excluded = arm.into_iter().flat_map(body).collect();
    let options = CollisionOptions { excluded, ..CollisionOptions::default() };
    let model = teo(&[], &options);
    let found = model.check(&[0.0, -0.261, 0.0, 0.0, 0.0, 0.0], &mut model.workspace()).unwrap();
    assert!(found.distance_m > 0.001, "{found:?}");
}

fn wall() -> CoverageSpec {
    CoverageSpec {
        origin_m: [0.6, -0.8, 0.32],
        column_step_m: [0.0, 0.2, 0.0],
        row_step_m: [0.0, 0.0, 0.2],
        columns: 4,
        rows: 4,
        radius_m: 0.13,
        resets: true,
        observes: SurfaceView::Percent,
    }
}

#[test]
fn the_tool_comes_near_a_surface_but_not_through() {
    let chain = Chain::new(&RobotModel::from_urdf(TEO_ARM).unwrap(), &RobotSpec::default()).unwrap();
    let surface = surface_obstacle("wall", &wall(), &chain, 0.01).unwrap();
    let model = teo(&[surface], &CollisionOptions::default());
    let mut workspace = model.workspace();
    let stretched = |pitch: f64| [pitch, 0.0, 0.0, 0.0, 0.0, 0.0];
    // the tool is 0.798 m below the shoulder: x is about 0.798 sin(pitch)
    let (near, behind) = (stretched((0.5_f64 / 0.798).asin()), stretched((0.7_f64 / 0.798).asin()));
    assert!(!model.collides(&near, &mut workspace), "{:?}", model.check(&near, &mut workspace));
    assert!(model.collides(&behind, &mut workspace));
    assert_eq!(model.check_motion(&near, &behind, &mut workspace).unwrap().pair[1], "wall");
}

/// The URDF without its elements of that name.
fn without(element: &str, urdf: &str) -> String {
    let (open, close) = (format!("<{element}>"), format!("</{element}>"));
    urdf.split(&open).map(|part| part.rsplit(&close).next().unwrap()).collect()
}

#[test]
fn visual_shapes_stand_for_missing_collision_shapes() {
    let model = RobotModel::from_urdf(&without("collision", TEO_ARM)).unwrap();
    let chain = Chain::new(&model, &RobotSpec::default()).unwrap();
    let built = CollisionModel::new(&model, &chain, &[], &CollisionOptions::default()).unwrap();
    assert_eq!(built.notes().iter().filter(|note| note.code == "visual_shapes").count(), 9);
}

#[test]
fn a_robot_without_shapes_is_made_of_capsules() {
    let model = RobotModel::from_urdf(&without("visual", &without("collision", TEO_ARM))).unwrap();
    let chain = Chain::new(&model, &RobotSpec::default()).unwrap();
    let far = sphere("ball", [0.0, -0.346_92, 0.6], 0.05);
    let built = CollisionModel::new(&model, &chain, &[far], &CollisionOptions::default()).unwrap();
    let found = built.check(&[0.0; 6], &mut built.workspace()).unwrap();
    assert_eq!((found.distance_m, found.pair), (0.0, ["upper_arm", "ball"]), "the ball is on the upper arm's axis");
    assert!(built.notes().iter().any(|note| note.link == "upper_arm" && note.code == "capsules"));
}

#[test]
fn same_inputs_give_the_same_bits() {
    let models = [teo(&[], &CollisionOptions::default()), teo(&[], &CollisionOptions::default())];
    let bits = |model: &CollisionModel| {
        let mut workspace = model.workspace();
        let joints = (0..50).map(|i| [0.3, 0.2, -0.4, 0.5, 0.1, 0.7].map(|q: f64| q * f64::from(i) / 40.0));
        joints.map(|q| model.check(&q, &mut workspace).unwrap().distance_m.to_bits()).collect::<Vec<_>>()
    };
    assert_eq!(bits(&models[0]), bits(&models[1]));
    assert_eq!(bits(&models[0]), bits(&models[0]), "a used workspace changes nothing");
}

#[rstest]
#[case::radius(sphere("ball", [0.0; 3], 0.0), "obstacle \"ball\": radius_m is 0: give more than 0")]
#[case::place(sphere("ball", [f64::NAN; 3], 1.0), "obstacle \"ball\": center_m is")]
#[case::name(sphere("arm", [0.0; 3], 1.0), "has the name of a link")]
#[case::flat(
    Obstacle {
        name: "sheet".to_owned(),
        shape: ObstacleShape::Hull(HullObstacle {
            points_m: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]],
        }),
    },
    "has 4 points but no volume"
)]
#[case::normal(
    Obstacle {
        name: "floor".to_owned(),
        shape: ObstacleShape::HalfSpace(HalfSpaceObstacle { point_m: [0.0; 3], normal: [0.0; 3] }),
    },
    "the normal of \"floor\" has no direction"
)]
fn wrong_obstacles_are_rejected(#[case] obstacle: Obstacle, #[case] message: &str) {
    let (model, chain) = crane(BALL);
    let error = CollisionModel::new(&model, &chain, &[obstacle], &CollisionOptions::default()).unwrap_err();
    assert!(error.to_string().contains(message), "{error}");
}

#[test]
fn an_unknown_name_of_a_pair_is_rejected_with_the_known_ones() {
    let (model, chain) = crane(BALL);
    let excluded = vec![["arm".to_owned(), "wal".to_owned()]];
    let options = CollisionOptions { excluded, ..CollisionOptions::default() };
    let error = CollisionModel::new(&model, &chain, &[], &options).unwrap_err().to_string();
    assert!(error.contains("\"wal\"") && error.contains("rail, trolley, arm, tool centre point"), "{error}");
}
