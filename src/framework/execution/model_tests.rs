//! MODEL-IET through the state machine: resumption, earlier trials, stop rules, an arm with a prismatic joint.

use super::*;
use crate::Feature;
use crate::generalization::Goals;
use crate::method::MethodSpec;
use crate::method::per_goal::StopReason;
use crate::method::whole_run::{ModelSpec, Prior, Trial};
use crate::preset::shipped;
use crate::robot::RobotSpec;
use crate::world::DisturbanceSpec;
use rstest::rstest;

/// The first `goals` goals of wax-reachable, by MODEL-IET.
fn wax(goals: usize) -> Problem {
    let mut preset = shipped("wax-reachable").unwrap();
    assert!(preset.select_method("model"));
    let mut problem = preset.problem;
    let rows: Vec<Vec<f64>> = problem.goals.rows().take(goals).map(<[f64]>::to_vec).collect();
    problem.goals = Goals::new(problem.goals.features().to_vec(), &rows).unwrap();
    problem
}

fn all_trials(problem: &Problem, seed: u64) -> Vec<Trial> {
    let mut iet = Iet::new(problem, seed).unwrap();
    let mut world = iet.world().unwrap();
    simulate(&mut iet, world.as_mut(), u64::MAX).unwrap();
    assert_eq!(iet.log().len() as u64, iet.evaluations());
    iet.log().to_vec()
}

/// A run that is killed and resumed after every evaluation.
fn killed_at_each(problem: &Problem, seed: u64) -> RunResult {
    let mut iet = Iet::new(problem, seed).unwrap();
    while !iet.is_finished() {
        let mut world = iet.world().unwrap();
        simulate(&mut iet, world.as_mut(), 1).unwrap();
        let saved = serde_json::to_string(&iet.state()).unwrap();
        iet = Iet::resume(problem, serde_json::from_str(&saved).unwrap()).unwrap();
    }
    iet.finish().unwrap()
}

#[rstest]
#[case::from_nothing(Prior::None, false, false)]
#[case::wrong_simulator(Prior::Simulator, false, false)]
#[case::second_action(Prior::None, true, false)]
#[case::noise_and_lost_observations(Prior::None, false, true)]
fn killed_at_each_evaluation_it_ends_with_the_same_bits(
    #[case] prior: Prior,
    #[case] second: bool,
    #[case] noise: bool,
) {
    let mut problem = wax(3);
    let mut reality = DisturbanceSpec { link_share: 0.05, base_shift_m: 0.02, ..DisturbanceSpec::default() };
    let mut spec = ModelSpec { prior, ..ModelSpec::default() };
    if noise {
        reality = DisturbanceSpec { sensor_noise: 2.0, joint_noise_deg: 0.1, lost_share: 0.1, ..reality };
        spec.noise = 2.5;
    }
    problem.execution.reality = Some(reality);
    problem.execution.method = MethodSpec::Model(spec);
    if second {
        problem.earlier = all_trials(&problem, 9);
        let moved: Vec<Vec<f64>> = problem.goals.rows().map(|g| vec![g[0] - 60.0, g[1], g[2] + 40.0]).collect();
        problem.goals = Goals::new(problem.goals.features().to_vec(), &moved).unwrap();
    }
    let whole = run(&problem, 9).unwrap();
    assert!(whole.evaluations > 1, "{whole:?}");
    assert_eq!(killed_at_each(&problem, 9), whole);
}

#[test]
fn a_run_begins_with_what_an_earlier_one_taught() {
    let mut problem = wax(9);
    problem.earlier = all_trials(&problem, 9);
    let saved: Problem = serde_json::from_str(&serde_json::to_string(&problem).unwrap()).unwrap();
    assert_eq!(saved, problem);
    let (first, second) = (problem.earlier.len() as u64, run(&problem, 9).unwrap());
    assert!(second.evaluations + 4 <= first, "{} evaluations after {first}", second.evaluations);
    problem.earlier[1].joints.pop();
    let error = run(&problem, 9).unwrap_err().to_string();
    assert_eq!(
        error,
        "earlier trial 1 has 2 finite joints, the problem has 3: give trials of the same robot and features, or none"
    );
}

#[test]
fn it_ends_at_the_target_and_keeps_to_its_tries() {
    let mut problem = wax(9);
    problem.execution.tolerance = Some(5.0);
    let whole = run(&problem, 9).unwrap();
    problem.execution.target_discrepancy = Some(300.0);
    let ended = run(&problem, 9).unwrap();
    assert!(ended.discrepancy <= 300.0 && ended.evaluations < whole.evaluations, "{ended:?}");
    assert!(ended.goals.iter().any(|goal| goal.stop_reason == StopReason::Target));
    assert_eq!(killed_at_each(&problem, 9), ended);
    problem.execution.target_discrepancy = None;
    problem.execution.max_evaluations_per_goal = Some(1);
    let few = run(&problem, 9).unwrap();
    assert!(few.goals[1..].iter().all(|goal| goal.evaluations <= 1), "{few:?}");
    assert!(few.evaluations < whole.evaluations && few.discrepancy > whole.discrepancy);
}

/// Two turns about the vertical and a vertical stroke.
const SCARA: &str = r#"<robot name="scara"><link name="a"/><link name="b"/><link name="c"/><link name="d"/>
    <joint name="shoulder" type="revolute"><parent link="a"/><child link="b"/><origin xyz="0 0 0.4"/><axis xyz="0 0 1"/>
      <limit lower="-2.2" upper="2.2" velocity="3" effort="1"/></joint>
    <joint name="elbow" type="revolute"><parent link="b"/><child link="c"/><origin xyz="0.25 0 0"/><axis xyz="0 0 1"/>
      <limit lower="-2.5" upper="2.5" velocity="3" effort="1"/></joint>
    <joint name="spindle" type="prismatic"><parent link="c"/><child link="d"/><origin xyz="0.2 0 0"/><axis xyz="0 0 -1"/>
      <limit lower="0" upper="0.3" velocity="1" effort="1"/></joint></robot>"#;

#[test]
fn an_arm_with_a_prismatic_joint_reaches_its_goals() {
    let millimetres = ["x", "y", "z"].map(|name| Feature::new(name, "mm")).to_vec();
    let goals: Vec<Vec<f64>> = (0..6)
        .map(|k| {
            let turn = f64::from(k) * std::f64::consts::TAU / 6.0;
            vec![280.0 + 90.0 * turn.cos(), 90.0 * turn.sin(), 240.0 + 60.0 * (2.0 * turn).sin()]
        })
        .collect();
    let problem = Problem {
        goals: Goals::new(millimetres, &goals).unwrap(),
        urdf: SCARA.to_owned(),
        robot: RobotSpec::default(),
        execution: ExecutionSpec { tolerance: Some(10.0), ..wax(1).execution },
        ..wax(1)
    };
    let result = run(&problem, 1).unwrap();
    assert!(result.goals.iter().all(|goal| goal.stop_reason == StopReason::Tolerance), "{result:?}");
    assert!(result.evaluations <= 20, "{} evaluations", result.evaluations);
}
