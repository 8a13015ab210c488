//! Events of jobs, numbered, and changes of state, each with the event that reports it.

use super::job_row::JobRow;
use super::rows::number;
use super::statements::statements;
use crate::app::model::{EventData, Timestamp};
use crate::app::ports::rules::{Standing, next_seq};
use crate::app::ports::{StoreError, Transition};
use crate::framework::job::State;
use crate::store::documents::{self, Event, Failure};
use sqlx::sqlite::SqliteConnection;

statements! {
    INSERT = "INSERT INTO job_events (job_id, seq, at, terminal, data) VALUES (?1, ?2, ?3, ?4, ?5)";
    SET_SEQ = "UPDATE jobs SET last_seq = ?2 WHERE id = ?1";
    SET_STANDING = "UPDATE jobs SET state = ?2, state_reason = ?3, state_since = ?4, failure = ?5, started_at = ?6,
        finished_at = ?7 WHERE id = ?1";
    FORGET_CLAIM = "UPDATE jobs SET claim_token = NULL, claim_epoch = NULL, lease_until = NULL WHERE id = ?1";
    FORGET_CHECKPOINT = "DELETE FROM checkpoints WHERE job_id = ?1";
}

/// Appends an event and gives it the next number.
pub(super) async fn append(
    connection: &mut SqliteConnection,
    row: &mut JobRow,
    data: EventData,
    at: Timestamp,
) -> Result<(), StoreError> {
    let seq = number(next_seq(row.last_seq()))?;
    let terminal = matches!(data, EventData::State { state, .. } if state.is_final());
    sqlx::query(INSERT)
        .bind(&row.id)
        .bind(seq)
        .bind(at.0)
        .bind(terminal)
        .bind(documents::write::<Event>(Event::try_from(data)?)?)
        .execute(&mut *connection)
        .await?;
    sqlx::query(SET_SEQ).bind(&row.id).bind(seq).execute(connection).await?;
    row.set_last_seq(seq);
    Ok(())
}

/// Moves a job to its next state and appends the event that reports it.
pub(super) async fn apply(
    connection: &mut SqliteConnection,
    row: &mut JobRow,
    transition: &Transition,
    at: Timestamp,
) -> Result<State, StoreError> {
    let standing = row.standing()?.moved(transition, at)?;
    write(connection, &row.id, &standing).await?;
    row.set_state(standing.state);
    append(connection, row, standing.event(), at).await?;
    Ok(standing.state)
}

async fn write(connection: &mut SqliteConnection, id: &str, standing: &Standing) -> Result<(), StoreError> {
    let failure = standing.failure.clone().map(documents::write::<Failure>).transpose()?;
    sqlx::query(SET_STANDING)
        .bind(id)
        .bind(standing.state.as_str())
        .bind(standing.reason.as_deref())
        .bind(standing.since.0)
        .bind(failure)
        .bind(standing.started_at.map(|at| at.0))
        .bind(standing.finished_at.map(|at| at.0))
        .execute(&mut *connection)
        .await?;
    if !standing.keeps_claim() {
        sqlx::query(FORGET_CLAIM).bind(id).execute(&mut *connection).await?;
    }
    if !standing.keeps_checkpoint() {
        sqlx::query(FORGET_CHECKPOINT).bind(id).execute(connection).await?;
    }
    Ok(())
}
