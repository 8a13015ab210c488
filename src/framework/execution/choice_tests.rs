//! The method that `auto` stands for: one per kind of problem, and it can be run.

use super::*;
use crate::constraint::{
    ConstraintSpec, HandlingSpec, JointStepSpec, PenaltyForm, PenaltyKind, PenaltySpec, PopulationVelocitySpec,
};
use crate::method::whole_run::Prior;
use crate::method::{AutoSpec, Chosen, MethodSpec};
use crate::preset::shipped;
use rstest::rstest;

fn problem(preset: &str, wishes: AutoSpec) -> Problem {
    let mut problem = shipped(preset).unwrap().problem;
    problem.execution.method = MethodSpec::Auto(wishes);
    problem
}

fn chosen(mut problem: Problem) -> (MethodSpec, Chosen) {
    problem.choose();
    assert!(Iet::new(&problem, 1).is_ok(), "what is chosen can be run");
    (problem.execution.method, problem.execution.chosen.unwrap())
}

#[rstest]
#[case("wax", false, false, "model", "first moves teach a model")]
#[case("wax", true, false, "model", "description serves as a first guess")]
#[case("wax", false, true, "cma_es", "Trials cost nothing")]
#[case("wax", true, true, "cma_es", "Trials cost nothing")]
#[case("paint", false, false, "search", "nothing may be assumed")]
#[case("paint", true, false, "particle", "description may be used")]
#[case("paint", true, true, "particle", "description may be used")]
#[case("paint", false, true, "cma_es", "until every place is covered")]
fn each_kind_of_problem_has_its_method_and_reason(
    #[case] preset: &str,
    #[case] simulator: bool,
    #[case] free_evaluations: bool,
    #[case] method: &str,
    #[case] reason: &str,
) {
    let wishes = AutoSpec { simulator, free_evaluations, noise: 0.5 };
    let (spec, chosen) = chosen(problem(preset, wishes));
    assert_eq!((spec.name(), chosen.method.as_str()), (method, method));
    assert!(chosen.reason.contains(reason), "{}", chosen.reason);
    match spec {
        MethodSpec::Model(model) => {
            assert_eq!((model.prior == Prior::Simulator, model.noise), (simulator, 0.5));
        }
        MethodSpec::CmaEs(spec) => assert_eq!(spec.precision == 0.001, preset == "wax"),
        _ => {}
    }
}

#[test]
fn constraints_no_model_can_honour_get_an_optimiser_that_does() {
    for preset in ["wax", "paint"] {
        let mut velocity = problem(preset, AutoSpec::default());
        velocity.execution.constraints =
            vec![ConstraintSpec::PopulationVelocity(PopulationVelocitySpec { limit_rad: 0.7 })];
        let mut penalty = problem(preset, AutoSpec { simulator: true, ..AutoSpec::default() });
        penalty.execution.handling = HandlingSpec::Penalty(PenaltySpec {
            form: PenaltyForm::Additive,
            penalty: PenaltyKind::Death { value: 1e4 },
        });
        for problem in [velocity, penalty] {
            let (_, chosen) = chosen(problem);
            assert_eq!(chosen.method, "cma_es");
            assert!(chosen.reason.contains("constraints"), "{}", chosen.reason);
        }
    }
    let mut step = problem("wax", AutoSpec::default());
    step.execution.constraints = vec![ConstraintSpec::JointStep(JointStepSpec { limit_rad: 0.8, start: None })];
    assert_eq!(chosen(step).1.method, "model");
}

#[test]
fn an_explicit_method_stays_and_a_choice_that_is_none_any_more_goes() {
    let mut problem = problem("wax", AutoSpec::default());
    problem.choose();
    let settled = problem.clone();
    problem.choose();
    assert_eq!(problem, settled);
    problem.execution.method = MethodSpec::by_name("sst").unwrap();
    problem.choose();
    assert_eq!((problem.execution.method.name(), problem.execution.chosen), ("sst", None));
}

#[test]
fn a_problem_that_was_not_settled_runs_all_the_same() {
    let open = problem("wax", AutoSpec::default());
    let mut settled = open.clone();
    settled.choose();
    assert_eq!(run(&open, 3).unwrap(), run(&settled, 3).unwrap());
}
