//! Conversion of jobs and their progress.

use super::enumeration::Enumeration as _;
use super::{all, time};
use crate::app::model::{
    AppError, CostEstimate, ErrorKind, GoalProgress, JobFailure, JobFilter, JobKind, JobProgress, JobResult, JobView,
    TrialProgress, Validation,
};
use crate::framework::job::State;
use crate::grpc::proto;

/// States and kind to look for.
///
/// # Errors
/// `Malformed` for a number without a state or a kind.
pub fn filter(states: &[i32], kind: i32) -> Result<JobFilter, AppError> {
    let state = |value: &i32| {
        let found = State::read("/states", *value).map_err(|error| wrong(&error.message))?;
        found.ok_or_else(|| wrong("states names an unspecified state: leave it out"))
    };
    Ok(JobFilter {
        states: states.iter().map(state).collect::<Result<_, _>>()?,
        kind: JobKind::read("/kind", kind).map_err(|error| wrong(&error.message))?,
    })
}

fn wrong(message: &str) -> AppError {
    AppError::new(ErrorKind::Malformed, "invalid_query", message)
}

impl From<JobView> for proto::Job {
    fn from(view: JobView) -> Self {
        let JobView {
            id,
            kind,
            name,
            state,
            state_reason,
            state_since,
            attempt,
            progress,
            request,
            result,
            failure,
            last_seq,
            created_at,
            started_at,
            finished_at,
        } = view;
        Self {
            id: id.into(),
            kind: kind.number(),
            name,
            state: state.number(),
            state_reason,
            state_since: Some(time(state_since)),
            attempt,
            progress: Some(progress.into()),
            request: Some(request.into()),
            result: Some(result.into()),
            failure: failure.map(Into::into),
            last_seq,
            created_at: Some(time(created_at)),
            started_at: started_at.map(time),
            finished_at: finished_at.map(time),
        }
    }
}

impl From<JobProgress> for proto::JobProgress {
    fn from(progress: JobProgress) -> Self {
        let JobProgress {
            fraction,
            repetition,
            repetitions,
            goal_index,
            goals,
            evaluations,
            goal_evaluations,
            total_evaluations,
            discrepancy,
            finished_goals,
            trials,
        } = progress;
        Self {
            fraction,
            repetition,
            repetitions,
            goal_index,
            goals,
            evaluations,
            goal_evaluations,
            total_evaluations,
            discrepancy,
            finished_goals: all(finished_goals),
            trials: all(trials),
        }
    }
}

impl From<TrialProgress> for proto::TrialProgress {
    fn from(trial: TrialProgress) -> Self {
        let TrialProgress { repetition, index, goal, residual } = trial;
        Self { repetition, index, goal, residual }
    }
}

impl From<GoalProgress> for proto::GoalProgress {
    fn from(goal: GoalProgress) -> Self {
        let GoalProgress {
            repetition,
            index,
            evaluations,
            discrepancy,
            stop_reason,
            judgement,
            joints,
            observation,
            residual,
        } = goal;
        Self {
            repetition,
            index,
            evaluations,
            discrepancy,
            stop_reason: stop_reason.number(),
            judgement: judgement.map(Into::into),
            joints,
            observation,
            residual,
        }
    }
}

impl From<JobResult> for proto::JobResult {
    fn from(result: JobResult) -> Self {
        let JobResult { action, runs, experiment } = result;
        Self {
            action: action.map(Into::into),
            runs: runs.into_iter().map(String::from).collect(),
            experiment: experiment.map(Into::into),
        }
    }
}

impl From<JobFailure> for proto::JobFailure {
    fn from(failure: JobFailure) -> Self {
        let JobFailure { code, message } = failure;
        Self { code, message }
    }
}

impl From<Validation> for proto::JobValidation {
    fn from(validation: Validation) -> Self {
        let Validation { valid, errors, estimate, chosen } = validation;
        Self { valid, errors: all(errors), estimate: estimate.map(Into::into), chosen: chosen.map(Into::into) }
    }
}

impl From<CostEstimate> for proto::CostEstimate {
    fn from(estimate: CostEstimate) -> Self {
        let CostEstimate { evaluations, simulated_s, robot_s, text, basis } = estimate;
        Self { evaluations, simulated_s, robot_s, text, basis }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::model::FieldError;

    #[test]
    fn a_filter_names_states_and_a_kind_or_any() {
        let numbers: Vec<i32> = State::ALL.iter().map(|state| state.number()).collect();
        let found = filter(&numbers, JobKind::Execution.number()).unwrap();
        assert_eq!(found, JobFilter { states: State::ALL.to_vec(), kind: Some(JobKind::Execution) });
        assert_eq!(filter(&[], 0).unwrap(), JobFilter::default());
        for (states, kind) in [(&[0][..], 0), (&[99], 0), (&[], 99)] {
            assert_eq!(filter(states, kind).unwrap_err().kind, ErrorKind::Malformed);
        }
    }

    #[test]
    fn a_dry_run_keeps_its_errors_and_its_cost() {
        let validation = Validation {
            valid: false,
            errors: vec![FieldError::new("/seed", "out_of_range", "too large")],
            estimate: Some(CostEstimate {
                evaluations: 1,
                simulated_s: 2.0,
                robot_s: 3.0,
                text: "text".to_owned(),
                basis: "basis".to_owned(),
            }),
            chosen: None,
        };
        let message = proto::JobValidation::from(validation);
        assert_eq!(message.errors[0].pointer, "/seed");
        let estimate = message.estimate.unwrap();
        assert_eq!((estimate.robot_s, estimate.text.as_str(), estimate.basis.as_str()), (3.0, "text", "basis"));
    }
}
