//! Jobs as workers hold them: claim, heartbeat, advance, take back.
//!
//! A lease ends by the monotonic clock of the server that gave it and is void in any other epoch: a jump of the wall
//! clock ends none. The claim's token decides who may write; the lease only decides when a job is offered again.

use super::jobs::{append, apply, row};
use super::rows::{digest, json, value};
use super::statements::statements;
use super::{SqliteStore, engine_error, experiments, results};
use crate::app::model::{JobFailure, JobId, Timestamp};
use crate::app::ports::{Advance, Claim, Claimed, StoreError, Transition};
use crate::framework::job::{Event, State};
use sqlx::sqlite::SqliteConnection;
use std::time::Duration;

statements! {
    NEXT_EPOCH = "UPDATE instance SET epoch = epoch + 1 RETURNING epoch";
    ORPHANS = "SELECT id FROM jobs WHERE claim_epoch IS NOT NULL AND claim_epoch <> ?1 ORDER BY id";
    OVERDUE = "SELECT id FROM jobs WHERE claim_epoch = ?1 AND lease_until < ?2 ORDER BY id";
    OLDEST = "SELECT id FROM jobs WHERE state = 'QUEUED' ORDER BY id LIMIT 1";
    COUNT_ATTEMPT = "UPDATE jobs SET attempt = attempt + 1, crashes = crashes + 1 WHERE id = ?1";
    GIVE = "UPDATE jobs SET claim_token = ?2, claim_epoch = ?3, lease_until = ?4 WHERE id = ?1";
    WORK = "SELECT work FROM jobs WHERE id = ?1";
    CHECKPOINT = "SELECT sha256, data FROM checkpoints WHERE job_id = ?1";
    HOLDS = "SELECT 1 FROM jobs WHERE id = ?1 AND claim_token = ?2 AND claim_epoch = ?3";
    PROLONG = "UPDATE jobs SET lease_until = ?4 WHERE id = ?1 AND claim_token = ?2 AND claim_epoch = ?3
        RETURNING state";
    SET_PROGRESS = "UPDATE jobs SET progress = ?2 WHERE id = ?1";
    SET_CHECKPOINT = "INSERT INTO checkpoints (job_id, at, sha256, data) VALUES (?1, ?2, ?3, ?4)
        ON CONFLICT (job_id) DO UPDATE SET at = excluded.at, sha256 = excluded.sha256, data = excluded.data";
    FORGET_CRASHES = "UPDATE jobs SET crashes = 0 WHERE id = ?1";
}

pub(super) async fn begin_epoch(store: &SqliteStore, at: Timestamp) -> Result<(i64, Vec<JobId>), StoreError> {
    store
        .writer
        .write(move |connection| {
            Box::pin(async move {
                let epoch: i64 =
                    sqlx::query_scalar(NEXT_EPOCH).fetch_one(&mut *connection).await.map_err(engine_error)?;
                let orphans: Vec<String> =
                    sqlx::query_scalar(ORPHANS).bind(epoch).fetch_all(&mut *connection).await.map_err(engine_error)?;
                let lost = take_back(connection, orphans, "the server stopped", at).await?;
                Ok((epoch, lost))
            })
        })
        .await
}

pub(super) async fn reap(store: &SqliteStore, at: Timestamp) -> Result<Vec<JobId>, StoreError> {
    let (epoch, now) = (store.epoch(), store.monotonic_ms());
    store
        .writer
        .write(move |connection| {
            Box::pin(async move {
                let overdue: Vec<String> = sqlx::query_scalar(OVERDUE)
                    .bind(epoch)
                    .bind(now)
                    .fetch_all(&mut *connection)
                    .await
                    .map_err(engine_error)?;
                take_back(connection, overdue, "the worker stopped answering", at).await
            })
        })
        .await
}

async fn take_back(
    connection: &mut SqliteConnection,
    ids: Vec<String>,
    reason: &str,
    at: Timestamp,
) -> Result<Vec<JobId>, StoreError> {
    let mut lost = Vec::with_capacity(ids.len());
    for id in ids {
        let mut job = row(connection, &id).await?;
        let transition = Transition { reason: Some(reason.to_owned()), ..Transition::plain(Event::LoseWorker) };
        if apply(connection, &mut job, &transition, at).await? == State::Interrupted {
            apply(connection, &mut job, &Transition::plain(Event::Requeue), at).await?;
        }
        lost.push(job.id()?);
    }
    Ok(lost)
}

