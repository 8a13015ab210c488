//! Jobs as users see and steer them: submit, read, list, events, ask.

use super::rows::{count, json, number, value};
use super::statements::statements;
use super::{SqliteStore, engine_error};
use crate::app::model::{
    EventData, EventPage, JobEvent, JobFilter, JobId, JobKind, JobResult, JobView, Keyset, Timestamp, Work,
};
use crate::app::ports::{IdempotencyKey, NewJob, StoreError, Submitted, Transition};
use crate::framework::job::State;
use sqlx::sqlite::{SqliteConnection, SqlitePool};

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

statements! {
    ONE = select_jobs!("WHERE id = ?1");
    PAGE = select_jobs!(
        "WHERE (?1 IS NULL OR id < ?1) AND (?3 IS NULL OR state IN (SELECT value FROM json_each(?3)))
         AND (?4 IS NULL OR kind = ?4) ORDER BY id DESC LIMIT ?2"
    );
    WORK = "SELECT work FROM jobs WHERE id = ?1";
    KEY = "SELECT body_sha256, job_id FROM idempotency_keys WHERE key = ?1";
    INSERT_KEY = "INSERT INTO idempotency_keys (key, body_sha256, job_id, created_at) VALUES (?1, ?2, ?3, ?4)";
    FORGET_KEYS = "DELETE FROM idempotency_keys WHERE created_at < ?1 AND job_id IN
        (SELECT id FROM jobs WHERE finished_at < ?1)";
    INSERT = "INSERT INTO jobs (id, kind, name, state, state_since, attempt, crashes, last_seq, progress, request, work,
            created_at, action_id, robot_id, world_id)
        VALUES (?1, ?2, ?3, ?4, ?5, 0, 0, 0, ?6, ?7, ?8, ?9, ?10, ?11, ?12)";
    INSERT_EVENT = "INSERT INTO job_events (job_id, seq, at, terminal, data) VALUES (?1, ?2, ?3, ?4, ?5)";
    SET_SEQ = "UPDATE jobs SET last_seq = ?2 WHERE id = ?1";
    SET_STATE = "UPDATE jobs SET state = ?2, state_reason = ?3, state_since = ?4, failure = coalesce(?5, failure),
            started_at = CASE WHEN ?2 = 'RUNNING' THEN coalesce(started_at, ?4) ELSE started_at END,
            finished_at = CASE WHEN ?6 THEN ?4 END,
            claim_token = CASE WHEN ?7 THEN claim_token END,
            claim_epoch = CASE WHEN ?7 THEN claim_epoch END,
            lease_until = CASE WHEN ?7 THEN lease_until END
        WHERE id = ?1";
    FORGET_CHECKPOINT = "DELETE FROM checkpoints WHERE job_id = ?1";
    EVENTS = "SELECT seq, at, data FROM job_events WHERE job_id = ?1 AND seq > ?2 AND seq <= ?3 ORDER BY seq LIMIT ?4";
}

/// How long an idempotency key is kept after its job ended, milliseconds.
const KEEP_KEYS_MS: i64 = 48 * 3_600_000;

/// A row of `jobs`.
#[derive(Debug, sqlx::FromRow)]
pub(super) struct JobRow {
    pub(super) id: String,
    kind: String,
    name: String,
    state: String,
    state_reason: Option<String>,
    state_since: i64,
    pub(super) attempt: u32,
    pub(super) crashes: u32,
    pub(super) last_seq: i64,
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

impl JobRow {
    pub(super) fn state(&self) -> Result<State, StoreError> {
        State::from_name(&self.state).ok_or_else(|| self.corrupt("state", &self.state))
    }

    pub(super) fn id(&self) -> Result<JobId, StoreError> {
        self.id.parse().map_err(|_| self.corrupt("id", &self.id))
    }

    fn corrupt(&self, column: &str, cause: &str) -> StoreError {
        StoreError::Corrupt { what: format!("{column} of {}", self.id), cause: cause.to_owned() }
    }

