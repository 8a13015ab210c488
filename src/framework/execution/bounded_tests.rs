//! Methods that plan the whole run, under constraints: they execute no forbidden pose and report goals out of reach.

use super::*;
use crate::method::per_goal::{Batch, Provenance, StopReason};
use crate::preset::shipped;
use crate::robot::tool_position;
use crate::world::WorldSpec;
use proptest::prelude::*;
use rstest::rstest;
use serde_json::{Value, json};

/// A shipped problem with another method and further fields of its execution.
fn problem(preset: &str, method: Value, execution: &Value) -> Problem {
    let mut problem = shipped(preset).unwrap().problem;
    let mut spec = serde_json::to_value(&problem.execution).unwrap();
    spec["method"] = method;
    spec.as_object_mut().unwrap().extend(execution.as_object().unwrap().clone());
    problem.execution = serde_json::from_value(spec).unwrap();
    problem
}

/// Every executed pose with the previous pose, and how the run ended.
type Executed = (Vec<(Option<Vec<f64>>, Vec<f64>)>, Result<RunResult, ProblemError>);

fn executed(problem: &Problem, seed: u64, most: usize) -> Executed {
    let mut iet = Iet::new(problem, seed).unwrap();
    let mut world = iet.world().unwrap();
    let mut batch = Batch::new(iet.chain().len(), 1);
    let mut scratch = vec![0.0; iet.world_features()];
    // If the wall is reset, the arm also returns to its start.
    let returns = matches!(problem.world, WorldSpec::Coverage(_));
    let mut all: Vec<(Option<Vec<f64>>, Vec<f64>)> = Vec::new();
    while !iet.is_finished() && all.len() < most {
        world.reset();
        iet.prefix().for_each(|pose| world.commit(pose, &mut scratch));
        let before = iet.prefix().last().map(<[f64]>::to_vec);
        batch.clear(1);
        iet.ask(&mut batch);
        let mut observations = Observations::new(iet.chain().len(), scratch.len(), Provenance::Simulated);
        for (id, joints) in batch.iter() {
            world.observe(joints, observations.observed(id, joints));
            let last = all.last().filter(|_| !returns).map(|trial| trial.1.clone());
            all.push((before.clone().or(last), joints.to_vec()));
        }
        if let Err(error) = iet.tell(&observations) {
            return (all, Err(error));
        }
    }
    (all, iet.finish())
}

fn inside_box(lower_m: [f64; 3], upper_m: [f64; 3]) -> Value {
    json!({"constraints": [{"kind": "region", "geometry": {"shape": "box", "lower_m": lower_m, "upper_m": upper_m}}]})
}

proptest! {
    // 64 cases take 14 s of one core; the default of 256 would take nearly a minute.
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn no_executed_pose_leaves_its_region_or_steps_too_far(
        seed: u64, y in -0.62..-0.45, z in -0.2..-0.05, step_deg in 25.0..60.0, method in 0_usize..3
    ) {
        let (preset, name) = [("wax", "model"), ("paint", "particle"), ("paint", "search")][method];
        let (lower, upper) = ([-1.0, y, z], [1.0, 1.0, 1.0]);
        let bounded = problem(preset, json!({"name": name, "max_step_deg": step_deg}), &inside_box(lower, upper));
        let (poses, _) = executed(&bounded, seed, 12);
        prop_assert!(!poses.is_empty());
        let chain = Iet::new(&bounded, seed).unwrap().chain().clone();
        for (before, pose) in &poses {
            let tool = tool_position(&chain, pose);
            prop_assert!((0..3).all(|k| lower[k] < tool[k] && tool[k] < upper[k]), "{tool} is outside");
            let before = before.as_deref().unwrap_or(chain.home());
            let step = pose.iter().zip(before).map(|(a, b)| (a - b).abs().to_degrees()).fold(0.0, f64::max);
            prop_assert!(step <= step_deg, "{step} degrees");
        }
    }
}

