//! SQLite: one writer with group commit, readers in a pool, in WAL mode with a full sync at each commit.

mod claims;
mod demonstrations;
mod experiments;
mod jobs;
mod open;
mod results;
mod robots;
mod rows;
mod statements;
#[cfg(test)]
mod tests;
mod trials;
mod writer;

pub use open::OpenError;

use crate::app::model::{
    ActionGoals, ActionId, ActionView, ConvergencePoint, DemonstrationId, DemonstrationReport, DemonstrationView,
    EventPage, ExperimentId, ExperimentView, JobFilter, JobId, JobView, Keyset, PatchDemonstration, RobotId, RobotView,
    RowFilter, RunFilter, RunGoals, RunId, RunView, Timestamp, TrajectoryId, TrajectoryView, Work, WorldId, WorldView,
};
use crate::app::ports::{
    Advance, Claim, Claimed, IdempotencyKey, KeptTrials, NewDemonstration, NewJob, NewRobot, Store, StoreError,
    Submitted, Transition,
};
use crate::framework::experiment::{Plan, RunRow};
use crate::framework::job::State;
use crate::framework::method::whole_run::Trial;
use async_trait::async_trait;
use sqlx::sqlite::{SqlitePool, SqlitePoolOptions};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicI64, Ordering};
use std::time::{Duration, Instant};
use writer::Writer;

/// Reading connections.
const READERS: u32 = 4;
/// SQLite's primary result code for a full disk.
const SQLITE_FULL: &str = "13";

/// The store in one SQLite file.
pub struct SqliteStore {
    writer: Writer,
    readers: SqlitePool,
    started: Instant,
    epoch: AtomicI64,
}

impl SqliteStore {
    /// Opens or creates the database in `path`.
    ///
    /// # Errors
    /// [`OpenError`] names the gate that did not open.
    pub async fn open(path: &Path) -> Result<Self, OpenError> {
        let connection = open::open(path).await?;
        let writer = Writer::start(connection, open::writing(path));
        let readers = SqlitePoolOptions::new()
            .max_connections(READERS)
            .acquire_timeout(Duration::from_secs(5))
            .connect_with(open::reading(path))
            .await
            .map_err(engine_error)?;
        Ok(Self { writer, readers, started: Instant::now(), epoch: AtomicI64::new(0) })
    }

    fn epoch(&self) -> i64 {
        self.epoch.load(Ordering::Acquire)
    }

    fn monotonic_ms(&self) -> i64 {
        i64::try_from(self.started.elapsed().as_millis()).unwrap_or(i64::MAX)
    }

    fn lease_end(&self, lease: Duration) -> i64 {
        self.monotonic_ms().saturating_add(i64::try_from(lease.as_millis()).unwrap_or(i64::MAX))
    }
}

fn engine_error(error: sqlx::Error) -> StoreError {
    match &error {
        sqlx::Error::PoolTimedOut | sqlx::Error::PoolClosed => StoreError::Unavailable,
        sqlx::Error::Database(database) if database.code().as_deref() == Some(SQLITE_FULL) => StoreError::Full,
        _ => StoreError::Engine(Arc::new(error)),
    }
}

#[async_trait]
impl Store for SqliteStore {
    async fn ping(&self) -> Result<(), StoreError> {
        sqlx::query("SELECT 1").execute(&self.readers).await.map_err(engine_error)?;
        Ok(())
    }

    async fn insert_demonstration(&self, new: NewDemonstration) -> Result<(), StoreError> {
        demonstrations::insert(self, new).await
    }
    async fn demonstration(&self, id: &DemonstrationId) -> Result<DemonstrationView, StoreError> {
        demonstrations::get(self, id.as_str()).await
    }
    async fn demonstration_report(&self, id: &DemonstrationId) -> Result<DemonstrationReport, StoreError> {
        demonstrations::report(self, id.as_str()).await
    }
    async fn demonstration_samples(&self, id: &DemonstrationId) -> Result<Vec<u8>, StoreError> {
        demonstrations::samples(self, id.as_str()).await
    }
    async fn demonstrations(&self, keyset: &Keyset) -> Result<Vec<DemonstrationView>, StoreError> {
        demonstrations::list(self, keyset).await
    }
    async fn demonstrations_with_content(&self, sha256: &str) -> Result<Vec<DemonstrationId>, StoreError> {
        demonstrations::with_content(self, sha256).await
    }
    async fn patch_demonstration(
        &self,
        id: &DemonstrationId,
        patch: PatchDemonstration,
        if_match: Option<u64>,
    ) -> Result<DemonstrationView, StoreError> {
        demonstrations::patch(self, id.to_string(), patch, if_match).await
    }
    async fn delete_demonstration(&self, id: &DemonstrationId, if_match: Option<u64>) -> Result<(), StoreError> {
        demonstrations::delete(self, id.to_string(), if_match).await
    }

    async fn action(&self, id: &ActionId) -> Result<ActionView, StoreError> {
        results::action(self, id.as_str()).await
    }
    async fn action_goals(&self, id: &ActionId) -> Result<ActionGoals, StoreError> {
        results::action_goals(self, id.as_str()).await
    }
    async fn actions(&self, keyset: &Keyset) -> Result<Vec<ActionView>, StoreError> {
        results::actions(self, keyset).await
    }

