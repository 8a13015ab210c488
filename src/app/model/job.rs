//! Jobs, as shown.

use super::id::{ActionId, ExperimentId, JobId, RunId};
use super::job_kind::{CreateJob, JobKind};
use super::job_progress::JobProgress;
use super::time::Timestamp;
use crate::framework::job::State;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// A job with its present state.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct JobView {
    /// Id of the job.
    pub id: JobId,
    /// Kind of work.
    pub kind: JobKind,
    /// Display name.
    pub name: String,
    /// Present state.
    pub state: State,
    /// Reason for the state; absent if the state says it all.
    #[schema(required = true)]
    pub state_reason: Option<String>,
    /// Time of the last change of state.
    pub state_since: Timestamp,
    /// Number of times a worker claimed it.
    pub attempt: u32,
    /// Progress so far.
    pub progress: JobProgress,
    /// The request with its defaults filled in.
    pub request: CreateJob,
    /// Results so far.
    pub result: JobResult,
    /// Reason of the failure; absent unless the job failed.
    #[schema(required = true)]
    pub failure: Option<JobFailure>,
    /// Sequence number of its last event.
    pub last_seq: u64,
    /// Time of submission.
    pub created_at: Timestamp,
    /// Time at which a worker first started it; absent before.
    #[schema(required = true)]
    pub started_at: Option<Timestamp>,
    /// Time at which it ended; absent before.
    #[schema(required = true)]
    pub finished_at: Option<Timestamp>,
}

/// Results of a job.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct JobResult {
    /// The action, if the job generalizes.
    #[schema(required = true)]
    pub action: Option<ActionId>,
    /// The runs of an execution, in the order of repetitions.
    pub runs: Vec<RunId>,
    /// The experiment, named from its submission on; absent for other kinds.
    #[schema(required = true)]
    pub experiment: Option<ExperimentId>,
}

/// Reason of a failure.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct JobFailure {
    /// Stable code.
    pub code: String,
    /// Description of the failure, with the numbers.
    pub message: String,
}

/// Filter of a list of jobs.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct JobFilter {
    /// States of the jobs; all if empty.
    pub states: Vec<State>,
    /// Kind of the jobs; all if `None`.
    pub kind: Option<JobKind>,
}
