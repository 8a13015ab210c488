//! Checks of the numbers of a problem before anything runs; a refusal names the number and the remedy.

use super::error::ProblemError;
use super::spec::ExecutionSpec;
use crate::constraint::{ConstraintError, HandlingSpec, Rules};
use crate::generalization::Goals;
use crate::method::per_goal::OptimizerError;
use crate::method::whole_run::Trial;
use crate::method::{MethodKind, MethodSpec};
use crate::range::Range;
use crate::world::WorldProperties;

/// Largest goal, features' unit: as large as a demonstration may be.
const MOST_GOAL: f64 = 1e9;

/// Checks that the parameters of the method are within their ranges, and that it can work in the world.
pub(super) fn check_method(spec: &MethodSpec, world: &WorldProperties) -> Result<(), ProblemError> {
    let method = spec.name();
    spec.check(world).map_err(|number| OptimizerError::Parameter { method, number })?;
    spec.fits(world).map_err(|expected| ProblemError::Method { method, expected })
}

/// Checks that distances from every goal can be computed.
pub(super) fn check_goals(goals: &Goals) -> Result<(), ProblemError> {
    Ok(Range::from(-MOST_GOAL..=MOST_GOAL).check_each("goals", None, goals.values())?)
}

/// Checks that every earlier trial has finite values for `genes` joints and, if it was observed, for m `features`.
pub(super) fn check_earlier(earlier: &[Trial], genes: usize, features: usize) -> Result<(), ProblemError> {
    for (trial, Trial { joints, observation, .. }) in earlier.iter().enumerate() {
        let wrong = |what, found, expected| Err(ProblemError::Earlier { trial, what, found, expected });
        let finite = |values: &[f64]| values.iter().filter(|v| v.is_finite()).count();
        if joints.len() != genes || finite(joints) != genes {
            return wrong("finite joints", finite(joints), genes);
        }
        if let Some(seen) = observation
            && (seen.len() != features || finite(seen) != features)
        {
            return wrong("finite features", finite(seen), features);
        }
    }
    Ok(())
}

/// Checks that limits, strategies and method fit together.
pub(super) fn check_spec(spec: &ExecutionSpec, name: &'static str, method: &MethodKind) -> Result<(), ProblemError> {
    let not_negative = Range::from(0.0..);
    not_negative.check("target_discrepancy", None, spec.target_discrepancy.unwrap_or(0.0))?;
    not_negative.check("tolerance", None, spec.tolerance.unwrap_or(0.0))?;
    not_negative.check("rounding_noise", None, spec.rounding_noise)?;
    Rules::check(&spec.handling, spec.on_infeasible)?;
    let needs = |expected| Err(ProblemError::Method { method: name, expected });
    match method {
        MethodKind::PerGoal(method) if method.unexecuted_may_win() && !spec.constraints.is_empty() => {
            return Err(ConstraintError::UnexecutedWinner.into());
        }
        MethodKind::WholeRun(_) if !matches!(spec.handling, HandlingSpec::Rejecting { .. }) => {
            return needs("handling \"rejecting\": it proposes no infeasible pose that another strategy could judge");
        }
        MethodKind::WholeRun(method) if spec.max_evaluations_per_goal.is_some() && !method.keeps_goal_limits() => {
            return needs(
                "no max_evaluations_per_goal, for it plans all goals together: leave it out, or limit max_tries or \
                 max_evaluations of the method",
            );
        }
        _ => {}
    }
    if spec.max_evaluations_per_goal == Some(0) {
        Range::from(1.0..).check("max_evaluations_per_goal", None, 0.0)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use crate::execution::{Iet, Problem};
    use crate::preset::shipped;
    use rstest::rstest;
    use serde_json::{Value, json};

    fn refusal(preset: &str, execution: &Value) -> String {
        let mut problem: Problem = shipped(preset).unwrap().problem;
        let mut spec = serde_json::to_value(&problem.execution).unwrap();
        spec.as_object_mut().unwrap().extend(execution.as_object().unwrap().clone());
        problem.execution = serde_json::from_value(spec).unwrap();
        Iet::new(&problem, 1).err().map(|error| error.to_string()).unwrap_or_default()
    }

    #[rstest]
    #[case("wax", json!({"name": "model", "noise": -1.0}), "noise is -1")]
    #[case("wax", json!({"name": "auto", "noise": 1e9}), "noise is 1")]
    #[case("wax", json!({"name": "model", "max_tries": 0}), "max_tries is 0")]
    #[case("wax", json!({"name": "model", "identification_deg": -45.0}), "identification_deg is -45")]
    #[case("wax", json!({"name": "model", "max_step_deg": 1e-9}), "give 0.1 to 10000 degrees")]
    #[case("wax", json!({"name": "broyden", "longest_step_deg": 0.0}), "longest_step_deg is 0")]
    #[case("paint", json!({"name": "model"}), "particle or search")]
    #[case("paint", json!({"name": "search", "max_evaluations": 0}), "max_evaluations is 0")]
    #[case("paint", json!({"name": "particle", "base_shift_m": 1e9}), "0 to 10 m")]
    #[case("paint", json!({"name": "particle", "particles": 1025}), "particles is 1025")]
    fn absurd_methods_are_refused(#[case] preset: &str, #[case] method: Value, #[case] says: &str) {
        let error = refusal(preset, &json!({ "method": method }));
        assert!(error.contains(says), "{error:?}");
    }

    #[rstest]
    #[case("wax", "broyden", true)]
    #[case("paint", "search", true)]
    #[case("wax", "model", false)]
    fn a_limit_a_method_cannot_keep_is_refused(#[case] preset: &str, #[case] name: &str, #[case] refused: bool) {
        let error = refusal(preset, &json!({"method": {"name": name}, "max_evaluations_per_goal": 5}));
        assert_eq!(error.contains("leave it out"), refused, "{error:?}");
    }

    #[test]
    fn goals_no_distance_can_be_computed_of_are_refused() {
        let mut problem = shipped("wax").unwrap().problem;
        let mut goals = serde_json::to_value(&problem.goals).unwrap();
        goals["goals"][3][1] = json!(1e300);
        problem.goals = serde_json::from_value(goals).unwrap();
        let error = Iet::new(&problem, 1).err().unwrap().to_string();
        assert!(error.contains("goals is 1e300: give -1000000000 to 1000000000"), "{error}");
    }
}
