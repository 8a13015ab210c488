//! Experiments: the plan, written with its job; the rows, written by [`super::queue`] with the job's progress.

use super::SqliteStore;
use super::rows::{count, found, one};
use super::statements::statements;
use crate::app::model::{ExperimentId, ExperimentView, JobId, Keyset, RowFilter};
use crate::app::ports::{Experiments, NewExperiment, StoreError};
use crate::framework::experiment::{self, RunRow};
use crate::framework::job::State;
use crate::store::documents::{self, Experiment, Plan, Row};
use async_trait::async_trait;
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

fn view((document, state, finished_runs): ViewRow) -> Result<ExperimentView, StoreError> {
    let state = State::from_name(&state)
        .ok_or_else(|| StoreError::Corrupt { what: "state of an experiment's job".to_owned(), cause: state.clone() })?;
    Ok(documents::read::<Experiment>("a list", &document)?.shown(state, count(finished_runs)))
}

#[async_trait]
impl Experiments for SqliteStore {
    async fn experiment(&self, id: &ExperimentId) -> Result<ExperimentView, StoreError> {
        let row: Option<ViewRow> = sqlx::query_as(ONE).bind(id.as_str()).fetch_optional(&self.readers).await?;
        view(found(row, "experiment", id.as_str())?)
    }

    async fn experiments(&self, keyset: &Keyset) -> Result<Vec<ExperimentView>, StoreError> {
        let rows: Vec<ViewRow> = sqlx::query_as(PAGE)
            .bind(keyset.before_id.as_deref())
            .bind(i64::from(keyset.limit) + 1)
            .fetch_all(&self.readers)
            .await?;
        rows.into_iter().map(view).collect()
    }

    async fn experiment_plan(&self, id: &ExperimentId) -> Result<experiment::Plan, StoreError> {
        one::<Plan>(&self.readers, PLAN, "experiment", id.as_str()).await
    }

    async fn experiment_rows(&self, id: &ExperimentId, filter: &RowFilter) -> Result<Vec<RunRow>, StoreError> {
        let after = filter.after.map_or((-1, -1), |run| (i64::from(run.cell), i64::from(run.repetition)));
        let rows: Vec<String> = sqlx::query_scalar(ROWS)
            .bind(id.as_str())
            .bind(filter.cell)
            .bind(after.0)
            .bind(after.1)
            .bind(filter.limit.map_or(-1, i64::from))
            .fetch_all(&self.readers)
            .await?;
        rows.iter().map(|text| documents::read::<Row>(id.as_str(), text)).collect()
    }
}

/// Keeps the experiment that a job runs.
pub(super) async fn insert(
    connection: &mut SqliteConnection,
    job: &JobId,
    new: NewExperiment,
) -> Result<(), StoreError> {
    let NewExperiment { view, plan } = new;
    sqlx::query(INSERT)
        .bind(view.id.as_str())
        .bind(job.as_str())
        .bind(view.created_at.0)
        .bind(documents::write::<Experiment>(view.clone())?)
        .bind(documents::write::<Plan>(plan)?)
        .execute(connection)
        .await?;
    Ok(())
}

/// Keeps finished runs of the job's experiment.
pub(super) async fn insert_rows(
    connection: &mut SqliteConnection,
    job: &JobId,
    rows: Vec<RunRow>,
) -> Result<(), StoreError> {
    let of_job: Option<String> = sqlx::query_scalar(OF_JOB).bind(job.as_str()).fetch_optional(&mut *connection).await?;
    let experiment = found(of_job, "experiment of job", job.as_str())?;
    let added = i64::try_from(rows.len()).unwrap_or(i64::MAX);
    for row in rows {
        sqlx::query(INSERT_ROW)
            .bind(&experiment)
            .bind(row.id.cell)
            .bind(row.id.repetition)
            .bind(documents::write::<Row>(row)?)
            .execute(&mut *connection)
            .await?;
    }
    sqlx::query(COUNT_ROWS).bind(&experiment).bind(added).execute(connection).await?;
    Ok(())
}
