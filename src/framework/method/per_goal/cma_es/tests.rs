//! Convergence on functions with a known minimum, warm starts, restarts, independence of batch sizes, resumption.

use super::*;
use crate::method::MethodSpec;
use crate::method::per_goal::BoundsRule;
use proptest::prelude::*;
use rstest::rstest;

fn space(n: usize, near: Option<Vec<f64>>) -> SearchSpace {
    SearchSpace { lower: vec![-2.0; n], upper: vec![2.0; n], features: 1, target: None, near }
}

fn exact() -> CmaEsSpec {
    CmaEsSpec { precision: 1e-7, stagnation: 60, ..CmaEsSpec::default() }
}

fn sphere(q: &[f64]) -> f64 {
    q.iter().map(|q| (q - 0.4).powi(2)).sum()
}

/// Minimum 0 at (1, .., 1), at the end of a bent valley.
fn rosenbrock(q: &[f64]) -> f64 {
    q.windows(2).map(|w| 100.0 * (w[1] - w[0] * w[0]).powi(2) + (1.0 - w[0]).powi(2)).sum()
}

/// An ellipsoid whose axes differ by 1000, turned against the coordinates.
fn cigar(q: &[f64]) -> f64 {
    let along = q.iter().map(|q| q - 0.3).sum::<f64>() / (q.len() as f64).sqrt();
    let all: f64 = q.iter().map(|q| (q - 0.3).powi(2)).sum();
    along * along + 1e6 * (all - along * along)
}

/// A plateau with one small hole.
fn plateau(q: &[f64]) -> f64 {
    let miss = q.iter().map(|q| (q + 1.2).powi(2)).sum::<f64>().sqrt();
    if miss < 0.5 { miss } else { 10.0 }
}

struct Found {
    evaluations: usize,
    fitness: f64,
    joints: Vec<f64>,
    /// All candidates by id, to the bit.
    seen: Vec<(u64, Vec<u64>)>,
}

fn search(spec: &CmaEsSpec, space: &SearchSpace, seed: u64, size: usize, of: fn(&[f64]) -> f64) -> Found {
    let mut search = MethodSpec::CmaEs(spec.clone()).start(space.clone(), seed, 0).unwrap();
    let (mut batch, mut seen) = (Batch::new(space.lower.len(), size), Vec::new());
    while search.stop().is_none() {
        batch.clear(size);
        search.ask(&mut batch);
        assert!(!batch.is_empty());
        for (id, joints) in batch.iter() {
            seen.push((id, joints.iter().map(|q| q.to_bits()).collect()));
            let fitness = of(joints);
            search.tell(id, Outcome::Observed { fitness, observation: &[fitness], provenance: Provenance::Simulated });
        }
    }
    seen.sort();
    let best = search.best().unwrap();
    assert_eq!(best.fitness, of(best.joints));
    Found { evaluations: seen.len(), fitness: best.fitness, joints: best.joints.to_vec(), seen }
}

#[rstest]
#[case(sphere, 3, 0.4)]
#[case(sphere, 10, 0.4)]
#[case(rosenbrock, 4, 1.0)]
#[case(cigar, 5, 0.3)]
fn finds_a_known_minimum(#[case] of: fn(&[f64]) -> f64, #[case] n: usize, #[case] at: f64) {
    for seed in 0..5 {
        let found = search(&exact(), &space(n, None), seed, 8, of);
        assert!(found.joints.iter().all(|q| (q - at).abs() < 1e-4), "seed {seed}: {:?}", found.joints);
        assert!(found.evaluations < 6000, "seed {seed}: {}", found.evaluations);
    }
}

#[test]
fn finds_a_minimum_on_the_limits() {
    let beyond = |q: &[f64]| q.iter().map(|q| (q - 3.0).powi(2)).sum::<f64>();
    for bounds in [BoundsRule::Clamp, BoundsRule::Reflect] {
        let found = search(&CmaEsSpec { bounds, ..exact() }, &space(3, None), 1, 8, beyond);
        assert!(found.joints.iter().all(|q| (1.999..=2.0).contains(q)), "{bounds:?} {:?}", found.joints);
    }
}

#[test]
fn a_warm_search_is_shorter() {
    let mean = |near: Option<Vec<f64>>| {
        let spec = CmaEsSpec::default();
        (0..20).map(|seed| search(&spec, &space(3, near.clone()), seed, 8, sphere).evaluations).sum::<usize>()
    };
    let (cold, warm) = (mean(None), mean(Some(vec![0.45, 0.3, 0.4])));
    assert!(4 * warm < 3 * cold, "{warm} against {cold}");
}