    async fn insert_robot(&self, new: NewRobot) -> Result<RobotView, StoreError> {
        robots::insert(self, new).await
    }
    async fn robot(&self, id: &RobotId) -> Result<RobotView, StoreError> {
        robots::get(self, id.as_str()).await
    }
    async fn robot_urdf(&self, id: &RobotId) -> Result<String, StoreError> {
        robots::urdf(self, id.as_str()).await
    }
    async fn robots(&self, keyset: &Keyset) -> Result<Vec<RobotView>, StoreError> {
        robots::list(self, keyset).await
    }
    async fn delete_robot(&self, id: &RobotId) -> Result<(), StoreError> {
        robots::delete(self, id.to_string()).await
    }

    async fn insert_world(&self, new: WorldView) -> Result<(), StoreError> {
        robots::insert_world(self, new).await
    }
    async fn world(&self, id: &WorldId) -> Result<WorldView, StoreError> {
        robots::world(self, id.as_str()).await
    }
    async fn worlds(&self, keyset: &Keyset) -> Result<Vec<WorldView>, StoreError> {
        robots::worlds(self, keyset).await
    }
    async fn delete_world(&self, id: &WorldId) -> Result<(), StoreError> {
        robots::delete_world(self, id.to_string()).await
    }

    async fn submit(&self, new: NewJob, key: Option<IdempotencyKey>) -> Result<Submitted, StoreError> {
        jobs::submit(self, new, key).await
    }
    async fn submitted(&self, key: &IdempotencyKey) -> Result<Option<JobView>, StoreError> {
        jobs::submitted(self, key).await
    }
    async fn job(&self, id: &JobId) -> Result<JobView, StoreError> {
        jobs::get(self, id.as_str()).await
    }
    async fn work(&self, id: &JobId) -> Result<Work, StoreError> {
        jobs::work(self, id.as_str()).await
    }
    async fn jobs(&self, filter: &JobFilter, keyset: &Keyset) -> Result<Vec<JobView>, StoreError> {
        jobs::list(self, filter, keyset).await
    }
    async fn events(&self, id: &JobId, after_seq: u64, limit: u32) -> Result<EventPage, StoreError> {
        jobs::events(self, id, after_seq, limit).await
    }
    async fn ask(&self, id: &JobId, transition: Transition, at: Timestamp) -> Result<JobView, StoreError> {
        jobs::ask(self, id.to_string(), transition, at).await
    }

    async fn begin_epoch(&self, at: Timestamp) -> Result<Vec<JobId>, StoreError> {
        let (epoch, lost) = claims::begin_epoch(self, at).await?;
        self.epoch.store(epoch, Ordering::Release);
        Ok(lost)
    }
    async fn claim(
        &self,
        token: String,
        lease: Duration,
        max_crashes: u32,
        at: Timestamp,
    ) -> Result<Option<Claimed>, StoreError> {
        claims::claim(self, token, lease, max_crashes, at).await
    }
    async fn heartbeat(&self, claim: &Claim, lease: Duration) -> Result<State, StoreError> {
        claims::heartbeat(self, claim.clone(), lease).await
    }
    async fn advance(&self, claim: &Claim, step: Advance, at: Timestamp) -> Result<State, StoreError> {
        claims::advance(self, claim.clone(), step, at).await
    }
    async fn reap(&self, at: Timestamp) -> Result<Vec<JobId>, StoreError> {
        claims::reap(self, at).await
    }

    async fn run(&self, id: &RunId) -> Result<RunView, StoreError> {
        results::run(self, id.as_str()).await
    }
    async fn run_goals(&self, id: &RunId) -> Result<RunGoals, StoreError> {
        results::run_goals(self, id.as_str()).await
    }
    async fn run_convergence(&self, id: &RunId) -> Result<Vec<ConvergencePoint>, StoreError> {
        results::run_convergence(self, id.as_str()).await
    }
    async fn run_trials(&self, id: &RunId) -> Result<KeptTrials, StoreError> {
        trials::of_run(self, id.as_str()).await
    }
    async fn runs_on(&self, setting: &str, limit: u32) -> Result<Vec<(RunView, Vec<Trial>)>, StoreError> {
        trials::of_setting(self, setting, limit).await
    }
    async fn runs(&self, filter: &RunFilter, keyset: &Keyset) -> Result<Vec<RunView>, StoreError> {
        results::runs(self, filter, keyset).await
    }
    async fn experiment(&self, id: &ExperimentId) -> Result<ExperimentView, StoreError> {
        experiments::get(self, id.as_str()).await
    }
    async fn experiments(&self, keyset: &Keyset) -> Result<Vec<ExperimentView>, StoreError> {
        experiments::list(self, keyset).await
    }
    async fn experiment_plan(&self, id: &ExperimentId) -> Result<Plan, StoreError> {
        experiments::plan(self, id.as_str()).await
    }
    async fn experiment_rows(&self, id: &ExperimentId, filter: &RowFilter) -> Result<Vec<RunRow>, StoreError> {
        experiments::rows(self, id, filter).await
    }
    async fn trajectory(&self, id: &TrajectoryId) -> Result<TrajectoryView, StoreError> {
        results::trajectory(self, id.as_str()).await
    }
}
