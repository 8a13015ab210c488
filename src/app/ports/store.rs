//! The Store port: whole transactions of use-cases, in words every engine can keep.
//!
//! # Invariants of every engine
//! - An answer `Ok` to a write means durable.
//! - A write is done whole or not at all, also when the caller goes away before the answer.
//! - Every write of a worker carries its claim; when the claim does not hold the job any more the answer is
//!   [`StoreError::LeaseLost`] and nothing is written.
//! - Events of a job are numbered from 1 without gaps; each is written together with what it tells.

use crate::app::model::{
    ActionGoals, ActionId, ActionView, AppError, ConvergencePoint, DemonstrationId, DemonstrationReport,
    DemonstrationView, ErrorKind, EventData, EventPage, ExperimentId, ExperimentView, JobFailure, JobFilter, JobId,
    JobProgress, JobView, Keyset, PatchDemonstration, RobotId, RobotView, RowFilter, RunFilter, RunGoals, RunId,
    RunView, Timestamp, TrajectoryId, TrajectoryView, Work, WorldId, WorldView,
};
use crate::framework::experiment::{Plan, RunRow};
use crate::framework::job::{Event, InvalidTransition, State};
use crate::framework::method::whole_run::Trial;
use async_trait::async_trait;
use std::sync::Arc;
use std::time::Duration;

/// Why the store did not do what was asked.
#[derive(Debug, Clone, thiserror::Error)]
pub enum StoreError {
    /// No such row.
    #[error("there is no {kind} {id}")]
    NotFound {
        /// What was looked for.
        kind: &'static str,
        /// Its id.
        id: String,
    },
    /// The row has another revision.
    #[error("{id} has revision {present}, not {expected}")]
    Revision {
        /// The row.
        id: String,
        /// Revision in the store.
        present: u64,
        /// Revision the caller named.
        expected: u64,
    },
    /// The job's state does not accept the event.
    #[error(transparent)]
    Transition(#[from] InvalidTransition),
    /// Another claim, or none, holds the job.
    #[error("the lease of {job} is lost")]
    LeaseLost {
        /// The job.
        job: JobId,
    },
    /// The idempotency key was used with another body.
    #[error("idempotency key {key:?} was used with another body")]
    KeyReused {
        /// The key.
        key: String,
    },
    /// Something still names the row.
    #[error("{id} is named by {count} jobs")]
    InUse {
        /// The row.
        id: String,
        /// How many name it.
        count: u64,
    },
    /// What was stored cannot be read back.
    #[error("stored {what} cannot be read: {cause}")]
    Corrupt {
        /// Which value.
        what: String,
        /// What is wrong with it.
        cause: String,
    },
    /// No room left to write.
    #[error("no space is left to write: nothing was changed; free space on the disk of the data directory")]
    Full,
    /// The store is shut down or cannot be reached.
    #[error("the store does not answer")]
    Unavailable,
    /// The engine failed.
    #[error("the database failed")]
    Engine(#[source] Arc<dyn std::error::Error + Send + Sync>),
}

impl From<StoreError> for AppError {
    fn from(error: StoreError) -> Self {
        let text = error.to_string();
        match error {
            StoreError::NotFound { .. } => Self::new(ErrorKind::NotFound, "not_found", text),
            StoreError::Revision { .. } => Self::new(ErrorKind::Precondition, "revision_mismatch", text),
            StoreError::Transition(_) => Self::new(ErrorKind::Conflict, "invalid_state", text),
            StoreError::LeaseLost { .. } => Self::new(ErrorKind::Conflict, "lease_lost", text),
            StoreError::KeyReused { .. } => Self::new(ErrorKind::Invalid, "idempotency_key_reused", text),
            StoreError::InUse { .. } => Self::new(ErrorKind::Conflict, "in_use", text),
            StoreError::Full => {
                Self { retry_after_s: Some(10), ..Self::new(ErrorKind::StorageFull, "storage_full", text) }
            }
            StoreError::Unavailable => Self::unavailable("store_unavailable", text),
            StoreError::Corrupt { .. } | StoreError::Engine(_) => Self::internal(error),
        }
    }
}

/// A demonstration to keep.
#[derive(Debug, Clone)]
pub struct NewDemonstration {
    /// What is shown of it.
    pub view: DemonstrationView,
    /// What the reader found.
    pub report: DemonstrationReport,
    /// Its samples, encoded.
    pub samples: Vec<u8>,
}

/// A robot to keep; the store counts its version.
#[derive(Debug, Clone)]
pub struct NewRobot {
    /// What is shown of it; `version` is ignored.
    pub view: RobotView,
    /// The URDF.
    pub urdf: String,
}

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
    /// What is shown of it, in state `Queued`.
    pub view: JobView,
    /// All it needs.
    pub work: Work,
    /// What it names: it cannot be deleted as long as the job is kept.
    pub uses: Usage,
    /// The experiment it runs, kept together with it.
    pub experiment: Option<NewExperiment>,
}

/// An experiment to keep.
#[derive(Debug, Clone)]
pub struct NewExperiment {
    /// What is shown of it; `state` and `finished_runs` are read from its job and its rows.
    pub view: ExperimentView,
    /// All it takes to run it.
    pub plan: Plan,
}

/// Resources a job names.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Usage {
    /// Action.
    pub action: Option<ActionId>,
    /// Robot.
    pub robot: Option<RobotId>,
    /// World.
    pub world: Option<WorldId>,
}

