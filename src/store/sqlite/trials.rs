//! Trials: written with the run that made them, found again by the key of the set-up they were made on.

use super::statements::statements;
use crate::app::model::RunId;
use crate::app::ports::{KeptTrials, StoreError};
use crate::store::documents::{self, Trials};
use sqlx::sqlite::{SqliteConnection, SqlitePool};

statements! {
    INSERT = "INSERT INTO run_trials (run_id, setting, trials) VALUES (?1, ?2, ?3)";
    OF_RUN = "SELECT setting, trials FROM run_trials WHERE run_id = ?1";
}

/// Keeps the trials of a run, if it has any.
pub(super) async fn insert(connection: &mut SqliteConnection, run: &RunId, kept: KeptTrials) -> Result<(), StoreError> {
    let KeptTrials { setup_key, trials } = kept;
    if trials.is_empty() {
        return Ok(());
    }
    sqlx::query(INSERT)
        .bind(run.as_str())
        .bind(setup_key)
        .bind(documents::write::<Trials>(trials)?)
        .execute(connection)
        .await?;
    Ok(())
}

/// The trials of a run; empty if it has none.
pub(super) async fn of_run(pool: &SqlitePool, run: &RunId) -> Result<KeptTrials, StoreError> {
    let row: Option<(Option<String>, String)> = sqlx::query_as(OF_RUN).bind(run.as_str()).fetch_optional(pool).await?;
    let Some((setup_key, trials)) = row else { return Ok(KeptTrials::default()) };
    Ok(KeptTrials { setup_key, trials: documents::read::<Trials>(run.as_str(), &trials)? })
}
