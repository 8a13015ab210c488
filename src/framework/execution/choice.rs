//! Which method `auto` stands for, and why: a pure function of the problem and of what may be assumed.
//!
//! The figures behind each branch are those of the shipped presets (three joints, 20 to 50 seeds):
//! - features that follow the pose: a model takes 14 to 20 evaluations, CMA-ES 920; where evaluations cost nothing, CMA-ES
//!   to 0.1 % of the joints' ranges ends 2 mm above what can be reached (146 mm of 144 mm, 2700 evaluations);
//! - a surface: particles 16 evaluations for 16 cells; the search 182 for 99 % of them; CMA-ES all of them in 437;
//! - constraints that judge a population, or penalties: CMA-ES 870 evaluations to 209 mm, PSO 5800 to 202 mm, SST 21000
//!   to 157 mm; on a surface CMA-ES 195 for all cells, SST 228 for 97 %.

use super::spec::{ExecutionSpec, Problem};
use crate::constraint::{ConstraintSpec, HandlingSpec};
use crate::method::per_goal::{AutoSpec, CmaEsSpec, MethodSpec, ParticleSpec};
use crate::method::whole_run::{CoverSpec, ModelSpec, Prior};
use crate::world::WorldSpec;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Precision of a search whose evaluations cost nothing, as a share of each joint's range.
const FREE_PRECISION: f64 = 0.001;

/// The method that was chosen for a problem, and why.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct Chosen {
    /// Name of the method.
    pub method: String,
    /// One sentence for the person who runs the robot.
    pub reason: String,
}

impl Problem {
    /// Puts the method that `auto` stands for in its place and writes down why; what was chosen before is kept only
    /// while it is still the method.
    pub fn choose(&mut self) {
        let execution = &mut self.execution;
        if let MethodSpec::Auto(wishes) = &execution.method {
            let (method, reason) = choose(wishes, execution, &self.world);
            execution.chosen = Some(Chosen { method: method.name().to_owned(), reason: reason.to_owned() });
            execution.method = method;
        } else if execution.chosen.as_ref().is_some_and(|chosen| chosen.method != execution.method.name()) {
            execution.chosen = None;
        }
    }
}

/// The method for a problem, and why.
pub(super) fn choose(wishes: &AutoSpec, execution: &ExecutionSpec, world: &WorldSpec) -> (MethodSpec, &'static str) {
    if needs_a_population(execution) {
        return (
            MethodSpec::CmaEs(CmaEsSpec::default()),
            "The constraints are judged on whole generations of candidates, which the methods of few trials do not have: \
             CMA-ES honours them with the fewest trials.",
        );
    }
    match (world.properties().surface.is_some(), wishes.simulator, wishes.free_evaluations) {
        (true, true, _) => (
            MethodSpec::Particle(ParticleSpec::default()),
            "A surface is to be covered and the robot's description may be used: each trial is the pose that most of many \
             slightly different simulated robots expect to cover one new place, about one trial a place.",
        ),
        (true, false, true) => (
            MethodSpec::CmaEs(CmaEsSpec::default()),
            "A surface is to be covered and trials cost nothing: CMA-ES goes on until every place is covered.",
        ),
        (true, false, false) => (
            MethodSpec::Search(CoverSpec::default()),
            "A surface is to be covered and nothing may be assumed of the robot: each trial is where past trials leave the \
             best chance of covering a new place.",
        ),
        (false, _, true) => (
            MethodSpec::CmaEs(CmaEsSpec { precision: FREE_PRECISION, ..CmaEsSpec::default() }),
            "Trials cost nothing, so the best result counts: CMA-ES comes closest to what the robot can reach.",
        ),
        (false, true, false) => (
            MethodSpec::Model(ModelSpec { prior: Prior::Simulator, noise: wishes.noise, ..ModelSpec::default() }),
            "What is seen follows the pose, and the robot's description serves as a first guess: a model corrects it from \
             trial to trial, about one trial a goal.",
        ),
        (false, false, false) => (
            MethodSpec::Model(ModelSpec { noise: wishes.noise, ..ModelSpec::default() }),
            "What is seen follows the pose, and nothing may be assumed of the robot: a few first moves teach a model of it, \
             then one or two trials a goal do.",
        ),
    }
}

/// Whether a method that owns the run would refuse the constraints.
fn needs_a_population(execution: &ExecutionSpec) -> bool {
    let ancestors = |constraint: &ConstraintSpec| matches!(constraint, ConstraintSpec::PopulationVelocity(_));
    execution.constraints.iter().any(ancestors) || !matches!(execution.handling, HandlingSpec::Rejecting { .. })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::constraint::{JointStepSpec, PenaltyForm, PenaltyKind, PenaltySpec, PopulationVelocitySpec};
    use crate::execution::{Iet, run};
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
            MethodSpec::CmaEs(spec) => assert_eq!(spec.precision == FREE_PRECISION, preset == "wax"),
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
}