#[test]
fn goals_outside_the_region_are_out_of_reach_with_their_residual() {
    let bounded = problem("wax", json!({"name": "model"}), &inside_box([-1.0, -0.52, 0.0], [1.0, 1.0, 1.0]));
    let (_, result) = executed(&bounded, 4, 200);
    let result = result.unwrap();
    assert!(result.valid && result.goals.iter().all(|goal| goal.feasible));
    // Goals 2, 3 and 4 are at y = -589, -621 and -554 mm; the box ends at -520.
    for goal in [2, 3, 4] {
        assert_eq!(result.goals[goal].stop_reason, StopReason::OutOfReach, "goal {goal}");
    }
    assert!(result.goals.iter().filter(|goal| goal.stop_reason == StopReason::Tolerance).count() >= 3);
}

#[test]
fn consecutive_goals_keep_to_their_step() {
    let step = json!({"constraints": [{"kind": "joint_step", "limit_rad": 0.4, "start": [0.0, 0.0, 0.0]}]});
    let bounded = problem("wax", json!({"name": "model"}), &step);
    let (poses, result) = executed(&bounded, 4, 200);
    let far = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let home = vec![0.0; 3];
    assert!(poses.iter().all(|(before, pose)| far(before.as_ref().unwrap_or(&home), pose) <= 0.4));
    let result = result.unwrap();
    let mut waypoints = vec![home];
    waypoints.extend(result.waypoints());
    assert!(result.valid && waypoints.windows(2).all(|w| far(&w[0], &w[1]) <= 0.4));
}

#[rstest]
#[case("wax", "model")]
#[case("paint", "particle")]
#[case("paint", "search")]
fn where_nothing_is_allowed_nothing_is_executed(#[case] preset: &str, #[case] method: &str) {
    let bounded = problem(preset, json!({"name": method}), &inside_box([5.0; 3], [6.0; 3]));
    let (poses, result) = executed(&bounded, 1, 10);
    assert!(poses.is_empty());
    let error = result.unwrap_err().to_string();
    assert!(error.starts_with("goal 0: no candidate satisfied the constraints"), "{error}");
}

#[rstest]
#[case(json!({"constraints": [{"kind": "population_velocity", "limit_rad": 1.0}]}), "it breeds no population")]
#[case(json!({"handling": {"strategy": "repairing"}}), "needs handling \"rejecting\"")]
#[case(json!({"method": {"name": "model", "max_step_deg": 0.0}}), "max_step_deg is 0")]
fn refuses_what_only_populations_can_do(#[case] execution: Value, #[case] told: &str) {
    let refused = problem("wax", json!({"name": "model"}), &execution);
    let error = Iet::new(&refused, 1).err().unwrap().to_string();
    assert!(error.contains(told), "{error}");
}

#[rstest]
#[case("wax", "model")]
#[case("wax", "broyden")]
#[case("paint", "search")]
#[case("paint", "sst")]
fn no_executed_pose_is_in_an_obstacle(#[case] preset: &str, #[case] name: &str) {
    let (lower, upper) = ([0.2, -0.65, 0.2], [0.7, -0.45, 0.7]);
    let geometry = json!({"shape": "box", "lower_m": lower, "upper_m": upper});
    let obstacle = json!({"constraints": [{"kind": "region", "side": "outside", "geometry": geometry}]});
    let is_in = |problem: &Problem| {
        let chain = Iet::new(problem, 7).unwrap().chain().clone();
        let (poses, _) = executed(problem, 7, 60);
        poses
            .iter()
            .filter(|(_, pose)| {
                let tool = tool_position(&chain, pose);
                (0..3).all(|k| lower[k] < tool[k] && tool[k] < upper[k])
            })
            .count()
    };
    assert_eq!(is_in(&problem(preset, json!({ "name": name }), &obstacle)), 0);
    assert!(is_in(&problem(preset, json!({ "name": name }), &json!({}))) > 0, "nothing goes there anyway");
}
