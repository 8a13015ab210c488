//! Jobs and how far they are.

use super::all;
use crate::app::model::{
    AppError, CostEstimate, ErrorKind, GoalProgress, JobFailure, JobKind, JobProgress, JobResult, JobView,
    TrialProgress, Validation,
};
use crate::framework::job::State;
use crate::grpc::proto;
use proto::JobState;

impl From<State> for JobState {
    fn from(state: State) -> Self {
        match state {
            State::Queued => Self::Queued,
            State::Preparing => Self::Preparing,
            State::Running => Self::Running,
            State::Pausing => Self::Pausing,
            State::Paused => Self::Paused,
            State::Interrupted => Self::Interrupted,
            State::Cancelling => Self::Cancelling,
            State::Cancelled => Self::Cancelled,
            State::Succeeded => Self::Succeeded,
            State::Failed => Self::Failed,
        }
    }
}

/// States to look for.
pub fn states(values: &[i32]) -> Result<Vec<State>, AppError> {
    let state = |value: &i32| {
        let found = State::ALL.into_iter().find(|state| JobState::from(*state) as i32 == *value);
        found.ok_or_else(|| wrong(&format!("{value} is no state of a job")))
    };
    values.iter().map(state).collect()
}

/// A kind to look for.
pub fn kind(text: &str) -> Result<Option<JobKind>, AppError> {
    if text.is_empty() {
        return Ok(None);
    }
    let kind = serde_json::from_value(serde_json::Value::from(text));
    kind.map(Some).map_err(|_| wrong(&format!("{text:?} is no kind of job")))
}

fn wrong(message: &str) -> AppError {
    AppError::new(ErrorKind::Malformed, "invalid_query", message)
}

impl From<JobView> for proto::Job {
    fn from(view: JobView) -> Self {
        Self {
            id: view.id.into(),
            kind: view.kind.as_str().to_owned(),
            name: view.name,
            state: JobState::from(view.state) as i32,
            state_reason: view.state_reason,
            state_since_ms: view.state_since.0,
            attempt: view.attempt,
            progress: Some(view.progress.into()),
            work: Some(view.request.into()),
            result: Some(view.result.into()),
            failure: view.failure.map(Into::into),
            last_seq: view.last_seq,
            created_at_ms: view.created_at.0,
            started_at_ms: view.started_at.map(|time| time.0),
            finished_at_ms: view.finished_at.map(|time| time.0),
        }
    }
}

impl From<JobProgress> for proto::JobProgress {
    fn from(progress: JobProgress) -> Self {
        Self {
            fraction: progress.fraction,
            repetition: progress.repetition,
            repetitions: progress.repetitions,
            goal_index: progress.goal_index,
            goals: progress.goals,
            evaluations: progress.evaluations,
            goal_evaluations: progress.goal_evaluations,
            total_evaluations: progress.total_evaluations,
            discrepancy: progress.discrepancy,
            finished_goals: all(progress.finished_goals),
            trials: all(progress.trials),
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
        Self {
            repetition: goal.repetition,
            index: goal.index,
            evaluations: goal.evaluations,
            discrepancy: goal.discrepancy,
            stop_reason: super::run::stop_reason(goal.stop_reason),
            joints: goal.joints,
            observation: goal.observation,
            residual: goal.residual,
        }
    }
}

impl From<JobResult> for proto::JobResult {
    fn from(result: JobResult) -> Self {
        Self {
            action: result.action.map(Into::into),
            runs: result.runs.into_iter().map(String::from).collect(),
            experiment: result.experiment.map(Into::into),
        }
    }
}

impl From<JobFailure> for proto::JobFailure {
    fn from(failure: JobFailure) -> Self {
        Self { code: failure.code, message: failure.message }
    }
}

impl From<Validation> for proto::JobValidation {
    fn from(validation: Validation) -> Self {
        Self {
            valid: validation.valid,
            errors: all(validation.errors),
            estimate: validation.estimate.map(Into::into),
            chosen: validation.chosen.map(Into::into),
        }
    }
}

impl From<CostEstimate> for proto::CostEstimate {
    fn from(estimate: CostEstimate) -> Self {
        Self {
            evaluations: estimate.evaluations,
            simulated_s: estimate.simulated_s,
            robot_s: estimate.robot_s,
            basis: estimate.basis,
            text: estimate.text,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_state_has_its_own_number_and_the_same_name() {
        let numbers: Vec<i32> = State::ALL.iter().map(|state| JobState::from(*state) as i32).collect();
        assert_eq!(states(&numbers).unwrap(), State::ALL);
        for state in State::ALL {
            let json = serde_json::to_value(state).unwrap();
            let name = JobState::from(state).as_str_name();
            assert_eq!(name.strip_prefix("JOB_STATE_"), json.as_str());
        }
        assert!(states(&[0]).is_err() && states(&[99]).is_err());
        assert!(kind("dance").is_err() && kind("").unwrap().is_none());
    }
}
