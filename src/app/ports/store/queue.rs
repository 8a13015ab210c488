//! Jobs as workers hold them.

use super::{NewRun, StoreError};
use crate::app::model::{ActionGoals, ActionView, EventData, JobFailure, JobId, JobProgress, JobView, Timestamp, Work};
use crate::framework::experiment::RunRow;
use crate::framework::job::{Event, State};
use async_trait::async_trait;
use std::time::Duration;

/// The right to write for a job: void as soon as the job was taken back, which may happen when the lease ran out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Claim {
    /// Job it holds.
    pub job: JobId,
    /// Random text, another one for each claim.
    pub token: String,
}

/// A job for a worker.
#[derive(Debug, Clone)]
pub struct Claimed {
    /// The right to write.
    pub claim: Claim,
    /// Job, in state `Preparing`.
    pub job: JobView,
    /// Work to do.
    pub work: Work,
    /// Last checkpoint of the job.
    pub checkpoint: Option<Vec<u8>>,
}

/// A change of state.
#[derive(Debug, Clone, PartialEq)]
pub struct Transition {
    /// Event that causes the change.
    pub event: Event,
    /// Reason, if the event alone does not say it.
    pub reason: Option<String>,
    /// Failure to show to the user, with `Fail`.
    pub failure: Option<JobFailure>,
}

impl Transition {
    /// A change of state that needs no reason.
    #[must_use]
    pub fn plain(event: Event) -> Self {
        Self { event, reason: None, failure: None }
    }
}

/// A resource that a job made. A new kind of job adds a variant only if it makes something new.
#[derive(Debug, Clone)]
pub enum Product {
    /// An action; the store assigns its version.
    Action(Box<(ActionView, ActionGoals)>),
    /// A finished run.
    Run(Box<NewRun>),
    /// Finished runs of the job's experiment.
    Rows(Vec<RunRow>),
}

/// The writes of a worker in one transaction, in this order.
#[derive(Debug, Clone, Default)]
pub struct Advance {
    /// Resources to store. Each is progress: it resets the count of crashes.
    pub products: Vec<Product>,
    /// Progress to show.
    pub progress: Option<JobProgress>,
    /// State from which the job continues after a crash. A checkpoint is progress: it resets the count of crashes.
    pub checkpoint: Option<Vec<u8>>,
    /// Events that report it.
    pub events: Vec<EventData>,
    /// The change of state, and its event last.
    pub transition: Option<Transition>,
}

/// The queue: claim, heartbeat, advance, take back.
#[async_trait]
pub trait Queue: Send + Sync {
    /// A server starts: jobs held by an earlier one go back into the queue. Returns those jobs.
    async fn begin_epoch(&self, at: Timestamp) -> Result<Vec<JobId>, StoreError>;
    /// Gives the oldest queued job to a worker for `lease`; attempt and crash count are durable before it is given.
    /// A job that crashed `max_crashes` times in a row without progress fails instead.
    async fn claim(
        &self,
        token: String,
        lease: Duration,
        max_crashes: u32,
        at: Timestamp,
    ) -> Result<Option<Claimed>, StoreError>;
    /// Prolongs a lease. Returns the job's state.
    async fn heartbeat(&self, claim: &Claim, lease: Duration) -> Result<State, StoreError>;
    /// Writes what a worker has done. Returns the job's state.
    async fn advance(&self, claim: &Claim, step: Advance, at: Timestamp) -> Result<State, StoreError>;
    /// Takes back jobs whose lease ran out. Returns them.
    async fn reap(&self, at: Timestamp) -> Result<Vec<JobId>, StoreError>;
}