pub(super) async fn claim(
    store: &SqliteStore,
    token: String,
    lease: Duration,
    max_crashes: u32,
    at: Timestamp,
) -> Result<Option<Claimed>, StoreError> {
    let (epoch, until) = (store.epoch(), store.lease_end(lease));
    store
        .writer
        .write(move |connection| {
            Box::pin(async move {
                let Some(id) = next_healthy(connection, max_crashes, at).await? else { return Ok(None) };
                sqlx::query(COUNT_ATTEMPT).bind(&id).execute(&mut *connection).await.map_err(engine_error)?;
                sqlx::query(GIVE)
                    .bind(&id)
                    .bind(&token)
                    .bind(epoch)
                    .bind(until)
                    .execute(&mut *connection)
                    .await
                    .map_err(engine_error)?;
                let mut job = row(connection, &id).await?;
                apply(connection, &mut job, &Transition::plain(Event::Claim), at).await?;
                let work: String =
                    sqlx::query_scalar(WORK).bind(&id).fetch_one(&mut *connection).await.map_err(engine_error)?;
                let checkpoint = checkpoint(connection, &id).await?;
                let view = row(connection, &id).await?.view()?;
                let claim = Claim { job: view.id.clone(), token };
                Ok(Some(Claimed { claim, job: view, work: value(&id, &work)?, checkpoint }))
            })
        })
        .await
}

/// The oldest queued job that may be tried again; those that may not fail here.
async fn next_healthy(
    connection: &mut SqliteConnection,
    max_crashes: u32,
    at: Timestamp,
) -> Result<Option<String>, StoreError> {
    loop {
        let id: Option<String> =
            sqlx::query_scalar(OLDEST).fetch_optional(&mut *connection).await.map_err(engine_error)?;
        let Some(id) = id else { return Ok(None) };
        let mut job = row(connection, &id).await?;
        if job.crashes < max_crashes {
            return Ok(Some(id));
        }
        let message = format!("its worker was lost {} times in a row without progress", job.crashes);
        let transition = Transition {
            event: Event::Fail,
            reason: Some(message.clone()),
            failure: Some(JobFailure { code: "quarantined".to_owned(), message }),
        };
        apply(connection, &mut job, &transition, at).await?;
    }
}

/// The last checkpoint. One whose bytes changed is left out: the repetition then starts again from its seed and gives
/// the same bits.
async fn checkpoint(connection: &mut SqliteConnection, id: &str) -> Result<Option<Vec<u8>>, StoreError> {
    let found: Option<(String, Vec<u8>)> =
        sqlx::query_as(CHECKPOINT).bind(id).fetch_optional(connection).await.map_err(engine_error)?;
    let Some((sha256, data)) = found else { return Ok(None) };
    if digest(&data) != sha256 {
        tracing::error!(job.id = id, "the checkpoint is damaged and not used");
        return Ok(None);
    }
    Ok(Some(data))
}

pub(super) async fn heartbeat(store: &SqliteStore, claim: Claim, lease: Duration) -> Result<State, StoreError> {
    let (epoch, until) = (store.epoch(), store.lease_end(lease));
    store
        .writer
        .write(move |connection| {
            Box::pin(async move {
                let state: Option<String> = sqlx::query_scalar(PROLONG)
                    .bind(claim.job.as_str())
                    .bind(&claim.token)
                    .bind(epoch)
                    .bind(until)
                    .fetch_optional(connection)
                    .await
                    .map_err(engine_error)?;
                state.as_deref().and_then(State::from_name).ok_or(StoreError::LeaseLost { job: claim.job })
            })
        })
        .await
}

pub(super) async fn advance(
    store: &SqliteStore,
    claim: Claim,
    step: Advance,
    at: Timestamp,
) -> Result<State, StoreError> {
    let epoch = store.epoch();
    store
        .writer
        .write(move |connection| {
            Box::pin(async move {
                let id = claim.job.as_str();
                let holds: Option<i64> = sqlx::query_scalar(HOLDS)
                    .bind(id)
                    .bind(&claim.token)
                    .bind(epoch)
                    .fetch_optional(&mut *connection)
                    .await
                    .map_err(engine_error)?;
                if holds.is_none() {
                    return Err(StoreError::LeaseLost { job: claim.job });
                }
                write_step(connection, id, step, at).await
            })
        })
        .await
}

async fn write_step(
    connection: &mut SqliteConnection,
    id: &str,
    step: Advance,
    at: Timestamp,
) -> Result<State, StoreError> {
    let mut job = row(connection, id).await?;
    for run in &step.runs {
        results::insert_run(connection, run).await?;
    }
    if !step.rows.is_empty() {
        experiments::insert_rows(connection, id, &step.rows).await?;
        sqlx::query(FORGET_CRASHES).bind(id).execute(&mut *connection).await.map_err(engine_error)?;
    }
    if let Some((view, goals)) = step.action {
        results::insert_action(connection, view, &goals).await?;
    }
    if let Some(progress) = &step.progress {
        let progress = json(progress)?;
        sqlx::query(SET_PROGRESS).bind(id).bind(progress).execute(&mut *connection).await.map_err(engine_error)?;
    }
    if let Some(data) = step.checkpoint {
        sqlx::query(SET_CHECKPOINT)
            .bind(id)
            .bind(at.0)
            .bind(digest(&data))
            .bind(data)
            .execute(&mut *connection)
            .await
            .map_err(engine_error)?;
        sqlx::query(FORGET_CRASHES).bind(id).execute(&mut *connection).await.map_err(engine_error)?;
    }
    for event in &step.events {
        append(connection, &mut job, event, at).await?;
    }
    match step.transition {
        Some(transition) => apply(connection, &mut job, &transition, at).await,
        None => job.state(),
    }
}
