//! A row of `jobs` with the results of the job.

use super::rows::{count, found, value};
use super::statements::statements;
use crate::app::model::{JobId, JobResult, JobView, Timestamp};
use crate::app::ports::StoreError;
use crate::app::ports::rules::Standing;
use crate::framework::job::State;
use crate::store::documents::{self, Failure, Progress, Request};
use sqlx::sqlite::{SqliteConnection, SqliteRow};
use sqlx::{FromRow, Row as _};

macro_rules! select_jobs {
    ($tail:literal) => {
        concat!(
            "SELECT id, kind, name, state, state_reason, state_since, attempt, crashes, last_seq, progress, request,
                failure, created_at, started_at, finished_at,
                (SELECT json_group_array(runs.id ORDER BY repetition) FROM runs WHERE runs.job_id = jobs.id) AS runs,
                (SELECT actions.id FROM actions WHERE actions.job_id = jobs.id) AS action,
                (SELECT experiments.id FROM experiments WHERE experiments.job_id = jobs.id) AS experiment
             FROM jobs ",
            $tail
        )
    };
}

pub(super) use select_jobs;

statements! {
    ONE = select_jobs!("WHERE id = ?1");
}

/// A row of `jobs`.
#[derive(Debug)]
pub(super) struct JobRow {
    pub(super) id: String,
    kind: String,
    name: String,
    state: String,
    state_reason: Option<String>,
    state_since: i64,
    attempt: u32,
    pub(super) crashes: u32,
    last_seq: i64,
    progress: String,
    request: String,
    failure: Option<String>,
    created_at: i64,
    started_at: Option<i64>,
    finished_at: Option<i64>,
    runs: String,
    action: Option<String>,
    experiment: Option<String>,
}

impl FromRow<'_, SqliteRow> for JobRow {
    fn from_row(row: &SqliteRow) -> sqlx::Result<Self> {
        Ok(Self {
            id: row.try_get("id")?,
            kind: row.try_get("kind")?,
            name: row.try_get("name")?,
            state: row.try_get("state")?,
            state_reason: row.try_get("state_reason")?,
            state_since: row.try_get("state_since")?,
            attempt: row.try_get("attempt")?,
            crashes: row.try_get("crashes")?,
            last_seq: row.try_get("last_seq")?,
            progress: row.try_get("progress")?,
            request: row.try_get("request")?,
            failure: row.try_get("failure")?,
            created_at: row.try_get("created_at")?,
            started_at: row.try_get("started_at")?,
            finished_at: row.try_get("finished_at")?,
            runs: row.try_get("runs")?,
            action: row.try_get("action")?,
            experiment: row.try_get("experiment")?,
        })
    }
}

impl JobRow {
    pub(super) fn state(&self) -> Result<State, StoreError> {
        State::from_name(&self.state).ok_or_else(|| self.corrupt("state", &self.state))
    }

    pub(super) fn id(&self) -> Result<JobId, StoreError> {
        self.id.parse().map_err(|_| self.corrupt("id", &self.id))
    }

    pub(super) fn last_seq(&self) -> u64 {
        count(self.last_seq)
    }

    /// Notes that an event was appended.
    pub(super) fn set_last_seq(&mut self, seq: i64) {
        self.last_seq = seq;
    }

    /// Notes a change of state.
    pub(super) fn set_state(&mut self, state: State) {
        state.as_str().clone_into(&mut self.state);
    }

    fn corrupt(&self, column: &str, cause: &str) -> StoreError {
        StoreError::Corrupt { what: format!("{column} of {}", self.id), cause: cause.to_owned() }
    }

    pub(super) fn standing(&self) -> Result<Standing, StoreError> {
        Ok(Standing {
            state: self.state()?,
            reason: self.state_reason.clone(),
            since: Timestamp(self.state_since),
            attempt: self.attempt,
            failure: self.failure.as_deref().map(|text| documents::read::<Failure>(&self.id, text)).transpose()?,
            started_at: self.started_at.map(Timestamp),
            finished_at: self.finished_at.map(Timestamp),
        })
    }

    pub(super) fn view(&self) -> Result<JobView, StoreError> {
        let action = self.action.as_ref().map(|id| id.parse().map_err(|_| self.corrupt("action", id))).transpose()?;
        let experiment = self.experiment.as_ref();
        let experiment = experiment.map(|id| id.parse().map_err(|_| self.corrupt("experiment", id))).transpose()?;
        let Standing { state, reason, since, attempt, failure, started_at, finished_at } = self.standing()?;
        Ok(JobView {
            id: self.id()?,
            kind: value("job kind", &format!("{:?}", self.kind))?,
            name: self.name.clone(),
            state,
            state_reason: reason,
            state_since: since,
            attempt,
            progress: documents::read::<Progress>(&self.id, &self.progress)?,
            request: documents::read::<Request>(&self.id, &self.request)?,
            result: JobResult { action, runs: value(&self.id, &self.runs)?, experiment },
            failure,
            last_seq: self.last_seq(),
            created_at: Timestamp(self.created_at),
            started_at,
            finished_at,
        })
    }
}

/// The row of a job, in the writer's transaction.
pub(super) async fn read(connection: &mut SqliteConnection, id: &str) -> Result<JobRow, StoreError> {
    found(sqlx::query_as(ONE).bind(id).fetch_optional(connection).await?, "job", id)
}