#[test]
fn a_plateau_is_searched_by_larger_and_larger_populations() {
    let mut hits = 0;
    for seed in 0..10 {
        let found = search(&CmaEsSpec::default(), &space(3, Some(vec![1.5; 3])), seed, 8, plateau);
        hits += u32::from(found.fitness < 0.2);
    }
    assert!(hits >= 8, "{hits} of 10");
    let spec = CmaEsSpec { restarts: 2, ..CmaEsSpec::default() };
    let nothing = search(&spec, &space(3, None), 1, 8, |_| 5.0);
    assert_eq!(nothing.evaluations, 7 + 14 + 28);
}

#[test]
fn failures_are_outlived() {
    let spec = CmaEsSpec { restarts: 3, ..CmaEsSpec::default() };
    let mut search = CmaEs::new(&spec, space(3, None), 4, 0).unwrap();
    let mut batch = Batch::new(3, 1);
    while search.stop().is_none() {
        batch.clear(1);
        search.ask(&mut batch);
        let (id, joints) = batch.iter().next().unwrap();
        let (fitness, provenance) = (sphere(joints), Provenance::Simulated);
        let observed = Outcome::Observed { fitness, observation: &[fitness], provenance };
        search.tell(id, if joints[0] > 0.0 { observed } else { Outcome::Failed });
    }
    assert!(search.best().unwrap().fitness < 0.01);
    let mut dead = CmaEs::new(&spec, space(3, None), 4, 0).unwrap();
    while dead.stop().is_none() {
        batch.clear(1);
        dead.ask(&mut batch);
        let id = batch.iter().next().unwrap().0;
        dead.tell(id, Outcome::Failed);
    }
    assert!(dead.best().is_none());
}

proptest! {
    #[test]
    fn bits_do_not_depend_on_batch_sizes(seed: u64, size in 2_usize..40) {
        let spec = CmaEsSpec::default();
        prop_assert_eq!(search(&spec, &space(3, None), seed, 1, sphere).seen, search(&spec, &space(3, None), seed, size, sphere).seen);
    }

    #[test]
    fn interrupted_anywhere_the_search_ends_with_the_same_bits(seed: u64, cuts in prop::collection::vec(1_usize..30, 1..8)) {
        let (spec, space) = (CmaEsSpec { restarts: 2, ..CmaEsSpec::default() }, space(3, Some(vec![0.5; 3])));
        let method = MethodSpec::CmaEs(spec.clone());
        for of in [sphere, plateau] {
            let mut search_on = method.start(space.clone(), seed, 0).unwrap();
            let mut batch = Batch::new(3, 4);
            for cut in cuts.iter().copied().chain([usize::MAX]) {
                let mut told = 0;
                while search_on.stop().is_none() && told < cut {
                    batch.clear(4);
                    search_on.ask(&mut batch);
                    for (id, joints) in batch.iter().take(cut - told) {
                        let (fitness, provenance) = (of(joints), Provenance::Simulated);
                        search_on.tell(id, Outcome::Observed { fitness, observation: &[fitness], provenance });
                        told += 1;
                    }
                }
                let saved = serde_json::to_string(&search_on.state()).unwrap();
                search_on = method.resume(space.clone(), serde_json::from_str(&saved).unwrap()).unwrap();
            }
            let whole = search(&spec, &space, seed, 1, of);
            prop_assert_eq!(search_on.best().unwrap().fitness.to_bits(), whole.fitness.to_bits());
            prop_assert_eq!(search_on.best().unwrap().joints, &whole.joints[..]);
        }
    }

    #[test]
    fn closed_bounds_are_kept(seed: u64, warm: bool) {
        let near = warm.then(|| vec![2.0; 4]);
        let found = search(&CmaEsSpec::default(), &space(4, near), seed, 8, rosenbrock);
        prop_assert!(found.seen.iter().flat_map(|s| &s.1).all(|q| (-2.0..=2.0).contains(&f64::from_bits(*q))));
    }
}

#[test]
fn golden() {
    let found = search(&CmaEsSpec::default(), &space(3, Some(vec![0.0; 3])), 2024, 1, rosenbrock);
    assert_eq!((found.evaluations, found.fitness), (98, 0.786_211_637_655_624_5));
}

#[test]
fn parameters_out_of_range_and_foreign_states_are_named() {
    let refused = |change: fn(&mut CmaEsSpec)| {
        let mut spec = CmaEsSpec::default();
        change(&mut spec);
        CmaEs::new(&spec, space(3, None), 1, 0).unwrap_err().to_string()
    };
    assert!(refused(|s| s.population = Some(3)).contains("population is 3"));
    assert!(refused(|s| s.precision = 0.0).contains("precision is 0"));
    assert!(refused(|s| s.warm_step = Some(f64::NAN)).contains("warm_step"));
    assert!(refused(|s| s.restart_growth = 0.5).contains("restart_growth is 0.5"));
    let state = CmaEs::new(&CmaEsSpec::default(), space(3, None), 1, 0).unwrap().state;
    let error = CmaEs::resume(&CmaEsSpec::default(), space(4, None), state).unwrap_err().to_string();
    assert!(error.contains("belongs to another job"), "{error}");
}
