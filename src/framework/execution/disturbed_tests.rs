//! Runs in a simulated world that loses observations: every method goes on, and each lost one costs.

use super::*;
use crate::method::MethodSpec;
use crate::method::per_goal::{Batch, Provenance};
use crate::preset::shipped;
use crate::world::DisturbanceSpec;
use rstest::rstest;

#[rstest]
fn every_method_survives_lost_observations(
    #[values("sst", "pso", "fi_pso", "affg_pso", "cma_es", "model", "particle", "search")] method: &str,
) {
    let paint = matches!(method, "particle" | "search");
    let mut problem = shipped(if paint { "paint" } else { "wax" }).unwrap().problem;
    problem.execution.method = MethodSpec::by_name(method).unwrap();
    problem.execution.max_evaluations_per_goal = (!paint).then_some(60);
    problem.execution.reality = Some(DisturbanceSpec { lost_share: 0.3, ..DisturbanceSpec::default() });
    let mut iet = Iet::new(&problem, 11).unwrap();
    let mut world = iet.world().unwrap();
    let mut batch = Batch::new(3, 1);
    let mut scratch = vec![0.0; iet.world_features()];
    let (mut seen, mut lost) = (0, 0);
    while !iet.is_finished() && seen + lost < 80 {
        world.reset();
        iet.prefix().for_each(|pose| world.commit(pose, &mut scratch));
        batch.clear(1);
        iet.ask(&mut batch);
        let mut observations = Observations::new(3, scratch.len(), Provenance::Simulated);
        for (id, joints) in batch.iter().filter(|candidate| candidate.0 != u64::MAX) {
            let row = observations.observed(id, joints);
            world.observe(joints, row);
            if row[0].is_nan() { lost += 1 } else { seen += 1 }
        }
        iet.tell(&observations).unwrap();
    }
    assert!(lost > 0 && seen > lost, "{seen} seen, {lost} lost");
    assert_eq!(iet.evaluations(), seen + lost);
}

#[test]
fn a_sensor_that_shows_nothing_ends_the_run() {
    for (preset, method) in [("wax", "model"), ("wax", "sst"), ("paint", "search")] {
        let mut problem = shipped(preset).unwrap().problem;
        problem.execution.method = MethodSpec::by_name(method).unwrap();
        let mut iet = Iet::new(&problem, 1).unwrap();
        let mut batch = Batch::new(3, 1);
        let error = (0..10_000).find_map(|_| {
            batch.clear(1);
            iet.ask(&mut batch);
            let mut observations = Observations::new(3, iet.world_features(), Provenance::Real);
            batch.iter().for_each(|(id, joints)| observations.observed(id, joints).fill(f64::NAN));
            iet.tell(&observations).err()
        });
        let error = error.unwrap().to_string();
        assert!(error.contains("trials was executed and observed"), "{method}: {error}");
    }
}
