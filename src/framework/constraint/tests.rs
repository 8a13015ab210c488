//! Promises of the strategies, for every geometry and optimiser: what is executed, what wins, what is told when nothing
//! is feasible, and that bits depend on neither batch sizes nor interruptions.

use super::fixtures;
use super::*;
use crate::execution::{Iet, Observations, Problem, ProblemError, RunResult, run, simulate};
use crate::method::MethodSpec;
use crate::method::per_goal::{Batch, Outcome, Provenance, SearchSpace};
use crate::preset::shipped;
use crate::robot::Chain;
use crate::world;
use proptest::prelude::*;
use proptest::sample::select;
use serde_json::{Value, json};

/// Regions that hold the first wax goals and cut the reachable space in different ways.
fn geometries() -> [ConstraintSpec; 7] {
    let bounded = |side| {
        move |geometry| ConstraintSpec::Region(RegionSpec { geometry, side, point: fixtures::constraint_point() })
    };
    let (region, obstacle) = (bounded(Side::Inside), bounded(Side::Outside));
    let (lower_m, upper_m) = ([0.235, -0.62, 0.292], [0.463, -0.435, 0.306]);
    let corners = (0..8).map(|c: usize| [0, 1, 2].map(|k| if c >> k & 1 == 0 { lower_m[k] } else { upper_m[k] }));
    let half = |normal, offset_m| HalfSpace { normal, offset_m };
    [
        region(GeometrySpec::Box { lower_m, upper_m, dilatation_m: 0.2 }),
        region(GeometrySpec::Sphere { center_m: [0.35, -0.5, 0.3], radius_m: 0.3 }),
        obstacle(GeometrySpec::Box { lower_m: [0.1, -0.7, 0.0], upper_m: [0.3, -0.5, 0.4], dilatation_m: 0.0 }),
        region(GeometrySpec::Hull { points_m: corners.collect(), dilatation_m: 0.15 }),
        region(GeometrySpec::Polyhedron {
            half_spaces: vec![half([-1.0, 0.0, 0.0], -0.1), half([1.0, 1.0, 1.0], 0.5)],
        }),
        ConstraintSpec::PopulationVelocity(PopulationVelocitySpec { limit_rad: 0.7 }),
        ConstraintSpec::JointStep(JointStepSpec { limit_rad: 0.4, start: Some(vec![0.5, 0.5, 0.8]) }),
    ]
}

fn penalty(form: PenaltyForm, penalty: PenaltyKind) -> HandlingSpec {
    HandlingSpec::Penalty(PenaltySpec { form, penalty })
}

/// Strategies that execute nothing infeasible.
fn hard() -> [HandlingSpec; 4] {
    [
        HandlingSpec::Rejecting { max_attempts: 200 },
        HandlingSpec::Repairing { max_attempts: 200 },
        HandlingSpec::Operators { max_attempts: 200 },
        penalty(PenaltyForm::Additive, PenaltyKind::Death { value: 1e6 }),
    ]
}

/// Strategies that execute infeasible candidates and tell them worse.
fn soft() -> [HandlingSpec; 4] {
    [
        penalty(PenaltyForm::Additive, PenaltyKind::Static { weight: 1e3, exponent: 2.0 }),
        penalty(PenaltyForm::Multiplicative, PenaltyKind::Dynamic { weight: 0.5, growth: 2.0, exponent: 2.0 }),
        penalty(PenaltyForm::Additive, PenaltyKind::Adaptive { weight: 10.0, window: 2, relax: 2.0, tighten: 3.0 }),
        penalty(PenaltyForm::Multiplicative, PenaltyKind::Annealing { temperature: 1.0, cooling: 0.7, frozen: 1e-6 }),
    ]
}

fn problem(method: &str, constraint: ConstraintSpec, handling: HandlingSpec) -> Problem {
    let mut problem = shipped("wax").unwrap().problem;
    let mut parameters = match method {
        "sst" | "de" => json!({"population": 12}),
        "cma_es" => json!({"restarts": 1}),
        _ => json!({"swarm": {"population": 12}}),
    };
    parameters["name"] = json!(method);
    let chosen: MethodSpec = serde_json::from_value(parameters).unwrap();
    problem.execution.method = chosen;
    problem.execution.constraints = vec![constraint];
    problem.execution.handling = handling;
    problem
}

/// A candidate that was executed, and the previous goal's winner.
type Step = (Vec<f64>, Option<Vec<f64>>);

