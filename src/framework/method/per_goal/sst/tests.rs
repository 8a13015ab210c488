//! Operator properties, semantics of hall of fame and stagnation, resumption, and a golden run.

use super::*;
use proptest::prelude::*;

fn space(target: Option<f64>) -> SearchSpace {
    SearchSpace { lower: vec![-0.26; 3], upper: vec![1.75; 3], features: 1, target, near: None }
}

fn sphere(joints: &[f64]) -> f64 {
    joints.iter().map(|q| (q - 0.4) * (q - 0.4)).sum()
}

/// Reports the outcome of at most `budget` candidates; returns their number.
fn drive(sst: &mut Sst, objective: fn(&[f64]) -> f64, budget: usize) -> usize {
    let mut batch = Batch::new(3, 7);
    let mut told = 0;
    while sst.stop().is_none() && told < budget {
        batch.clear(7.min(budget - told));
        sst.ask(&mut batch);
        assert!(!batch.is_empty(), "a search that has not stopped names candidates");
        for (id, joints) in batch.iter() {
            let fitness = objective(joints);
            sst.tell(id, Outcome::Observed { fitness, observation: &[fitness], provenance: Provenance::Simulated });
            told += 1;
        }
    }
    told
}

fn sst(spec: &SstSpec, seed: u64) -> Sst {
    Sst::new(spec, space(None), seed, 0).unwrap()
}

fn genes() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(-0.26..1.75_f64, 3)
}

/// Applies operator `name` to parents p1 and p2, with the child's slot initially at `old`.
fn cross(name: &str, p1: &[f64], p2: &[f64], old: f64, first: usize, seed: u64) -> Vec<f64> {
    let parents =
        Parents { p1, p2, fitness: [1.0, 2.0], lower: &[-0.26; 3], upper: &[1.75; 3], first, shared: [false; 2] };
    let mut child = vec![old; 3];
    let operator = CROSSOVERS.iter().find(|(n, _)| *n == name).unwrap().1;
    operator(&parents, &mut child, &mut crate::random::RandomStream::new(seed, 0));
    child
}

proptest! {
    #[test]
    fn operators_between_the_parents_stay_between_them(p1 in genes(), p2 in genes(), seed: u64) {
        let between =
            ["one_point", "arithmetic", "discrete", "arithmetic_simple", "arithmetic_single", "average", "flat", "heuristic", "local"];
        for name in between {
            for (gene, value) in cross(name, &p1, &p2, 9.0, 0, seed).into_iter().enumerate() {
                let (low, high) = (p1[gene].min(p2[gene]), p1[gene].max(p2[gene]));
                prop_assert!(value >= low - 1e-12 && value <= high + 1e-12, "{} {}", name, value);
            }
        }
    }

    #[test]
    fn one_point_and_discrete_take_whole_genes(p1 in genes(), p2 in genes(), seed: u64) {
        for name in ["one_point", "discrete"] {
            for (gene, value) in cross(name, &p1, &p2, 9.0, 0, seed).into_iter().enumerate() {
                prop_assert!(value.to_bits() == p1[gene].to_bits() || value.to_bits() == p2[gene].to_bits());
            }
        }
    }

    #[test]
    fn arithmetic_single_changes_one_gene_of_a_parent(p1 in genes(), p2 in genes(), seed: u64) {
        let child = cross("arithmetic_single", &p1, &p2, 9.0, 0, seed);
        let changed = |p: &[f64]| p.iter().zip(&child).filter(|(a, b)| a.to_bits() != b.to_bits()).count();
        prop_assert!(changed(&p1).min(changed(&p2)) <= 1);
    }

    #[test]
    fn arithmetic_lies_on_the_line_between_the_parents(p1 in genes(), p2 in genes(), seed: u64) {
        let child = cross("arithmetic", &p1, &p2, 9.0, 0, seed);
        let share = |k: usize| (child[k] - p2[k]) / (p1[k] - p2[k]);
        prop_assume!((0..3).all(|k| (p1[k] - p2[k]).abs() > 1e-3));
        prop_assert!((share(0) - share(1)).abs() < 1e-9 && (share(0) - share(2)).abs() < 1e-9);
    }

    #[test]
    fn bounded_operators_stay_in_the_limits(p1 in genes(), p2 in genes(), seed: u64) {
        for name in ["simulated_binary", "breeder"] {
            for value in cross(name, &p1, &p2, 9.0, 0, seed) {
                prop_assert!((-0.26 - 1e-9..=1.75 + 1e-9).contains(&value), "{} {}", name, value);
            }
        }
    }

    #[test]
    fn blends_reach_as_far_as_they_should_and_no_farther(p1 in genes(), p2 in genes(), seed: u64) {
        let (alpha, both) = (cross("blx_alpha", &p1, &p2, 9.0, 0, seed), cross("blx_alpha_beta", &p1, &p2, 9.0, 0, seed));
        for gene in 0..3 {
            let (low, high) = (p1[gene].min(p2[gene]), p1[gene].max(p2[gene]));
            let interval = high - low;
            prop_assert!(alpha[gene] >= low - 0.5 * interval - 1e-12 && alpha[gene] <= high + 0.5 * interval + 1e-12);
            let (below, above) = if p1[gene] <= p2[gene] { (0.5, 0.25) } else { (0.25, 0.5) };
            prop_assert!(both[gene] >= low - below * interval - 1e-12 && both[gene] <= high + above * interval + 1e-12);
        }
    }

    #[test]
    fn the_quirk_leaves_gene_0_alone_in_four_operators_only(p1 in genes(), p2 in genes(), seed: u64) {
        for (name, _) in CROSSOVERS {
            let kept = cross(name, &p1, &p2, 9.0, 1, seed)[0].to_bits() == 9.0_f64.to_bits();
            prop_assert_eq!(kept, ["flat", "heuristic", "blx_alpha", "blx_alpha_beta"].contains(&name), "{}", name);
            prop_assert!(cross(name, &p1, &p2, 9.0, 0, seed)[0] < 9.0);
        }
    }

    #[test]
    fn clamped_candidates_can_be_executed(seed: u64) {
        let mut sst = sst(&SstSpec::default(), seed);
        let mut batch = Batch::new(3, 50);
        for _ in 0..200 {
            batch.clear(50);
            sst.ask(&mut batch);
            for (id, joints) in batch.iter() {
                prop_assert!(joints.iter().all(|q| (-0.26..=1.75).contains(q)));
                sst.tell(id, Outcome::Observed { fitness: -joints[0], observation: &[0.0], provenance: Provenance::Simulated });
            }
        }
    }

    #[test]
    fn a_resumed_search_ends_with_the_same_bits(seed: u64, cuts in prop::collection::vec(1_usize..120, 1..6)) {
        let spec = SstSpec { population: 12, ..SstSpec::default() };
        let mut whole = sst(&spec, seed);
        let told = drive(&mut whole, sphere, usize::MAX);
        let mut cut = sst(&spec, seed);
        let mut told_in_parts = 0;
        for budget in cuts {
            told_in_parts += drive(&mut cut, sphere, budget);
            let mut batch = Batch::new(3, 3);
            cut.ask(&mut batch); // asked, lost with the process, asked again
            let saved: OptimizerState = serde_json::from_str(&serde_json::to_string(&cut.state()).unwrap()).unwrap();
            cut = Sst::resume(&spec, space(None), saved.read("sst").unwrap()).unwrap();
        }
        told_in_parts += drive(&mut cut, sphere, usize::MAX);
        prop_assert_eq!(told, told_in_parts);
        prop_assert_eq!(whole.state(), cut.state());
    }
}

