//! Worlds: known values and rejected descriptions, using the shipped files.

use super::*;
use crate::robot::{Chain, RobotModel, RobotSpec};
use proptest::prelude::*;
use rstest::rstest;

const WALL: &str = include_str!("../../../examples/worlds/paint_wall.toml");
const TOOL: &str = include_str!("../../../examples/worlds/tool_position_mm.toml");

fn arm() -> Chain {
    let urdf = include_str!("../../../examples/robots/teo_right_arm.urdf");
    let spec = RobotSpec {
        free_joints: Some(["shoulder_pitch", "shoulder_roll", "elbow_pitch"].map(str::to_owned).to_vec()),
        fixed: [("wrist_yaw".to_owned(), -std::f64::consts::FRAC_PI_4)].into(),
        ..RobotSpec::default()
    };
    Chain::new(&RobotModel::from_urdf(urdf).unwrap(), &spec).unwrap()
}

fn wall() -> CoverageSpec {
    match toml::from_str(WALL).unwrap() {
        WorldSpec::Coverage(spec) => spec,
        _ => panic!("the wall is a surface"),
    }
}

#[test]
fn tool_position_is_in_millimetres() {
    let mut world = build(&toml::from_str(TOOL).unwrap(), &arm()).unwrap();
    let mut seen = [0.0; 3];
    world.observe(&[0.0; 3], &mut seen);
    for (found, known) in seen.iter().zip([6.3074, -340.6126, 0.0]) {
        assert!((found - known).abs() < 1e-4, "{seen:?}");
    }
    assert_eq!(world.features()[2], crate::Feature::new("z", "mm"));
}

#[test]
fn the_wall_is_where_the_paper_has_it() {
    let grid = CellGrid::new(&wall());
    assert_eq!(grid.cells(), 16);
    for cell in 0..16 {
        let [column, row] = grid.place(cell);
        let centre = grid.point(column, row);
        assert!((centre.x - 0.6).abs() < 1e-12);
        assert!([-0.8, -0.6, -0.4, -0.2].iter().any(|y| (centre.y - y).abs() < 1e-12), "{centre}");
        assert!([0.32, 0.52, 0.72, 0.92].iter().any(|z| (centre.z - z).abs() < 1e-12), "{centre}");
    }
}

proptest! {
    #[test]
    fn paint_stays_until_reset_and_looking_changes_nothing(
        poses in prop::collection::vec(prop::array::uniform3(-0.26..1.74_f64), 1..20)
    ) {
        let mut world = build(&WorldSpec::Coverage(wall()), &arm()).unwrap();
        let (mut seen, mut before, mut looked) = ([0.0], 0.0, [0.0]);
        for pose in &poses {
            world.observe(pose, &mut looked);
            world.observe(pose, &mut looked);
            world.commit(pose, &mut seen);
            prop_assert_eq!(seen[0].to_bits(), looked[0].to_bits());
            prop_assert!(seen[0] >= before && seen[0] <= 100.0);
            let cells = world.cells().unwrap().count();
            prop_assert!((f64::from(cells) * 6.25 - seen[0]).abs() < 1e-12);
            before = seen[0];
        }
        world.reset();
        prop_assert_eq!(world.cells().unwrap().count(), 0);
    }
}

#[rstest]
#[case(|w: &mut CoverageSpec| w.rows = 0, "0 cells")]
#[case(|w: &mut CoverageSpec| w.radius_m = -1.0, "radius_m is -1: give more than 0 and at most 10000 m")]
#[case(|w: &mut CoverageSpec| w.radius_m = f64::NAN, "radius_m is NaN")]
#[case(|w: &mut CoverageSpec| w.columns = u32::MAX, "4294967295 columns")]
#[case(|w: &mut CoverageSpec| w.origin_m[1] = f64::INFINITY, "origin_m is inf")]
#[case(|w: &mut CoverageSpec| (w.columns, w.rows) = (65535, 65535), "4294836225 cells")]
#[case(|w: &mut CoverageSpec| w.radius_m = 1e308, "radius_m is 1e308")]
#[case(|w: &mut CoverageSpec| w.column_step_m[0] = -1e308, "column_step_m is -1e308: give -10000 to 10000 m")]
#[case(|w: &mut CoverageSpec| w.row_step_m = [0.0; 3], "row_step_m is zero for 4 cells")]
fn refuses_surfaces(#[case] spoil: fn(&mut CoverageSpec), #[case] told: &str) {
    let mut spec = wall();
    spoil(&mut spec);
    let spec = WorldSpec::Coverage(spec);
    let error = build(&spec, &arm()).err().unwrap().to_string();
    assert_eq!(features(&spec).unwrap_err().to_string(), error, "refused without being built too");
    assert!(error.contains(told), "{error}");
}

#[test]
fn refuses_units() {
    let spec = WorldSpec::ToolPosition(ToolPositionSpec { unit: "cm".into() });
    let error = build(&spec, &arm()).err().unwrap().to_string();
    assert!(error.contains("\"cm\""), "{error}");
    assert!(features(&spec).is_err());
}
