//! Demonstrations in, goals, a run, a trajectory out: the front page of the crate as a program.
//!
//! `cargo run -p cgda-core --example stroke` prints the trajectory as CSV.

use cgda_core::demonstration::{ReadOptions, read};
use cgda_core::execution::{Problem, run};
use cgda_core::generalization::{GeneralizeSpec, generalize};
use cgda_core::robot::{Chain, RobotModel, RobotSpec};
use cgda_core::trajectory::export::{ExportSpec, Exported};
use cgda_core::trajectory::{PlanSpec, Waypoint, plan};
use cgda_core::world::{ToolPositionSpec, WorldSpec};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Two demonstrations of a stroke to the left, in metres.
    let shown = [
        "time_s,x [m],y [m],z [m]\n0,0.5,-0.20,0.40\n1,0.5,-0.10,0.41\n2,0.5,0.00,0.42\n3,0.5,0.10,0.41\n4,0.5,0.20,0.40\n",
        "time_s,x [m],y [m],z [m]\n0,0.5,-0.21,0.40\n2,0.5,-0.01,0.42\n4,0.5,0.19,0.41\n",
    ];
    let mut demonstrations = Vec::new();
    for text in shown {
        let (demonstration, _warnings) =
            read(text.as_bytes(), &ReadOptions::default()).map_err(|findings| format!("{findings:?}"))?;
        demonstrations.push(demonstration);
    }

    // Goals: what the world shall show, one row per second.
    let goals = generalize(&demonstrations, &GeneralizeSpec::new(1.0))?.goals;
    assert_eq!(goals.len(), 4);

    // Any robot of revolute, continuous, prismatic, fixed and mimic joints: here an arm of three.
    let urdf = r#"<robot name="arm">
  <link name="base"/><link name="shoulder"/><link name="upper"/><link name="lower"/><link name="tool"/>
  <joint name="yaw" type="revolute">
        <parent link="base"/><child link="shoulder"/><origin xyz="0 0 0.3"/><axis xyz="0 0 1"/>
        <limit lower="-2" upper="2" velocity="2" effort="50"/></joint>
  <joint name="pitch" type="revolute">
        <parent link="shoulder"/><child link="upper"/><axis xyz="0 1 0"/>
        <limit lower="-2" upper="2" velocity="2" effort="50"/></joint>
  <joint name="elbow" type="revolute">
        <parent link="upper"/><child link="lower"/><origin xyz="0.4 0 0"/><axis xyz="0 1 0"/>
        <limit lower="-2.5" upper="2.5" velocity="2" effort="50"/></joint>
  <joint name="hand" type="fixed"><parent link="lower"/><child link="tool"/><origin xyz="0.4 0 0"/></joint>
    </robot>"#;
    let robot = RobotSpec { home: [("elbow".to_owned(), 1.0)].into(), ..RobotSpec::default() };

    // The joint positions that show the goals, found by trial in a simulated world.
    let problem = Problem {
        goals,
        urdf: urdf.to_owned(),
        robot: robot.clone(),
        world: WorldSpec::ToolPosition(ToolPositionSpec { unit: "m".to_owned() }),
        execution: toml::from_str("method = \"model\"")?,
        earlier: Vec::new(),
    };
    let found = run(&problem, 1)?;
    eprintln!("{} trials, discrepancy {:.4} m", found.evaluations, found.discrepancy);
    // A smoke check with room to spare; the tests of the crate hold exact figures.
    assert!(found.evaluations < 40 && found.discrepancy < 0.1);

    // A trajectory within the limits of position, velocity, acceleration and jerk, ready for a controller.
    let chain = Chain::new(&RobotModel::from_urdf(urdf)?, &robot)?;
    let poses: Vec<Vec<f64>> = found.goals.iter().map(|goal| goal.joints.clone()).collect();
    let trajectory = plan(&chain, chain.home(), &Waypoint::goals(&poses), None, &PlanSpec::default())?;
    print!("{}", Exported::new(&trajectory, &ExportSpec::default())?.csv());
    Ok(())
}
