//! Jobs as workers hold them: claim, heartbeat, advance, take back.
//!
//! A lease ends by the monotonic clock of the server that gave it and is void in any other epoch: a jump of the wall
//! clock ends none. The claim's token decides who may write; the lease only decides when a job is offered again.

use super::events::{append, apply};
use super::rows::digest;
use super::statements::statements;
use super::{SqliteStore, actions, experiments, job_row, runs};
use crate::app::model::{JobId, Timestamp};
use crate::app::ports::rules::{Loss, is_progress, quarantine, take_back};
use crate::app::ports::{Advance, Claim, Claimed, Product, Queue, StoreError, Transition};
use crate::framework::job::{Event, State};
use crate::store::documents::{self, Progress, Work};
use async_trait::async_trait;
use sqlx::sqlite::SqliteConnection;
use std::sync::atomic::Ordering;
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

/// The part of a claim that this server's epoch and clock decide.
#[derive(Clone, Copy)]
struct Lease {
    epoch: i64,
    until_ms: i64,
}

impl SqliteStore {
    fn lease(&self, lease: Duration) -> Lease {
        Lease { epoch: self.epoch(), until_ms: self.lease_end(lease) }
    }
}

#[async_trait]
impl Queue for SqliteStore {
    async fn begin_epoch(&self, at: Timestamp) -> Result<Vec<JobId>, StoreError> {
        let (epoch, lost) = self.writer.write(move |connection| Box::pin(begin_epoch(connection, at))).await?;
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
        let lease = self.lease(lease);
        self.writer.write(move |connection| Box::pin(claim(connection, token, lease, max_crashes, at))).await
    }

    async fn heartbeat(&self, claim: &Claim, lease: Duration) -> Result<State, StoreError> {
        let (claim, lease) = (claim.clone(), self.lease(lease));
        self.writer.write(move |connection| Box::pin(prolong(connection, claim, lease))).await
    }

    async fn advance(&self, claim: &Claim, step: Advance, at: Timestamp) -> Result<State, StoreError> {
        let (claim, epoch) = (claim.clone(), self.epoch());
        self.writer.write(move |connection| Box::pin(advance(connection, claim, epoch, step, at))).await
    }

    async fn reap(&self, at: Timestamp) -> Result<Vec<JobId>, StoreError> {
        let (epoch, now) = (self.epoch(), self.monotonic_ms());
        self.writer.write(move |connection| Box::pin(reap(connection, epoch, now, at))).await
    }
}

async fn begin_epoch(connection: &mut SqliteConnection, at: Timestamp) -> Result<(i64, Vec<JobId>), StoreError> {
    let epoch: i64 = sqlx::query_scalar(NEXT_EPOCH).fetch_one(&mut *connection).await?;
    let orphans: Vec<String> = sqlx::query_scalar(ORPHANS).bind(epoch).fetch_all(&mut *connection).await?;
    Ok((epoch, lose(connection, orphans, Loss::ServerStopped, at).await?))
}

async fn reap(
    connection: &mut SqliteConnection,
    epoch: i64,
    now: i64,
    at: Timestamp,
) -> Result<Vec<JobId>, StoreError> {
    let overdue: Vec<String> = sqlx::query_scalar(OVERDUE).bind(epoch).bind(now).fetch_all(&mut *connection).await?;
    lose(connection, overdue, Loss::LeaseRanOut, at).await
}

async fn lose(
    connection: &mut SqliteConnection,
    ids: Vec<String>,
    loss: Loss,
    at: Timestamp,
) -> Result<Vec<JobId>, StoreError> {
    let mut lost = Vec::with_capacity(ids.len());
    for id in ids {
        let mut job = job_row::read(connection, &id).await?;
        for transition in take_back(job.state()?, loss)? {
            apply(connection, &mut job, &transition, at).await?;
        }
        lost.push(job.id()?);
    }
    Ok(lost)
}