#[test]
fn stops_after_stagnation_plus_one_generations_without_strict_improvement() {
    let spec = SstSpec { population: 10, stagnation: 3, ..SstSpec::default() };
    let mut flat = sst(&spec, 1);
    // Generation 0, then S + 1 = 4 generations of 10.
    assert_eq!(drive(&mut flat, |_| 5.0, usize::MAX), 50);
    assert_eq!(flat.stop(), Some(StopReason::Stagnation));
}

#[test]
fn ties_go_to_the_last_individual() {
    let spec = SstSpec { population: 10, ..SstSpec::default() };
    let mut batch = Batch::new(3, 10);
    sst(&spec, 1).ask(&mut batch);
    let last = batch.iter().last().unwrap().1.to_vec();
    let mut flat = sst(&spec, 1);
    drive(&mut flat, |_| 5.0, usize::MAX);
    assert_eq!(flat.best().unwrap().joints, last);
}

#[test]
fn the_target_is_looked_for_at_once_or_at_the_end_of_a_generation() {
    let count = |ecf_target_at_generation_end| {
        let spec = SstSpec { population: 10, ecf_target_at_generation_end, ..SstSpec::default() };
        let mut sst = Sst::new(&spec, space(Some(0.0)), 1, 0).unwrap();
        let told = drive(&mut sst, |_| 0.0, usize::MAX);
        assert_eq!(sst.stop(), Some(StopReason::Target));
        told
    };
    assert_eq!(count(true), 10);
    assert_eq!(count(false), 1 + 6, "the rest of the batch was already out");
}

#[test]
fn failed_trials_never_win() {
    let mut sst = sst(&SstSpec { population: 3, ..SstSpec::default() }, 1);
    let mut batch = Batch::new(3, 3);
    sst.ask(&mut batch);
    sst.tell(0, Outcome::Failed);
    sst.tell(2, Outcome::Failed);
    assert!(sst.best().is_none());
    sst.tell(1, Outcome::Observed { fitness: 1e9, observation: &[3.0], provenance: Provenance::Real });
    let best = sst.best().unwrap();
    assert_eq!((best.fitness, best.observation, best.provenance), (1e9, &[3.0][..], Provenance::Real));
    sst.tell(1, Outcome::Observed { fitness: 0.0, observation: &[0.0], provenance: Provenance::Real });
    assert_eq!(sst.best().unwrap().fitness.to_bits(), 1e9_f64.to_bits(), "news of a candidate told before is ignored");
}

#[test]
fn refuses_parameters_and_foreign_states() {
    let error = Sst::new(&SstSpec { population: 2, ..SstSpec::default() }, space(None), 1, 0).unwrap_err();
    assert_eq!(error.to_string(), "sst: population is 2: give 3 to 100000");
    let spec = SstSpec { mutation_probability: f64::NAN, ..SstSpec::default() };
    assert!(Sst::new(&spec, space(None), 1, 0).is_err());
    let saved = sst(&SstSpec { population: 4, ..SstSpec::default() }, 1).state;
    let error = Sst::resume(&SstSpec::default(), space(None), saved.clone()).unwrap_err().to_string();
    assert!(error.contains("4 fitness values") && error.contains("needs 50"), "{error}");
    let newer = SstState { version: 2, ..saved };
    assert!(Sst::resume(&SstSpec { population: 4, ..SstSpec::default() }, space(None), newer).is_err());
}

#[test]
fn golden_run() {
    let mut sst = sst(&SstSpec::default(), 2026);
    let told = drive(&mut sst, sphere, usize::MAX);
    let best = sst.best().unwrap();
    assert_eq!((told, best.fitness.to_bits()), (900, 4_550_548_934_591_448_959), "{:e}", best.fitness);
}
