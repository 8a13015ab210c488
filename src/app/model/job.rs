//! Jobs, as they are shown.

use super::id::{ActionId, ExperimentId, JobId, RunId};
use super::job_kind::{CreateJob, JobKind};
use super::job_progress::JobProgress;
use super::time::Timestamp;
use crate::framework::job::State;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// A job as it stands.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct JobView {
    /// Its id.
    pub id: JobId,
    /// What it does.
    pub kind: JobKind,
    /// Display name.
    pub name: String,
    /// Where it stands.
    pub state: State,
    /// Why, where there is more to say than the state.
    #[schema(required = true)]
    pub state_reason: Option<String>,
    /// Since when.
    pub state_since: Timestamp,
    /// How often a worker claimed it.
    pub attempt: u32,
    /// How far it is.
    pub progress: JobProgress,
    /// The request, with what was left open filled in.
    pub request: CreateJob,
    /// What it made so far.
    pub result: JobResult,
    /// Why it failed.
    #[schema(required = true)]
    pub failure: Option<JobFailure>,
    /// Sequence number of its last event.
    pub last_seq: u64,
    /// When it was submitted.
    pub created_at: Timestamp,
    /// When a worker first started it.
    #[schema(required = true)]
    pub started_at: Option<Timestamp>,
    /// When it ended.
    #[schema(required = true)]
    pub finished_at: Option<Timestamp>,
}

/// What a job made.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct JobResult {
    /// The action, of a generalization.
    #[schema(required = true)]
    pub action: Option<ActionId>,
    /// The runs, of an execution, in the order of repetitions.
    pub runs: Vec<RunId>,
    /// The experiment, from its submission on.
    #[schema(required = true)]
    pub experiment: Option<ExperimentId>,
}

/// Why a job failed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct JobFailure {
    /// Stable code.
    pub code: String,
    /// What happened, with the numbers.
    pub message: String,
}

/// Which jobs.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct JobFilter {
    /// In one of these states; any when empty.
    pub states: Vec<State>,
    /// Of this kind.
    pub kind: Option<JobKind>,
}
