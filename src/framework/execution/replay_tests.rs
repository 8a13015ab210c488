//! Replays of runs of every kind of method.

use super::{Moves, Problem, Replay, RunResult, SAMPLES_PER_MOVE, replay, run};
use crate::method::{Knowledge, MethodSpec};
use crate::preset::shipped;
use crate::world::DisturbanceSpec;
use rstest::rstest;

fn problem(name: &str, method: &str) -> Problem {
    let mut preset = shipped(name).unwrap();
    assert!(preset.select_method(method));
    let mut problem = preset.problem;
    problem.execution.max_evaluations_per_goal = matches!(method, "sst" | "pso").then_some(60);
    problem
}

/// Replay of a motion along straight lines between the poses of the path.
fn replayed(problem: &Problem, result: &RunResult) -> Replay {
    let poses: Vec<Vec<f64>> = result.path.iter().map(|pose| pose.joints.clone()).collect();
    let line = |ends: &[Vec<f64>]| {
        let at = |step: usize| {
            let share = step as f64 / SAMPLES_PER_MOVE as f64;
            ends[0].iter().zip(&ends[1]).map(|(a, b)| a + (b - a) * share).collect()
        };
        (1..=SAMPLES_PER_MOVE).map(at).collect::<Vec<Vec<f64>>>()
    };
    let between: Vec<Vec<Vec<f64>>> = poses.windows(2).map(line).collect();
    replay(problem, result, Moves { poses: &poses, between: &between }).unwrap().replay
}

#[rstest]
#[case("wax", "sst")]
#[case("paint", "sst")]
#[case("paint", "particle")]
#[case("paint", "search")]
#[case("wax", "model")]
fn a_replay_shows_what_the_run_claims(#[case] preset: &str, #[case] method: &str) {
    let problem = problem(preset, method);
    for seed in 1..=3 {
        let result = run(&problem, seed).unwrap();
        let replay = replayed(&problem, &result);
        assert!(replay.agrees, "{preset} {method} {seed}: {:?}", replay.largest_difference);
        assert_eq!(replay.largest_difference, None);
        assert_eq!(replay.painted_percent.is_some(), preset == "paint");
        let along = replay.along.unwrap();
        assert!(along.discrepancy.is_finite());
        assert!(along.painted_percent >= replay.painted_percent, "a tool that never lifts covers more");
    }
}

#[rstest]
#[case("particle")]
#[case("search")]
fn every_cell_that_is_claimed_is_painted_by_the_path(#[case] method: &str) {
    let mut problem = problem("paint", method);
    // Fewer goals than cells, as from demonstrations.
    let rows: Vec<Vec<f64>> = (0..14).map(|goal| vec![f64::from(goal) * 100.0 / 13.0]).collect();
    problem.goals = crate::generalization::Goals::new(problem.goals.features().to_vec(), &rows).unwrap();
    let result = run(&problem, 1).unwrap();
    let replay = replayed(&problem, &result);
    assert!(replay.agrees, "{:?}", replay.largest_difference);
    assert_eq!(replay.painted_percent, result.painted_percent);
}

#[test]
fn noise_comes_about_again_and_the_effect_is_told_without_it() {
    let mut problem = problem("wax-reachable", "model");
    problem.execution.reality = Some(DisturbanceSpec {
        sensor_noise: 2.0,
        joint_noise_deg: 0.1,
        link_share: 0.02,
        ..DisturbanceSpec::default()
    });
    problem.execution.method.assume(&Knowledge { simulator: None, noise: Some(2.5) });
    let result = run(&problem, 4).unwrap();
    let replay = replayed(&problem, &result);
    assert!(replay.agrees, "{:?}", replay.largest_difference);
    assert_ne!(replay.discrepancy.to_bits(), result.discrepancy.to_bits());
}

#[test]
fn a_claim_that_does_not_hold_is_told_with_its_place() {
    let problem = problem("wax", "model");
    let mut result = run(&problem, 1).unwrap();
    let claimed = result.path[2].observation.as_mut().unwrap();
    claimed[1] += 1.0;
    let replay = replayed(&problem, &result);
    assert!(!replay.agrees);
    let difference = replay.largest_difference.unwrap();
    assert_eq!((difference.pose, difference.goal, difference.feature.as_str()), (2, Some(2), "y"));
    assert!(difference.to_string().starts_with("at pose 2 (goal 2) the run claims y = "), "{difference}");
}

#[test]
fn a_motion_of_another_length_is_refused() {
    let problem = problem("wax", "model");
    let result = run(&problem, 1).unwrap();
    let error = replay(&problem, &result, Moves { poses: &[], between: &[] }).unwrap_err().to_string();
    assert!(error.contains("poses of the motion"), "{error}");
}

#[test]
fn the_goals_themselves_have_no_discrepancy_along_their_lines() {
    let problem = problem("wax-reachable", "model");
    let result = run(&problem, 2).unwrap();
    let replay = replayed(&problem, &result);
    let along = replay.along.unwrap().discrepancy;
    assert!(along > 0.0 && along < 20.0 * replay.discrepancy.max(1.0), "{along} beside {}", replay.discrepancy);
    let MethodSpec::Model(_) = problem.execution.method else { panic!("the method is model") };
}
