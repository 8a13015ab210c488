//! Experiments: the plan, written with its job; the rows, written by [`super::claims`] with the job's progress.

use super::rows::{json, one, value};
use super::statements::statements;
use super::{SqliteStore, engine_error};
use crate::app::model::{ExperimentId, ExperimentView, JobId, Keyset, RowFilter};
use crate::app::ports::{NewExperiment, StoreError};
use crate::framework::experiment::{Plan, RunRow};
use crate::framework::job::State;
use sqlx::sqlite::SqliteConnection;

macro_rules! select_views {
    ($tail:literal) => {
        concat!(
            "SELECT experiments.view, jobs.state, experiments.finished_runs
             FROM experiments JOIN jobs ON jobs.id = experiments.job_id ",
            $tail
        )
    };
}

statements! {
    ONE = select_views!("WHERE experiments.id = ?1");
    PAGE = select_views!("WHERE (?1 IS NULL OR experiments.id < ?1) ORDER BY experiments.id DESC LIMIT ?2");
    PLAN = "SELECT plan FROM experiments WHERE id = ?1";
    ROWS = "SELECT data FROM experiment_rows
        WHERE experiment_id = ?1 AND (?2 IS NULL OR cell = ?2) AND (cell, repetition) > (?3, ?4)
        ORDER BY cell, repetition LIMIT ?5";
    INSERT = "INSERT INTO experiments (id, job_id, created_at, finished_runs, view, plan)
        VALUES (?1, ?2, ?3, 0, ?4, ?5)";
    OF_JOB = "SELECT id FROM experiments WHERE job_id = ?1";
    INSERT_ROW = "INSERT INTO experiment_rows (experiment_id, cell, repetition, data) VALUES (?1, ?2, ?3, ?4)";
    COUNT_ROWS = "UPDATE experiments SET finished_runs = finished_runs + ?2 WHERE id = ?1";
}

type ViewRow = (String, String, i64);

fn view((view, state, finished_runs): ViewRow) -> Result<ExperimentView, StoreError> {
    let state = State::from_name(&state)
        .ok_or_else(|| StoreError::Corrupt { what: "state of an experiment's job".to_owned(), cause: state.clone() })?;
    let view: ExperimentView = value("experiment", &view)?;
    Ok(ExperimentView { state, finished_runs: super::rows::count(finished_runs), ..view })
}

pub(super) async fn get(store: &SqliteStore, id: &str) -> Result<ExperimentView, StoreError> {
    let row: Option<ViewRow> =
        sqlx::query_as(ONE).bind(id).fetch_optional(&store.readers).await.map_err(engine_error)?;
    view(row.ok_or_else(|| StoreError::NotFound { kind: "experiment", id: id.to_owned() })?)
}

pub(super) async fn list(store: &SqliteStore, keyset: &Keyset) -> Result<Vec<ExperimentView>, StoreError> {
    let rows: Vec<ViewRow> = sqlx::query_as(PAGE)
        .bind(keyset.before_id.as_deref())
        .bind(i64::from(keyset.limit) + 1)
        .fetch_all(&store.readers)
        .await
        .map_err(engine_error)?;
    rows.into_iter().map(view).collect()
}

pub(super) async fn plan(store: &SqliteStore, id: &str) -> Result<Plan, StoreError> {
    one(&store.readers, PLAN, "experiment", id).await
}

pub(super) async fn rows(
    store: &SqliteStore,
    id: &ExperimentId,
    filter: &RowFilter,
) -> Result<Vec<RunRow>, StoreError> {
    let after = filter.after.map_or((-1, -1), |run| (i64::from(run.cell), i64::from(run.repetition)));
    let rows: Vec<String> = sqlx::query_scalar(ROWS)
        .bind(id.as_str())
        .bind(filter.cell)
        .bind(after.0)
        .bind(after.1)
        .bind(filter.limit.map_or(-1, i64::from))
        .fetch_all(&store.readers)
        .await
        .map_err(engine_error)?;
    rows.iter().map(|text| value("row of an experiment", text)).collect()
}

pub(super) async fn insert(
    connection: &mut SqliteConnection,
    job: &JobId,
    new: &NewExperiment,
) -> Result<(), StoreError> {
    sqlx::query(INSERT)
        .bind(new.view.id.as_str())
        .bind(job.as_str())
        .bind(new.view.created_at.0)
        .bind(json(&new.view)?)
        .bind(json(&new.plan)?)
        .execute(connection)
        .await
        .map_err(engine_error)?;
    Ok(())
}

/// Keeps finished runs of the job's experiment.
pub(super) async fn insert_rows(
    connection: &mut SqliteConnection,
    job: &str,
    rows: &[RunRow],
) -> Result<(), StoreError> {
    let experiment: Option<String> =
        sqlx::query_scalar(OF_JOB).bind(job).fetch_optional(&mut *connection).await.map_err(engine_error)?;
    let experiment =
        experiment.ok_or_else(|| StoreError::NotFound { kind: "experiment of job", id: job.to_owned() })?;
    for row in rows {
        sqlx::query(INSERT_ROW)
            .bind(&experiment)
            .bind(row.id.cell)
            .bind(row.id.repetition)
            .bind(json(row)?)
            .execute(&mut *connection)
            .await
            .map_err(engine_error)?;
    }
    let added = i64::try_from(rows.len()).unwrap_or(i64::MAX);
    sqlx::query(COUNT_ROWS).bind(&experiment).bind(added).execute(connection).await.map_err(engine_error)?;
    Ok(())
}
