//! Trials: written with the run that made them, found again by what they were made on.

use super::rows::{json, value};
use super::statements::statements;
use super::{SqliteStore, engine_error};
use crate::app::model::RunView;
use crate::app::ports::{KeptTrials, NewRun, StoreError};
use crate::framework::method::whole_run::Trial;
use sqlx::sqlite::SqliteConnection;

statements! {
    INSERT = "INSERT INTO run_trials (run_id, setting, trials) VALUES (?1, ?2, ?3)";
    OF_RUN = "SELECT setting, trials FROM run_trials WHERE run_id = ?1";
    OF_SETTING = "SELECT runs.view, run_trials.trials FROM run_trials JOIN runs ON runs.id = run_trials.run_id
        WHERE setting = ?1 ORDER BY run_id DESC LIMIT ?2";
}

pub(super) async fn insert(connection: &mut SqliteConnection, new: &NewRun) -> Result<(), StoreError> {
    let KeptTrials { setting, trials } = &new.trials;
    if trials.is_empty() {
        return Ok(());
    }
    sqlx::query(INSERT)
        .bind(new.view.id.as_str())
        .bind(setting.as_deref())
        .bind(json(trials)?)
        .execute(connection)
        .await
        .map_err(engine_error)?;
    Ok(())
}

pub(super) async fn of_run(store: &SqliteStore, id: &str) -> Result<KeptTrials, StoreError> {
    let row: Option<(Option<String>, String)> =
        sqlx::query_as(OF_RUN).bind(id).fetch_optional(&store.readers).await.map_err(engine_error)?;
    let Some((setting, trials)) = row else { return Ok(KeptTrials::default()) };
    Ok(KeptTrials { setting, trials: value(id, &trials)? })
}

pub(super) async fn of_setting(
    store: &SqliteStore,
    setting: &str,
    limit: u32,
) -> Result<Vec<(RunView, Vec<Trial>)>, StoreError> {
    let rows: Vec<(String, String)> =
        sqlx::query_as(OF_SETTING).bind(setting).bind(limit).fetch_all(&store.readers).await.map_err(engine_error)?;
    rows.iter().map(|(view, trials)| Ok((value("run", view)?, value("trials", trials)?))).collect()
}
