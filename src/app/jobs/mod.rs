//! Jobs: submitted once, run durably, watched by events with a durable sequence.

mod types;
mod work;

pub use types::{
    CostEstimate, CreateJob, EventData, EventPage, ExecutionRequest, GeneralizationRequest, GoalProgress, JobEvent,
    JobFailure, JobFilter, JobKind, JobProgress, JobResult, JobView, Validation,
};

pub use work::{ExecutionWork, Work};

use crate::app::id::JobId;
use crate::app::{App, AppError, Page, PageQuery};
use futures_util::stream::BoxStream;
use std::time::Duration;

impl App {
    /// Checks a job as [`App::create_job`] would, creates nothing and estimates its cost.
    ///
    /// # Errors
    /// Only when the service is at fault: what is wrong with the request is in the answer.
    pub async fn validate_job(&self, request: CreateJob) -> Result<Validation, AppError> {
        let _ = request;
        Err(self.unfinished())
    }

    /// Resolves and submits a job.
    ///
    /// # Errors
    /// `Invalid` request, or a key that was used with another body; `NotFound` never: a wrong reference is `Invalid`.
    pub async fn create_job(&self, request: CreateJob, idempotency_key: Option<String>) -> Result<JobView, AppError> {
        let _ = (request, idempotency_key);
        Err(self.unfinished())
    }

    /// Newest first.
    ///
    /// # Errors
    /// `Malformed` page.
    pub async fn list_jobs(&self, filter: JobFilter, page: PageQuery) -> Result<Page<JobView>, AppError> {
        let _ = (filter, page);
        Err(self.unfinished())
    }

    /// One job.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn get_job(&self, id: &JobId) -> Result<JobView, AppError> {
        let _ = id;
        Err(self.unfinished())
    }

    /// Asks it to rest at its next checkpoint.
    ///
    /// # Errors
    /// `NotFound`; `Conflict` when its state does not allow it.
    pub async fn pause_job(&self, id: &JobId) -> Result<JobView, AppError> {
        let _ = id;
        Err(self.unfinished())
    }

    /// Lets a paused job go on.
    ///
    /// # Errors
    /// `NotFound`; `Conflict` when its state does not allow it.
    pub async fn resume_job(&self, id: &JobId) -> Result<JobView, AppError> {
        let _ = id;
        Err(self.unfinished())
    }

    /// Asks it to end without a result; finished runs are kept.
    ///
    /// # Errors
    /// `NotFound`; `Conflict` when it ended already.
    pub async fn cancel_job(&self, id: &JobId) -> Result<JobView, AppError> {
        let _ = id;
        Err(self.unfinished())
    }

    /// Lets a halted job wait for a worker again.
    ///
    /// # Errors
    /// `NotFound`; `Conflict` when it is not halted.
    pub async fn acknowledge_job(&self, id: &JobId) -> Result<JobView, AppError> {
        let _ = id;
        Err(self.unfinished())
    }

    /// Submits the same resolved job again, with the same seed.
    ///
    /// # Errors
    /// `NotFound`; as [`App::create_job`].
    pub async fn clone_job(&self, id: &JobId, idempotency_key: Option<String>) -> Result<JobView, AppError> {
        let _ = (id, idempotency_key);
        Err(self.unfinished())
    }

    /// Events after `after_seq` (0 is from the first), at most `limit`.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn job_events(&self, id: &JobId, after_seq: u64, limit: u32) -> Result<EventPage, AppError> {
        let _ = (id, after_seq, limit);
        Err(self.unfinished())
    }

    /// Every event after `after_seq`, first those stored, then as they come; ends after the event of a final state.
    ///
    /// # Errors
    /// `NotFound`. The stream itself ends with an error when the store fails.
    pub async fn watch_job(
        &self,
        id: &JobId,
        after_seq: u64,
    ) -> Result<BoxStream<'static, Result<JobEvent, AppError>>, AppError> {
        let _ = (id, after_seq);
        Err(self.unfinished())
    }

    /// The job as soon as it has an event after `after_seq` or is final, at the latest after `timeout` (at most 60 s).
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn wait_job(&self, id: &JobId, after_seq: u64, timeout: Duration) -> Result<JobView, AppError> {
        let _ = (id, after_seq, timeout);
        Err(self.unfinished())
    }
}
