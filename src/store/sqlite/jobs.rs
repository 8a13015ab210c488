//! Jobs as users see and steer them: submit, read, list, events, steer.

use super::rows::{count, found, json, number, one};
use super::statements::statements;
use super::{SqliteStore, events, experiments, job_row};
use crate::app::model::{self, EventPage, JobEvent, JobFilter, JobId, JobKind, JobView, Keyset, Timestamp};
use crate::app::ports::rules::{Standing, Tail, event_page, keys_forgotten_before};
use crate::app::ports::{IdempotencyKey, Jobs, NewJob, StoreError, Submitted, Transition};
use crate::store::documents::{self, Progress, Request, Work};
use async_trait::async_trait;
use job_row::{JobRow, select_jobs};
use sqlx::sqlite::SqliteConnection;

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
        VALUES (?1, ?2, ?3, ?4, ?5, ?6, 0, 0, ?7, ?8, ?9, ?10, ?11, ?12, ?13)";
    EVENTS = "SELECT seq, at, data FROM job_events WHERE job_id = ?1 AND seq > ?2 AND seq <= ?3 ORDER BY seq LIMIT ?4";
}

#[async_trait]
impl Jobs for SqliteStore {
    async fn submit(&self, new: NewJob, key: Option<IdempotencyKey>) -> Result<Submitted, StoreError> {
        self.writer.write(move |connection| Box::pin(submit(connection, new, key))).await
    }

    async fn submitted(&self, key: &IdempotencyKey) -> Result<Option<JobView>, StoreError> {
        match by_key(&self.readers, key).await? {
            Some(id) => Ok(Some(self.read(&id).await?.view()?)),
            None => Ok(None),
        }
    }

    async fn job(&self, id: &JobId) -> Result<JobView, StoreError> {
        self.read(id.as_str()).await?.view()
    }

    async fn work(&self, id: &JobId) -> Result<model::Work, StoreError> {
        one::<Work>(&self.readers, WORK, "job", id.as_str()).await
    }

    async fn jobs(&self, filter: &JobFilter, keyset: &Keyset) -> Result<Vec<JobView>, StoreError> {
        let states = if filter.states.is_empty() { None } else { Some(json(&filter.states)?) };
        let rows: Vec<JobRow> = sqlx::query_as(PAGE)
            .bind(keyset.before_id.as_deref())
            .bind(i64::from(keyset.limit) + 1)
            .bind(states)
            .bind(filter.kind.map(JobKind::as_str))
            .fetch_all(&self.readers)
            .await?;
        rows.iter().map(JobRow::view).collect()
    }

    async fn events(&self, id: &JobId, after_seq: u64, limit: u32) -> Result<EventPage, StoreError> {
        // The job is read first: events up to its last number are then there, and no later one is shown.
        let job = self.read(id.as_str()).await?;
        let tail = Tail { last_seq: job.last_seq(), is_final: job.state()?.is_final() };
        if after_seq > tail.last_seq {
            return Ok(event_page(after_seq, tail, Vec::new()));
        }
        let rows: Vec<(i64, i64, String)> = sqlx::query_as(EVENTS)
            .bind(id.as_str())
            .bind(number(after_seq)?)
            .bind(number(tail.last_seq)?)
            .bind(limit)
            .fetch_all(&self.readers)
            .await?;
        let event = |(seq, at, data): &(i64, i64, String)| {
            let data = documents::read::<documents::Event>(id.as_str(), data)?;
            Ok(JobEvent { seq: count(*seq), job: id.clone(), at: Timestamp(*at), data })
        };
        let events = rows.iter().map(event).collect::<Result<_, StoreError>>()?;
        Ok(event_page(after_seq, tail, events))
    }

    async fn apply_event(&self, id: &JobId, transition: Transition, at: Timestamp) -> Result<JobView, StoreError> {
        let id = id.clone();
        self.writer.write(move |connection| Box::pin(apply_event(connection, id, transition, at))).await
    }
}

impl SqliteStore {
    async fn read(&self, id: &str) -> Result<JobRow, StoreError> {
        found(sqlx::query_as(ONE).bind(id).fetch_optional(&self.readers).await?, "job", id)
    }
}

async fn submit(
    connection: &mut SqliteConnection,
    new: NewJob,
    key: Option<IdempotencyKey>,
) -> Result<Submitted, StoreError> {
    let at = new.view.created_at;
    if let Some(key) = &key {
        sqlx::query(FORGET_KEYS).bind(keys_forgotten_before(at).0).execute(&mut *connection).await?;
        if let Some(job) = by_key(&mut *connection, key).await? {
            return Ok(Submitted::Existing(job_row::read(connection, &job).await?.view()?));
        }
    }
    let id = new.view.id.clone();
    let standing = Standing::submitted(at);
    let experiment = new.experiment.clone();
    insert(connection, new, &standing).await?;
    if let Some(experiment) = experiment {
        experiments::insert(connection, &id, experiment).await?;
    }
    let mut job = job_row::read(connection, id.as_str()).await?;
    events::append(connection, &mut job, standing.event(), at).await?;
    if let Some(key) = key {
        sqlx::query(INSERT_KEY)
            .bind(key.key)
            .bind(key.body_sha256)
            .bind(id.as_str())
            .bind(at.0)
            .execute(&mut *connection)
            .await?;
    }
    Ok(Submitted::Created(job.view()?))
}

async fn insert(connection: &mut SqliteConnection, new: NewJob, standing: &Standing) -> Result<(), StoreError> {
    let NewJob { view, work, uses, experiment: _ } = new;
    sqlx::query(INSERT)
        .bind(view.id.as_str())
        .bind(view.kind.as_str())
        .bind(&view.name)
        .bind(standing.state.as_str())
        .bind(standing.since.0)
        .bind(standing.attempt)
        .bind(documents::write::<Progress>(view.progress)?)
        .bind(documents::write::<Request>(view.request)?)
        .bind(documents::write::<Work>(work)?)
        .bind(view.created_at.0)
        .bind(uses.action.map(String::from))
        .bind(uses.robot.map(String::from))
        .bind(uses.world.map(String::from))
        .execute(connection)
        .await?;
    Ok(())
}

async fn by_key<'e, E>(executor: E, key: &IdempotencyKey) -> Result<Option<String>, StoreError>
where
    E: sqlx::Executor<'e, Database = sqlx::Sqlite>,
{
    let found: Option<(String, String)> = sqlx::query_as(KEY).bind(&key.key).fetch_optional(executor).await?;
    match found {
        Some((body, _)) if body != key.body_sha256 => Err(StoreError::KeyReused { key: key.key.clone() }),
        found => Ok(found.map(|(_, job)| job)),
    }
}

async fn apply_event(
    connection: &mut SqliteConnection,
    id: JobId,
    transition: Transition,
    at: Timestamp,
) -> Result<JobView, StoreError> {
    let mut job = job_row::read(connection, id.as_str()).await?;
    events::apply(connection, &mut job, &transition, at).await?;
    job_row::read(connection, id.as_str()).await?.view()
}