/// All that was executed until the run ended or `most` executions.
fn executed(problem: &Problem, seed: u64, most: usize) -> Vec<Step> {
    let mut iet = Iet::new(problem, seed).unwrap();
    let mut world = world::build(&problem.world, iet.chain()).unwrap();
    let features = iet.world_features();
    let mut all = Vec::new();
    let mut batch = Batch::new(3, 8);
    let mut observations = Observations::new(3, features, Provenance::Simulated);
    while !iet.is_finished() && all.len() < most {
        batch.clear(8);
        iet.ask(&mut batch);
        observations.clear();
        let previous = iet.prefix().last().map(<[f64]>::to_vec);
        for (id, joints) in batch.iter() {
            world.observe(joints, observations.observed(id, joints));
            all.push((joints.to_vec(), previous.clone()));
        }
        if iet.tell(&observations).is_err() {
            break;
        }
    }
    all
}

fn constraints_of(problem: &Problem) -> (Constraints, Chain) {
    let arm = fixtures::arm();
    let constraints =
        Constraints::new(&problem.execution.constraints, &arm.model, &arm.robot, &arm.chain, &problem.world).unwrap();
    (constraints, arm.chain)
}

/// The first of 300 executions that violates a constraint, seen from the previous goal's winner.
fn infeasible_execution(problem: &Problem, seed: u64) -> Option<Step> {
    let (constraints, _) = constraints_of(problem);
    executed(problem, seed, 300).into_iter().find(|(joints, previous)| {
        !constraints.is_feasible(&Proposal { joints, origins: [None; 2], previous: previous.as_deref() })
    })
}

/// Whether goal winners satisfy the constraints, each seen from the one before.
fn winners_are_feasible(problem: &Problem, result: &RunResult) -> bool {
    let (constraints, _) = constraints_of(problem);
    let mut previous: Option<&[f64]> = None;
    result.goals.iter().all(|goal| {
        let proposal = Proposal { joints: &goal.joints, origins: [None; 2], previous };
        previous = Some(&goal.joints);
        goal.feasible && constraints.is_feasible(&proposal)
    })
}

/// The population of this seed keeps penalised candidates only; one of them once won the goal and was executed.
#[test]
fn a_penalised_winner_gives_way_to_an_executed_one() {
    let step = geometries()[6].clone();
    let problem = problem("sst", step, hard()[3].clone());
    assert_eq!(infeasible_execution(&problem, 16_844_561_136_683_199_414), None);
}

const METHODS: [&str; 6] = ["sst", "pso", "fi_pso", "affg_pso", "cma_es", "de"];

proptest! {

    /// Seen from the previous goal's winner, all goals and all methods. The velocity limit refers to ancestors instead:
    /// `children_of_a_velocity_limit_stay_near_an_ancestor`.
    #[test]
    fn hard_strategies_execute_nothing_infeasible(
        seed: u64, geometry in select(geometries().to_vec()), handling in select(hard().to_vec())
    ) {
        prop_assume!(!matches!(geometry, ConstraintSpec::PopulationVelocity(_)));
        for method in METHODS {
            let problem = problem(method, geometry.clone(), handling.clone());
            prop_assert_eq!(infeasible_execution(&problem, seed), None, "{} {:?} {:?}", method, handling, geometry);
        }
    }

    #[test]
    fn every_winner_is_feasible_or_the_run_says_it_has_none(
        seed: u64, geometry in select(geometries().to_vec()), handling in select([hard(), soft()].concat()),
        method in select(&METHODS[..])
    ) {
        let problem = problem(method, geometry, handling);
        match run(&problem, seed) {
            Ok(result) => {
                prop_assert!(winners_are_feasible(&problem, &result) && result.valid, "{problem:?}");
                prop_assert_eq!(result.tally.simulated, result.evaluations);
            }
            Err(ProblemError::Infeasible { nearest, .. }) => prop_assert!(nearest[0] > 0.0),
            Err(error) => prop_assert!(false, "{error}"),
        }
    }

    #[test]
    fn interrupted_anywhere_a_constrained_run_ends_with_the_same_digest(
        seed: u64, which in 0_usize..6, how in 0_usize..8, cuts in prop::collection::vec(1_u64..60, 1..6)
    ) {
        let handling = [hard(), soft()].concat()[how].clone();
        let problem = problem(METHODS[which % METHODS.len()], geometries()[which].clone(), handling);
        let whole = run(&problem, seed);
        let mut iet = Iet::new(&problem, seed).unwrap();
        for budget in cuts {
            let mut world = world::build(&problem.world, iet.chain()).unwrap();
            if simulate(&mut iet, world.as_mut(), budget).is_err() {
                prop_assert!(whole.is_err());
                return Ok(());
            }
            let saved = serde_json::to_string(&iet.state()).unwrap();
            iet = Iet::resume(&problem, serde_json::from_str(&saved).unwrap()).unwrap();
        }
        let mut world = world::build(&problem.world, iet.chain()).unwrap();
        match (simulate(&mut iet, world.as_mut(), u64::MAX), whole) {
            (Ok(_), Ok(whole)) => prop_assert_eq!(iet.finish().unwrap(), whole),
            (sliced, whole) => prop_assert!(sliced.is_err() && whole.is_err()),
        }
    }
}