async fn claim(
    connection: &mut SqliteConnection,
    token: String,
    lease: Lease,
    max_crashes: u32,
    at: Timestamp,
) -> Result<Option<Claimed>, StoreError> {
    let Some(id) = next_healthy(connection, max_crashes, at).await? else { return Ok(None) };
    sqlx::query(COUNT_ATTEMPT).bind(&id).execute(&mut *connection).await?;
    sqlx::query(GIVE).bind(&id).bind(&token).bind(lease.epoch).bind(lease.until_ms).execute(&mut *connection).await?;
    let mut job = job_row::read(connection, &id).await?;
    apply(connection, &mut job, &Transition::plain(Event::Claim), at).await?;
    let work: String = sqlx::query_scalar(WORK).bind(&id).fetch_one(&mut *connection).await?;
    let checkpoint = checkpoint(connection, &id).await?;
    let view = job_row::read(connection, &id).await?.view()?;
    let claim = Claim { job: view.id.clone(), token };
    Ok(Some(Claimed { claim, job: view, work: documents::read::<Work>(&id, &work)?, checkpoint }))
}

/// The oldest queued job that may be tried again; jobs that crashed too often fail on the way.
async fn next_healthy(
    connection: &mut SqliteConnection,
    max_crashes: u32,
    at: Timestamp,
) -> Result<Option<String>, StoreError> {
    loop {
        let id: Option<String> = sqlx::query_scalar(OLDEST).fetch_optional(&mut *connection).await?;
        let Some(id) = id else { return Ok(None) };
        let mut job = job_row::read(connection, &id).await?;
        let Some(failure) = quarantine(job.crashes, max_crashes) else { return Ok(Some(id)) };
        apply(connection, &mut job, &failure, at).await?;
    }
}

/// The last checkpoint. One whose bytes changed is left out: the repetition then starts again from its seed and gives
/// the same bits.
async fn checkpoint(connection: &mut SqliteConnection, id: &str) -> Result<Option<Vec<u8>>, StoreError> {
    let found: Option<(String, Vec<u8>)> = sqlx::query_as(CHECKPOINT).bind(id).fetch_optional(connection).await?;
    let Some((sha256, data)) = found else { return Ok(None) };
    if digest(&data) != sha256 {
        tracing::error!(job.id = id, "the checkpoint is damaged and not used");
        return Ok(None);
    }
    Ok(Some(data))
}

async fn prolong(connection: &mut SqliteConnection, claim: Claim, lease: Lease) -> Result<State, StoreError> {
    let state: Option<String> = sqlx::query_scalar(PROLONG)
        .bind(claim.job.as_str())
        .bind(&claim.token)
        .bind(lease.epoch)
        .bind(lease.until_ms)
        .fetch_optional(connection)
        .await?;
    state.as_deref().and_then(State::from_name).ok_or(StoreError::LeaseLost { job: claim.job })
}

async fn advance(
    connection: &mut SqliteConnection,
    claim: Claim,
    epoch: i64,
    step: Advance,
    at: Timestamp,
) -> Result<State, StoreError> {
    let holds: Option<i64> = sqlx::query_scalar(HOLDS)
        .bind(claim.job.as_str())
        .bind(&claim.token)
        .bind(epoch)
        .fetch_optional(&mut *connection)
        .await?;
    if holds.is_none() {
        return Err(StoreError::LeaseLost { job: claim.job });
    }
    write_step(connection, &claim.job, step, at).await
}

async fn write_step(
    connection: &mut SqliteConnection,
    id: &JobId,
    step: Advance,
    at: Timestamp,
) -> Result<State, StoreError> {
    let mut job = job_row::read(connection, id.as_str()).await?;
    if is_progress(&step) {
        sqlx::query(FORGET_CRASHES).bind(id.as_str()).execute(&mut *connection).await?;
    }
    let Advance { products, progress, checkpoint: data, events, transition } = step;
    for product in products {
        match product {
            Product::Action(made) => actions::insert(connection, made.0, made.1).await?,
            Product::Run(run) => runs::insert(connection, *run).await?,
            Product::Rows(rows) => experiments::insert_rows(connection, id, rows).await?,
        }
    }
    if let Some(progress) = progress {
        let document = documents::write::<Progress>(progress)?;
        sqlx::query(SET_PROGRESS).bind(id.as_str()).bind(document).execute(&mut *connection).await?;
    }
    if let Some(data) = data {
        sqlx::query(SET_CHECKPOINT)
            .bind(id.as_str())
            .bind(at.0)
            .bind(digest(&data))
            .bind(data)
            .execute(&mut *connection)
            .await?;
    }
    for event in events {
        append(connection, &mut job, event, at).await?;
    }
    match transition {
        Some(transition) => apply(connection, &mut job, &transition, at).await,
        None => job.state(),
    }
}