    pub(super) fn view(&self) -> Result<JobView, StoreError> {
        let action = self.action.as_ref().map(|id| id.parse().map_err(|_| self.corrupt("action", id))).transpose()?;
        let experiment = self.experiment.as_ref();
        let experiment = experiment.map(|id| id.parse().map_err(|_| self.corrupt("experiment", id))).transpose()?;
        Ok(JobView {
            id: self.id()?,
            kind: value("job kind", &format!("{:?}", self.kind))?,
            name: self.name.clone(),
            state: self.state()?,
            state_reason: self.state_reason.clone(),
            state_since: Timestamp(self.state_since),
            attempt: self.attempt,
            progress: value(&self.id, &self.progress)?,
            request: value(&self.id, &self.request)?,
            result: JobResult { action, runs: value(&self.id, &self.runs)?, experiment },
            failure: self.failure.as_deref().map(|text| value(&self.id, text)).transpose()?,
            last_seq: count(self.last_seq),
            created_at: Timestamp(self.created_at),
            started_at: self.started_at.map(Timestamp),
            finished_at: self.finished_at.map(Timestamp),
        })
    }
}

/// The row of a job, in the writer's transaction.
pub(super) async fn row(connection: &mut SqliteConnection, id: &str) -> Result<JobRow, StoreError> {
    sqlx::query_as(ONE)
        .bind(id)
        .fetch_optional(connection)
        .await
        .map_err(engine_error)?
        .ok_or_else(|| StoreError::NotFound { kind: "job", id: id.to_owned() })
}

/// Appends an event and gives it the next number.
pub(super) async fn append(
    connection: &mut SqliteConnection,
    row: &mut JobRow,
    data: &EventData,
    at: Timestamp,
) -> Result<(), StoreError> {
    row.last_seq += 1;
    let terminal = matches!(data, EventData::State { state, .. } if state.is_final());
    sqlx::query(INSERT_EVENT)
        .bind(&row.id)
        .bind(row.last_seq)
        .bind(at.0)
        .bind(terminal)
        .bind(json(data)?)
        .execute(&mut *connection)
        .await
        .map_err(engine_error)?;
    sqlx::query(SET_SEQ).bind(&row.id).bind(row.last_seq).execute(connection).await.map_err(engine_error)?;
    Ok(())
}

/// Moves a job to its next state, with the event that tells it. A job that nobody holds any more has no claim.
pub(super) async fn apply(
    connection: &mut SqliteConnection,
    row: &mut JobRow,
    transition: &Transition,
    at: Timestamp,
) -> Result<State, StoreError> {
    let state = row.state()?.apply(transition.event)?;
    let failure = transition.failure.as_ref().map(json).transpose()?;
    sqlx::query(SET_STATE)
        .bind(&row.id)
        .bind(state.as_str())
        .bind(&transition.reason)
        .bind(at.0)
        .bind(failure)
        .bind(state.is_final())
        .bind(state.is_held())
        .execute(&mut *connection)
        .await
        .map_err(engine_error)?;
    if state.is_final() {
        sqlx::query(FORGET_CHECKPOINT).bind(&row.id).execute(&mut *connection).await.map_err(engine_error)?;
    }
    state.as_str().clone_into(&mut row.state);
    let data = EventData::State { state, reason: transition.reason.clone(), attempt: row.attempt };
    append(connection, row, &data, at).await?;
    Ok(state)
}

pub(super) async fn submit(
    store: &SqliteStore,
    new: NewJob,
    key: Option<IdempotencyKey>,
) -> Result<Submitted, StoreError> {
    store
        .writer
        .write(move |connection| {
            Box::pin(async move {
                let at = new.view.created_at;
                if let Some(key) = &key {
                    sqlx::query(FORGET_KEYS)
                        .bind(at.0 - KEEP_KEYS_MS)
                        .execute(&mut *connection)
                        .await
                        .map_err(engine_error)?;
                    if let Some(job) = by_key(&mut *connection, key).await? {
                        return Ok(Submitted::Existing(row(connection, &job).await?.view()?));
                    }
                }
                insert(connection, &new).await?;
                if let Some(experiment) = &new.experiment {
                    super::experiments::insert(connection, &new.view.id, experiment).await?;
                }
                let id = new.view.id.as_str();
                let mut job = row(connection, id).await?;
                let data = EventData::State { state: State::Queued, reason: None, attempt: 0 };
                append(connection, &mut job, &data, at).await?;
                if let Some(key) = key {
                    sqlx::query(INSERT_KEY)
                        .bind(key.key)
                        .bind(key.body_sha256)
                        .bind(id)
                        .bind(at.0)
                        .execute(&mut *connection)
                        .await
                        .map_err(engine_error)?;
                }
                Ok(Submitted::Created(job.view()?))
            })
        })
        .await
}

async fn insert(connection: &mut SqliteConnection, new: &NewJob) -> Result<(), StoreError> {
    sqlx::query(INSERT)
        .bind(new.view.id.as_str())
        .bind(new.view.kind.as_str())
        .bind(&new.view.name)
        .bind(State::Queued.as_str())
        .bind(new.view.state_since.0)
        .bind(json(&new.view.progress)?)
        .bind(json(&new.view.request)?)
        .bind(json(&new.work)?)
        .bind(new.view.created_at.0)
        .bind(new.uses.action.as_ref().map(|id| id.as_str().to_owned()))
        .bind(new.uses.robot.as_ref().map(|id| id.as_str().to_owned()))
        .bind(new.uses.world.as_ref().map(|id| id.as_str().to_owned()))
        .execute(connection)
        .await
        .map_err(engine_error)?;
    Ok(())
}

async fn by_key<'e, E>(executor: E, key: &IdempotencyKey) -> Result<Option<String>, StoreError>
where
    E: sqlx::Executor<'e, Database = sqlx::Sqlite>,
{
    let found: Option<(String, String)> =
        sqlx::query_as(KEY).bind(&key.key).fetch_optional(executor).await.map_err(engine_error)?;
    match found {
        Some((body, _)) if body != key.body_sha256 => Err(StoreError::KeyReused { key: key.key.clone() }),
        found => Ok(found.map(|(_, job)| job)),
    }
}

pub(super) async fn submitted(store: &SqliteStore, key: &IdempotencyKey) -> Result<Option<JobView>, StoreError> {
    match by_key(&store.readers, key).await? {
        Some(id) => Ok(Some(get(store, &id).await?)),
        None => Ok(None),
    }
}

pub(super) async fn get(store: &SqliteStore, id: &str) -> Result<JobView, StoreError> {
    read(&store.readers, id).await?.view()
}

async fn read(pool: &SqlitePool, id: &str) -> Result<JobRow, StoreError> {
    sqlx::query_as(ONE)
        .bind(id)
        .fetch_optional(pool)
        .await
        .map_err(engine_error)?
        .ok_or_else(|| StoreError::NotFound { kind: "job", id: id.to_owned() })
}

pub(super) async fn work(store: &SqliteStore, id: &str) -> Result<Work, StoreError> {
    super::rows::one(&store.readers, WORK, "job", id).await
}

pub(super) async fn list(store: &SqliteStore, filter: &JobFilter, keyset: &Keyset) -> Result<Vec<JobView>, StoreError> {
    let states = if filter.states.is_empty() { None } else { Some(json(&filter.states)?) };
    let rows: Vec<JobRow> = sqlx::query_as(PAGE)
        .bind(keyset.before_id.as_deref())
        .bind(i64::from(keyset.limit) + 1)
        .bind(states)
        .bind(filter.kind.map(JobKind::as_str))
        .fetch_all(&store.readers)
        .await
        .map_err(engine_error)?;
    rows.iter().map(JobRow::view).collect()
}

pub(super) async fn events(
    store: &SqliteStore,
    id: &JobId,
    after_seq: u64,
    limit: u32,
) -> Result<EventPage, StoreError> {
    // The job is read first: events up to its last number are then there, and no later one is shown.
    let job = read(&store.readers, id.as_str()).await?;
    let last_seq = count(job.last_seq);
    if after_seq > last_seq {
        return Ok(EventPage { events: Vec::new(), resync: true, last_seq, end: false });
    }
    let rows: Vec<(i64, i64, String)> = sqlx::query_as(EVENTS)
        .bind(id.as_str())
        .bind(number(after_seq)?)
        .bind(job.last_seq)
        .bind(limit)
        .fetch_all(&store.readers)
        .await
        .map_err(engine_error)?;
    let events = rows
        .iter()
        .map(|(seq, at, data)| {
            Ok(JobEvent { seq: count(*seq), job: id.clone(), at: Timestamp(*at), data: value(id.as_str(), data)? })
        })
        .collect::<Result<Vec<_>, StoreError>>()?;
    let seen = events.last().map_or(after_seq, |event| event.seq);
    let resync = events.first().is_some_and(|event| event.seq != after_seq + 1);
    Ok(EventPage { events, resync, last_seq, end: job.state()?.is_final() && seen == last_seq })
}

pub(super) async fn ask(
    store: &SqliteStore,
    id: String,
    transition: Transition,
    at: Timestamp,
) -> Result<JobView, StoreError> {
    store
        .writer
        .write(move |connection| {
            Box::pin(async move {
                let mut job = row(connection, &id).await?;
                apply(connection, &mut job, &transition, at).await?;
                row(connection, &id).await?.view()
            })
        })
        .await
}
