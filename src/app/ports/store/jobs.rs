//! Jobs as users see and steer them.

use super::{NewExperiment, StoreError, Transition};
use crate::app::model::{ActionId, EventPage, JobFilter, JobId, JobView, Keyset, RobotId, Timestamp, Work, WorldId};
use async_trait::async_trait;

/// A key that makes a submission happen once.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct IdempotencyKey {
    /// The client's key.
    pub key: String,
    /// SHA-256 of the request, hexadecimal.
    pub body_sha256: String,
}

/// A job to submit.
#[derive(Debug, Clone)]
pub struct NewJob {
    /// The job, as shown, in state `Queued`.
    pub view: JobView,
    /// Work for a worker.
    pub work: Work,
    /// Resources it names, which cannot be deleted as long as the job is kept.
    pub uses: Usage,
    /// Experiment it runs, stored together with it.
    pub experiment: Option<NewExperiment>,
}

/// Resources a job names.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Usage {
    /// Action to execute.
    pub action: Option<ActionId>,
    /// Robot that executes it.
    pub robot: Option<RobotId>,
    /// World it is executed in.
    pub world: Option<WorldId>,
}

/// The answer to a submission.
#[derive(Debug, Clone, PartialEq)]
pub enum Submitted {
    /// The job is new.
    Created(JobView),
    /// The key was used with this body before, for this job.
    Existing(JobView),
}

/// Jobs: submitted once, read, steered.
#[async_trait]
pub trait Jobs: Send + Sync {
    /// Submits a job; with a key, once.
    async fn submit(&self, new: NewJob, key: Option<IdempotencyKey>) -> Result<Submitted, StoreError>;
    /// The job submitted with `key`; `None` if there is none.
    async fn submitted(&self, key: &IdempotencyKey) -> Result<Option<JobView>, StoreError>;
    /// One job.
    async fn job(&self, id: &JobId) -> Result<JobView, StoreError>;
    /// The work of a job.
    async fn work(&self, id: &JobId) -> Result<Work, StoreError>;
    /// Lists jobs.
    async fn jobs(&self, filter: &JobFilter, keyset: &Keyset) -> Result<Vec<JobView>, StoreError>;
    /// At most `limit` events after `after_seq`.
    async fn events(&self, id: &JobId, after_seq: u64, limit: u32) -> Result<EventPage, StoreError>;
    /// Moves a job on a user's request.
    async fn apply_event(&self, id: &JobId, transition: Transition, at: Timestamp) -> Result<JobView, StoreError>;
}
