//! MODEL-IET through the state machine: resumption, earlier trials, stop rules, an arm with a prismatic joint.

use super::*;
use crate::Feature;
use crate::generalization::Goals;
use crate::method::MethodSpec;
use crate::method::per_goal::StopReason;
use crate::method::whole_run::{ModelSpec, Prior, Space, Trial};
use crate::preset::shipped;
use crate::random::RandomStream;
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

/// Wax, of which goals 4 and 5 are out of reach, with `restarts`.
fn beyond(restarts: u32) -> RunResult {
    let mut problem = shipped("wax").unwrap().problem;
    problem.execution.method = MethodSpec::Model(ModelSpec { restarts: Some(restarts), ..ModelSpec::default() });
    run(&problem, 9).unwrap()
}

#[test]
fn a_goal_is_out_of_reach_only_once_a_restart_has_agreed() {
    let (without, with) = (beyond(0), beyond(1));
    let missed = |result: &RunResult, verdict: Verdict| -> Vec<usize> {
        let goals = result.goals.iter().filter(|goal| goal.judgement.verdict == verdict);
        goals.map(|goal| goal.index).collect()
    };
    assert_eq!(missed(&without, Verdict::StoppedShort), [4, 5]);
    assert!(without.goals[4..6].iter().all(|goal| goal.stop_reason == StopReason::NoImprovement));
    assert_eq!(missed(&with, Verdict::OutOfReach), [4, 5]);
    assert_eq!(with.evaluations, without.evaluations + 2);
    assert_eq!(with.verdict().outcome, RunOutcome::GoalsMissed);
    for goal in &with.goals {
        let Judgement { distance, tolerance, .. } = goal.judgement;
        assert_eq!(goal.judgement.verdict == Verdict::Reached, distance.unwrap() <= tolerance);
    }
}

/// A circle of nine goals for a robot of six joints that turn by 360 degrees either way, from a pose drawn by `seed`.
fn six_joints(seed: u64) -> Problem {
    let millimetres = ["x", "y", "z"].map(|name| Feature::new(name, "mm")).to_vec();
    let on_circle = |k: u32| {
        let turn = f64::from(k) * std::f64::consts::TAU / 9.0;
        vec![450.0 + 150.0 * turn.cos(), 150.0 + 150.0 * turn.sin(), 300.0]
    };
    let goals: Vec<Vec<f64>> = (0..9).map(on_circle).collect();
    let mut problem = Problem {
        goals: Goals::new(millimetres, &goals).unwrap(),
        urdf: include_str!("../../../tests/fixtures/robots/ur5_like.urdf").to_owned(),
        robot: RobotSpec::default(),
        execution: ExecutionSpec { tolerance: Some(5.0), ..wax(1).execution },
        ..wax(1)
    };
    let chain = Iet::new(&problem, seed).unwrap().chain().clone();
    let mut pose = chain.home().to_vec();
    Space::of(&chain).uniform(&mut RandomStream::of_run(seed, 0), &mut pose);
    problem.robot.home = chain.genes().iter().map(|gene| gene.name.clone()).zip(pose).collect();
    problem
}

#[test]
fn no_joint_turns_round_between_neighbouring_goals() {
    // From these poses a joint turned by 541 to 717 degrees before equivalent poses were told apart.
    for seed in [24, 35, 42] {
        let result = run(&six_joints(seed), seed).unwrap();
        assert_eq!(result.verdict().outcome, RunOutcome::Complete, "seed {seed}: {result:?}");
        let poses = result.waypoints();
        let steps = poses.windows(2).flat_map(|pair| pair[0].iter().zip(&pair[1]).map(|(from, to)| (to - from).abs()));
        let largest = steps.fold(0.0, f64::max).to_degrees();
        assert!(largest < 90.0, "seed {seed}: {largest} degrees");
    }
}

/// Wax-reachable with 2 mm of noise of the sensor, of which the method knows `noise`.
fn noisy(noise: f64) -> Problem {
    let mut problem = wax(9);
    problem.execution.reality = Some(DisturbanceSpec { sensor_noise: 2.0, ..DisturbanceSpec::default() });
    problem.execution.method = MethodSpec::Model(ModelSpec { noise, ..ModelSpec::default() });
    problem.execution.tolerance = Some(10.0);
    problem
}

/// Discrepancy of the undisturbed effects of the winners.
fn undisturbed(problem: &Problem, result: &RunResult) -> f64 {
    let chain = Iet::new(problem, 1).unwrap().chain().clone();
    let mut world = crate::world::build(&problem.world, &chain).unwrap();
    let mut measure = PartialDiscrepancy::new(&problem.goals, problem.execution.metric);
    let mut seen = vec![0.0; 3];
    let mut discrepancy = 0.0;
    for goal in &result.goals {
        world.observe(&goal.joints, &mut seen);
        discrepancy = measure.of(&seen);
        measure.append(&seen);
    }
    discrepancy
}

#[test]
fn the_interval_contains_the_true_discrepancy_nearly_always() {
    let runs: u32 = 40;
    let problem = noisy(2.0);
    let contained = |seed: &u32| {
        let result = run(&problem, u64::from(*seed)).unwrap();
        let (truth, estimate) = (undisturbed(&problem, &result), result.estimate.unwrap());
        assert!(estimate.lower <= estimate.value && estimate.value <= estimate.upper);
        estimate.lower <= truth && truth <= estimate.upper
    };
    let share = (1..=runs).filter(contained).count() as f64 / f64::from(runs);
    assert!(share >= 0.85, "{share}");
    assert_eq!(run(&noisy(0.0), 1).unwrap().estimate, None);
}
