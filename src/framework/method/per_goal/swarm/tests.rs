//! Semantics of memory, leader and hall of fame, independence of batch sizes, resumption, and golden runs.

use super::*;
use crate::method::MethodSpec;
use crate::method::per_goal::PsoSpec;
use proptest::prelude::*;
use rstest::rstest;

const METHODS: [&str; 3] = ["pso", "fi_pso", "affg_pso"];

fn space(target: Option<f64>) -> SearchSpace {
    SearchSpace { lower: vec![-0.26; 3], upper: vec![1.75; 3], features: 1, target, near: None }
}

fn sphere(joints: &[f64]) -> f64 {
    1.0 + joints.iter().map(|q| (q - 0.4) * (q - 0.4)).sum::<f64>()
}

fn small(name: &str) -> MethodSpec {
    let mut method = MethodSpec::by_name(name).unwrap();
    match &mut method {
        MethodSpec::Pso(spec) => spec.swarm.population = 12,
        MethodSpec::FiPso(spec) => spec.swarm.population = 12,
        MethodSpec::AffgPso(spec) => (spec.swarm.population, spec.omega) = (12, 0.3),
        other => panic!("{} is not a swarm", other.name()),
    }
    method
}

/// Every candidate of a whole search, asked `size` at a time, in the order of their ids.
fn search(method: &MethodSpec, seed: u64, size: usize) -> (Vec<(u64, Vec<u64>)>, u64, Tally) {
    let mut swarm = method.start(space(None), seed, 0).unwrap();
    let (mut batch, mut seen) = (Batch::new(3, size), Vec::new());
    while swarm.stop().is_none() {
        batch.clear(size);
        swarm.ask(&mut batch);
        assert!(!batch.is_empty() || swarm.stop().is_some());
        for (id, joints) in batch.iter() {
            seen.push((id, joints.iter().map(|q| q.to_bits()).collect()));
            let fitness = sphere(joints);
            swarm.tell(id, Outcome::Observed { fitness, observation: &[fitness], provenance: Provenance::Simulated });
        }
    }
    seen.sort();
    let best = swarm.best().unwrap();
    assert_eq!(best.fitness.to_bits(), sphere(best.joints).to_bits(), "the winner was executed");
    (seen, best.fitness.to_bits(), swarm.tally())
}

proptest! {
    #[test]
    fn bits_do_not_depend_on_batch_sizes(seed: u64, size in 2_usize..40) {
        for name in METHODS {
            prop_assert_eq!(search(&small(name), seed, 1), search(&small(name), seed, size), "{}", name);
        }
    }

    #[test]
    fn interrupted_anywhere_the_search_ends_with_the_same_bits(seed: u64, cuts in prop::collection::vec(1_usize..30, 1..8)) {
        for name in METHODS {
            let method = small(name);
            let mut swarm = method.start(space(None), seed, 0).unwrap();
            let mut batch = Batch::new(3, 4);
            for cut in cuts.iter().copied().chain([usize::MAX]) {
                let mut told = 0;
                while swarm.stop().is_none() && told < cut {
                    batch.clear(4);
                    swarm.ask(&mut batch);
                    for (id, joints) in batch.iter().take(cut - told) {
                        let fitness = sphere(joints);
                        let provenance = Provenance::Simulated;
                        swarm.tell(id, Outcome::Observed { fitness, observation: &[fitness], provenance });
                        told += 1;
                    }
                }
                let saved = serde_json::to_string(&swarm.state()).unwrap();
                swarm = method.resume(space(None), serde_json::from_str(&saved).unwrap()).unwrap();
            }
            let (_, best, tally) = search(&method, seed, 1);
            prop_assert_eq!((swarm.best().unwrap().fitness.to_bits(), swarm.tally()), (best, tally));
        }
    }
}

#[test]
fn a_swarm_that_only_estimates_ends() {
    let mut method = small("fi_pso");
    if let MethodSpec::FiPso(spec) = &mut method {
        (spec.inheritance_probability, spec.swarm.stagnation) = (1.0, u32::MAX);
    }
    let (seen, _, tally) = search(&method, 1, 5);
    assert_eq!(seen.len(), 12, "the first generation alone is executed");
    assert!(tally.inherited >= MOST_ESTIMATES && tally.inherited < MOST_ESTIMATES + 100, "{tally:?}");
    assert_eq!(search(&method, 1, 1).2, tally);
}

#[test]
fn rejection_proposes_another_in_the_same_place() {
    for name in METHODS {
        let mut swarm = small(name).start(space(None), 3, 0).unwrap();
        let mut batch = Batch::new(3, 1);
        for round in 0..200 {
            batch.clear(1);
            swarm.ask(&mut batch);
            let Some((id, joints)) = batch.iter().next() else { break };
            let fitness = sphere(joints);
            if round % 3 == 0 {
                let origin = swarm.origins(id)[0].map(<[f64]>::to_vec);
                swarm.tell(id, Outcome::Rejected);
                batch.clear(1);
                swarm.ask(&mut batch);
                let Some((next, other)) = batch.iter().next() else { break };
                assert_ne!(next, id);
                if name == "pso" {
                    assert_eq!(swarm.origins(next)[0].map(<[f64]>::to_vec), origin, "it starts where the other did");
                }
                let fitness = sphere(other);
                let provenance = Provenance::Simulated;
                swarm.tell(next, Outcome::Observed { fitness, observation: &[fitness], provenance });
            } else {
                let provenance = Provenance::Simulated;
                swarm.tell(id, Outcome::Observed { fitness, observation: &[fitness], provenance });
            }
        }
        assert!(swarm.generation() > 0, "{name}");
    }
}

#[test]
fn quirks_set_where_memory_and_velocity_begin() {
    let degree = 1.0_f64.to_radians();
    let plain = SwarmState::new(&SwarmSpec::default(), &space(None), 5, 0);
    assert_eq!(plain.memory, plain.x);
    assert!(plain.v.iter().any(|v| *v < 0.0));
    let spec = SwarmSpec { ecf_memory_quirk: true, ecf_velocity_quirk: true, ..SwarmSpec::default() };
    let quirky = SwarmState::new(&spec, &space(None), 5, 0);
    assert!(quirky.memory.iter().chain(&quirky.v).all(|value| (0.0..degree).contains(value)));
}

/// Evaluations, best fitness and fitness values that cost no evaluation of one seeded search.
#[rstest]
#[case("pso", 72, 1.014_839_024_628_242, 0, 0)]
#[case("fi_pso", 194, 1.000_706_551_377_666, 190, 0)]
#[case("affg_pso", 16, 1.034_071_451_220_82, 0, 56)]
fn golden(
    #[case] name: &str,
    #[case] evaluations: usize,
    #[case] best: f64,
    #[case] inherited: u64,
    #[case] granule: u64,
) {
    let (seen, found, tally) = search(&small(name), 2024, 1);
    let found = (seen.len(), f64::from_bits(found), tally.inherited, tally.granule);
    assert_eq!(found, (evaluations, best, inherited, granule));
}

#[test]
fn parameters_out_of_range_are_named() {
    let spec = |change: fn(&mut SwarmSpec)| {
        let mut swarm = SwarmSpec::default();
        change(&mut swarm);
        MethodSpec::Pso(PsoSpec { swarm }).start(space(None), 1, 0).err().unwrap().to_string()
    };
    assert!(spec(|s| s.population = 1).contains("population is 1"));
    assert!(spec(|s| s.inertia = f64::NAN).contains("inertia"));
    assert!(spec(|s| s.max_velocity = Some(-1.0)).contains("max_velocity is -1"));
}