#[test]
fn children_of_a_velocity_limit_stay_near_an_ancestor() {
    let limit = ConstraintSpec::PopulationVelocity(PopulationVelocitySpec { limit_rad: 0.8 });
    for handling in hard() {
        for method in METHODS {
            let problem = problem(method, limit.clone(), handling.clone());
            let (constraints, chain) = constraints_of(&problem);
            let space = SearchSpace {
                lower: chain.genes().iter().map(|g| g.lower).collect(),
                upper: chain.genes().iter().map(|g| g.upper).collect(),
                features: 1,
                target: None,
                near: None,
            };
            let mut optimizer = problem.execution.method.start(space.clone(), 5, 0).unwrap();
            let rules = Rules {
                constraints: std::sync::Arc::new(constraints.clone()),
                handling: handling.clone(),
                on_infeasible: OnInfeasible::Stop,
                previous: None,
            };
            let mut judge = Judge::new(rules, space, 5, 0);
            let mut batch = Batch::new(3, 1);
            let mut bred = 0;
            while judge.stop(optimizer.as_ref()).is_none() && bred < 200 {
                batch.clear(1);
                judge.ask(optimizer.as_mut(), &mut batch);
                let Some((id, joints)) = batch.iter().next() else { break };
                let origins = optimizer.origins(id);
                bred += u32::from(origins[0].is_some());
                let proposal = Proposal { joints, origins, previous: None };
                assert!(constraints.is_feasible(&proposal), "{method} {handling:?}");
                let fitness: f64 = joints.iter().map(|q| (q - 0.4).powi(2)).sum();
                let provenance = Provenance::Simulated;
                let seen = [fitness];
                judge.tell(optimizer.as_mut(), id, Outcome::Observed { fitness, observation: &seen, provenance });
            }
            assert!(bred >= 5, "{method} {handling:?}: {bred}");
        }
    }
}

#[test]
fn nothing_feasible_is_told_and_does_not_hang() {
    let nowhere = || {
        let geometry = GeometrySpec::Sphere { center_m: [9.0, 9.0, 9.0], radius_m: 0.1 };
        ConstraintSpec::Region(RegionSpec { geometry, side: Side::Inside, point: PointSpec::Tool })
    };
    for handling in [hard(), soft()].concat() {
        for method in METHODS {
            let mut problem = problem(method, nowhere(), handling.clone());
            let error = run(&problem, 1).unwrap_err();
            let ProblemError::Infeasible { goal: 0, nearest, .. } = &error else { panic!("{method} {error}") };
            assert!(nearest[0] > 10.0, "{method} {handling:?}: {nearest:?} m");
            assert!(error.to_string().contains("max_attempts"), "{error}");
            problem.execution.on_infeasible = OnInfeasible::Append;
            match run(&problem, 1) {
                Ok(result) => {
                    assert!(matches!(handling, HandlingSpec::Penalty(_)));
                    assert!(!result.valid && result.goals.iter().all(|goal| !goal.feasible));
                }
                Err(error) => {
                    assert!(!matches!(handling, HandlingSpec::Penalty(_)), "{method} {handling:?} {error}");
                    assert!(error.to_string().contains("needs handling \"penalty\""), "{error}");
                }
            }
        }
    }
}

#[test]
fn unexecuted_winners_and_constraints_exclude_each_other() {
    let mut preset = shipped("paper-wax").unwrap();
    assert!(preset.select_method("affg_pso"));
    preset.problem.execution.constraints = geometries()[..1].to_vec();
    let error = Iet::new(&preset.problem, 1).err().unwrap().to_string();
    assert!(error.contains("unexecuted_may_win"), "{error}");
}

/// Builds before the judge stood alone saved it around the optimiser.
#[test]
fn a_run_saved_with_its_optimizer_inside_the_judge_goes_on_with_the_same_bits() {
    for handling in [hard()[0].clone(), hard()[1].clone(), soft()[2].clone()] {
        let problem = problem("sst", geometries()[0].clone(), handling);
        let whole = run(&problem, 3).unwrap();
        let mut iet = Iet::new(&problem, 3).unwrap();
        let mut world = world::build(&problem.world, iet.chain()).unwrap();
        simulate(&mut iet, world.as_mut(), 40).unwrap();
        let mut saved = serde_json::to_value(iet.state()).unwrap();
        let mut enclosing = saved.as_object_mut().unwrap().remove("judge").unwrap();
        enclosing["inner"] = std::mem::replace(&mut saved["optimizer"], Value::Null);
        saved["optimizer"] = json!({"constrained": enclosing});
        let mut iet = Iet::resume(&problem, serde_json::from_value(saved).unwrap()).unwrap();
        simulate(&mut iet, world.as_mut(), u64::MAX).unwrap();
        assert_eq!(iet.finish().unwrap(), whole);
    }
}