/// The answer to a submission.
#[derive(Debug, Clone, PartialEq)]
pub enum Submitted {
    /// The job is new.
    Created(JobView),
    /// The key was used with this body before; this is the job it made.
    Existing(JobView),
}

/// The right to write for a job: void as soon as the job was taken back, which may happen when the lease ran out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Claim {
    /// The job.
    pub job: JobId,
    /// Random, one for each claim.
    pub token: String,
}

/// A job for a worker.
#[derive(Debug, Clone)]
pub struct Claimed {
    /// The right to write.
    pub claim: Claim,
    /// The job, in state `Preparing`.
    pub job: JobView,
    /// All it needs.
    pub work: Work,
    /// Its last checkpoint.
    pub checkpoint: Option<Vec<u8>>,
}

/// A change of state.
#[derive(Debug, Clone, PartialEq)]
pub struct Transition {
    /// What happens.
    pub event: Event,
    /// Why.
    pub reason: Option<String>,
    /// With `Fail`: what is shown to the user.
    pub failure: Option<JobFailure>,
}

impl Transition {
    /// A change of state that needs no reason.
    #[must_use]
    pub fn plain(event: Event) -> Self {
        Self { event, reason: None, failure: None }
    }
}

/// A finished repetition to keep.
#[derive(Debug, Clone)]
pub struct NewRun {
    /// What is shown of it.
    pub view: RunView,
    /// Its goals.
    pub goals: RunGoals,
    /// Its convergence.
    pub convergence: Vec<ConvergencePoint>,
    /// Its trajectory.
    pub trajectory: Option<TrajectoryView>,
    /// Its trials, where the method remembers them.
    pub trials: KeptTrials,
}

/// The trials of a run.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct KeptTrials {
    /// What decides what a pose shows, as a digest; none where that changes with time.
    pub setting: Option<String>,
    /// In the order they were made.
    pub trials: Vec<Trial>,
}

/// What a worker writes in one transaction, in this order.
#[derive(Debug, Clone, Default)]
pub struct Advance {
    /// Runs that ended.
    pub runs: Vec<NewRun>,
    /// Runs of the job's experiment that ended. Rows are progress: they set the count of crashes back to 0.
    pub rows: Vec<RunRow>,
    /// The action that was made; the store counts its version.
    pub action: Option<(ActionView, ActionGoals)>,
    /// Progress to show.
    pub progress: Option<JobProgress>,
    /// Where to go on after a crash. A checkpoint is progress: it sets the count of crashes back to 0.
    pub checkpoint: Option<Vec<u8>>,
    /// Events that tell it.
    pub events: Vec<EventData>,
    /// The change of state, and its event last.
    pub transition: Option<Transition>,
}

/// Durable storage.
#[async_trait]
pub trait Store: Send + Sync {
    /// Whether the store answers.
    async fn ping(&self) -> Result<(), StoreError>;

    /// Keeps a demonstration.
    async fn insert_demonstration(&self, new: NewDemonstration) -> Result<(), StoreError>;
    /// One demonstration.
    async fn demonstration(&self, id: &DemonstrationId) -> Result<DemonstrationView, StoreError>;
    /// What the reader found.
    async fn demonstration_report(&self, id: &DemonstrationId) -> Result<DemonstrationReport, StoreError>;
    /// Encoded samples, checked against the digest stored with them.
    async fn demonstration_samples(&self, id: &DemonstrationId) -> Result<Vec<u8>, StoreError>;
    /// One item more than `keyset.limit`, newest first; likewise every list.
    async fn demonstrations(&self, keyset: &Keyset) -> Result<Vec<DemonstrationView>, StoreError>;
    /// Those whose samples have this digest.
    async fn demonstrations_with_content(&self, sha256: &str) -> Result<Vec<DemonstrationId>, StoreError>;
    /// Changes a demonstration and counts its revision up.
    async fn patch_demonstration(
        &self,
        id: &DemonstrationId,
        patch: PatchDemonstration,
        if_match: Option<u64>,
    ) -> Result<DemonstrationView, StoreError>;
    /// Deletes a demonstration and its samples.
    async fn delete_demonstration(&self, id: &DemonstrationId, if_match: Option<u64>) -> Result<(), StoreError>;

