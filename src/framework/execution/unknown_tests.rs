//! Trials that may or may not have been executed.

use super::*;
use crate::method::per_goal::{Batch, Provenance};
use crate::preset::shipped;
use rstest::rstest;

/// Runs `problem` in batches of `size` and reports every `nth` trial once as unknown; like a job, it then stops and
/// resumes from the saved state. Returns the result and the number of stops.
fn run_with_unknown_trials(problem: &Problem, seed: u64, size: usize, nth: u64) -> (RunResult, u32) {
    let mut iet = Iet::new(problem, seed).unwrap();
    let mut world = iet.world().unwrap();
    let (genes, features) = (iet.chain().len(), iet.world_features());
    let mut seen = Observations::new(genes, features, Provenance::Real);
    let mut scratch = vec![0.0; features];
    let (mut executed, mut stops) = (0, 0);
    while !iet.is_finished() {
        world.reset();
        for joints in iet.prefix() {
            world.commit(joints, &mut scratch);
        }
        let mut batch = Batch::new(genes, size);
        iet.ask(&mut batch);
        seen.clear();
        let mut is_stopped = false;
        for (id, joints) in batch.iter() {
            executed += 1;
            if executed % nth == 0 {
                seen.unknown(id, joints);
                is_stopped = true;
            } else {
                world.observe(joints, seen.observed(id, joints));
            }
        }
        let before = iet.evaluations();
        iet.tell(&seen).unwrap();
        if is_stopped {
            assert!(iet.evaluations() < before + batch.len() as u64, "an unknown trial was counted");
            iet = Iet::resume(problem, iet.state()).unwrap();
            stops += 1;
        }
    }
    (iet.finish().unwrap(), stops)
}

#[rstest]
#[case("wax", "sst", 1, 97)]
#[case("wax", "pso", 8, 97)]
#[case("wax", "model", 1, 5)]
#[case("paint", "sst", 1, 97)]
fn an_unknown_trial_teaches_nothing_and_is_asked_for_again_after_a_resume(
    #[case] preset: &str,
    #[case] method: &str,
    #[case] size: usize,
    #[case] nth: u64,
) {
    let mut preset = shipped(preset).unwrap();
    assert!(preset.select_method(method));
    let expected = run(&preset.problem, 3).unwrap();
    let (found, stops) = run_with_unknown_trials(&preset.problem, 3, size, nth);
    assert!(stops > 0);
    assert_eq!(found.digest, expected.digest);
    assert_eq!(found.evaluations, expected.evaluations);
    assert!(found.goals.iter().all(|goal| goal.failures == 0));
}
