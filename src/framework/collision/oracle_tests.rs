//! Clearances of random poses of three robots among two obstacles against those that another library found: Pinocchio and
//! its coal, by `tests/collisions.py poses`.

use super::*;
use crate::robot::{Chain, RobotModel, RobotSpec};
use rstest::rstest;

/// Difference, m, that the two searches for closest points may have.
const TOLERANCE_M: f64 = 2e-5;

#[rstest]
#[case::arm_with_torso(
    include_str!("../../../examples/robots/teo_right_arm.urdf"),
    include_str!("../../../tests/fixtures/collisions/teo_right_arm.csv")
)]
#[case::six_joints(
    include_str!("../../../tests/fixtures/robots/six_joint_arm.urdf"),
    include_str!("../../../tests/fixtures/collisions/six_joint_arm.csv")
)]
#[case::seven_joints(
    include_str!("../../../examples/robots/seven_joint_arm.urdf"),
    include_str!("../../../tests/fixtures/collisions/seven_joint_arm.csv")
)]
fn clearances_are_those_of_another_library(#[case] urdf: &str, #[case] poses: &str) {
    let size = BoxObstacle { size_m: [0.2, 0.3, 0.4], center_m: [0.45, 0.25, 0.3], rpy_rad: [0.0; 3] };
    let ball = SphereObstacle { center_m: [0.3, -0.4, 0.5], radius_m: 0.1 };
    let obstacles = [("box", ObstacleShape::Box(size)), ("ball", ObstacleShape::Sphere(ball))];
    let obstacles = obstacles.map(|(name, shape)| Obstacle { name: name.to_owned(), shape });
    let model = RobotModel::from_urdf(urdf).unwrap();
    let chain = Chain::new(&model, &RobotSpec::default()).unwrap();
    let built = CollisionModel::new(&model, &chain, &obstacles, &CollisionOptions::default()).unwrap();
    assert!(built.notes().is_empty(), "every link has its own shapes: {:?}", built.notes());
    let mut workspace = built.workspace();
    let mut collisions = 0;
    for row in poses.lines().skip(1) {
        let values: Vec<f64> = row.split(',').map(|value| value.parse().unwrap()).collect();
        let (joints, known) = (&values[..chain.len()], values[chain.len()]);
        let found = built.check(joints, &mut workspace).unwrap();
        assert!((found.distance_m - known).abs() < TOLERANCE_M, "{row}: {found:?}, excluded {:?}", built.excluded());
        assert!((known <= built.margin_m()) == built.collides(joints, &mut workspace) || (known - 0.001).abs() < 1e-4);
        assert_eq!(built.lack_m(joints, &mut workspace) > 0.0, built.collides(joints, &mut workspace));
        collisions += u32::from(known == 0.0);
    }
    assert!((10..150).contains(&collisions), "{collisions} of 300 poses are in collision");
}