    /// One action.
    async fn action(&self, id: &ActionId) -> Result<ActionView, StoreError>;
    /// Its goals.
    async fn action_goals(&self, id: &ActionId) -> Result<ActionGoals, StoreError>;
    /// Actions.
    async fn actions(&self, keyset: &Keyset) -> Result<Vec<ActionView>, StoreError>;

    /// Keeps a robot as the next version of its name.
    async fn insert_robot(&self, new: NewRobot) -> Result<RobotView, StoreError>;
    /// One robot.
    async fn robot(&self, id: &RobotId) -> Result<RobotView, StoreError>;
    /// Its URDF.
    async fn robot_urdf(&self, id: &RobotId) -> Result<String, StoreError>;
    /// Robots.
    async fn robots(&self, keyset: &Keyset) -> Result<Vec<RobotView>, StoreError>;
    /// Deletes a robot that no job names.
    async fn delete_robot(&self, id: &RobotId) -> Result<(), StoreError>;

    /// Keeps a world.
    async fn insert_world(&self, new: WorldView) -> Result<(), StoreError>;
    /// One world.
    async fn world(&self, id: &WorldId) -> Result<WorldView, StoreError>;
    /// Worlds.
    async fn worlds(&self, keyset: &Keyset) -> Result<Vec<WorldView>, StoreError>;
    /// Deletes a world that no job names.
    async fn delete_world(&self, id: &WorldId) -> Result<(), StoreError>;

    /// Submits a job; with a key, once.
    async fn submit(&self, new: NewJob, key: Option<IdempotencyKey>) -> Result<Submitted, StoreError>;
    /// The job that `key` made, if it made one.
    async fn submitted(&self, key: &IdempotencyKey) -> Result<Option<JobView>, StoreError>;
    /// One job.
    async fn job(&self, id: &JobId) -> Result<JobView, StoreError>;
    /// All a job needs.
    async fn work(&self, id: &JobId) -> Result<Work, StoreError>;
    /// Jobs.
    async fn jobs(&self, filter: &JobFilter, keyset: &Keyset) -> Result<Vec<JobView>, StoreError>;
    /// At most `limit` events after `after_seq`.
    async fn events(&self, id: &JobId, after_seq: u64, limit: u32) -> Result<EventPage, StoreError>;
    /// What a user asks of a job.
    async fn ask(&self, id: &JobId, transition: Transition, at: Timestamp) -> Result<JobView, StoreError>;

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
    /// What a worker has done. Returns the job's state.
    async fn advance(&self, claim: &Claim, step: Advance, at: Timestamp) -> Result<State, StoreError>;
    /// Takes back jobs whose lease ran out. Returns them.
    async fn reap(&self, at: Timestamp) -> Result<Vec<JobId>, StoreError>;

    /// One run.
    async fn run(&self, id: &RunId) -> Result<RunView, StoreError>;
    /// Its goals.
    async fn run_goals(&self, id: &RunId) -> Result<RunGoals, StoreError>;
    /// Its convergence.
    async fn run_convergence(&self, id: &RunId) -> Result<Vec<ConvergencePoint>, StoreError>;
    /// Its trials; none of a run without any, or of no run.
    async fn run_trials(&self, id: &RunId) -> Result<KeptTrials, StoreError>;
    /// Runs with trials of this setting, newest first, at most `limit`.
    async fn runs_on(&self, setting: &str, limit: u32) -> Result<Vec<(RunView, Vec<Trial>)>, StoreError>;
    /// Runs.
    async fn runs(&self, filter: &RunFilter, keyset: &Keyset) -> Result<Vec<RunView>, StoreError>;
    /// One experiment.
    async fn experiment(&self, id: &ExperimentId) -> Result<ExperimentView, StoreError>;
    /// Experiments.
    async fn experiments(&self, keyset: &Keyset) -> Result<Vec<ExperimentView>, StoreError>;
    /// All it takes to run it.
    async fn experiment_plan(&self, id: &ExperimentId) -> Result<Plan, StoreError>;
    /// Its finished runs by cell, then repetition; none for an experiment that is not there.
    async fn experiment_rows(&self, id: &ExperimentId, filter: &RowFilter) -> Result<Vec<RunRow>, StoreError>;
    /// One trajectory.
    async fn trajectory(&self, id: &TrajectoryId) -> Result<TrajectoryView, StoreError>;
}
