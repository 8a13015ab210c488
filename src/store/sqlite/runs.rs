//! Runs and their trajectories: written by [`super::queue`] together with the job that made them, read here.

use super::rows::{number, one};
use super::statements::statements;
use super::{SqliteStore, trials};
use crate::app::model::{ConvergencePoint, Keyset, RunFilter, RunGoals, RunId, RunView, TrajectoryId, TrajectoryView};
use crate::app::ports::{KeptTrials, NewRun, Runs, StoreError};
use crate::framework::method::whole_run::Trial;
use crate::store::documents::{self, Convergence, Run, Trajectory, Trials};
use async_trait::async_trait;
use sqlx::sqlite::SqliteConnection;

statements! {
    ONE = "SELECT view FROM runs WHERE id = ?1";
    GOALS = "SELECT goals FROM run_goals WHERE run_id = ?1";
    CONVERGENCE = "SELECT convergence FROM run_goals WHERE run_id = ?1";
    ON_SETTING = "SELECT runs.view, run_trials.trials FROM run_trials JOIN runs ON runs.id = run_trials.run_id
        WHERE setting = ?1 ORDER BY run_id DESC LIMIT ?2";
    PAGE = "SELECT view FROM runs WHERE (?1 IS NULL OR id < ?1) AND (?3 IS NULL OR job_id = ?3)
        ORDER BY id DESC LIMIT ?2";
    INSERT = "INSERT INTO runs
        (id, job_id, repetition, seed, evaluations, discrepancy, digest, created_at, view)
        VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9)";
    INSERT_GOALS = "INSERT INTO run_goals (run_id, goals, convergence) VALUES (?1, ?2, ?3)";
    TRAJECTORY = "SELECT view FROM trajectories WHERE id = ?1";
    INSERT_TRAJECTORY = "INSERT INTO trajectories (id, run_id, created_at, view) VALUES (?1, ?2, ?3, ?4)";
}

#[async_trait]
impl Runs for SqliteStore {
    async fn run(&self, id: &RunId) -> Result<RunView, StoreError> {
        one::<Run>(&self.readers, ONE, "run", id.as_str()).await
    }

    async fn run_goals(&self, id: &RunId) -> Result<RunGoals, StoreError> {
        one::<documents::RunGoals>(&self.readers, GOALS, "run", id.as_str()).await
    }

    async fn run_convergence(&self, id: &RunId) -> Result<Vec<ConvergencePoint>, StoreError> {
        one::<Convergence>(&self.readers, CONVERGENCE, "run", id.as_str()).await
    }

    async fn run_trials(&self, id: &RunId) -> Result<KeptTrials, StoreError> {
        trials::of_run(&self.readers, id).await
    }

    async fn runs_on(&self, setup_key: &str, limit: u32) -> Result<Vec<(RunView, Vec<Trial>)>, StoreError> {
        let rows: Vec<(String, String)> =
            sqlx::query_as(ON_SETTING).bind(setup_key).bind(limit).fetch_all(&self.readers).await?;
        let read = |(run, trials): &(String, String)| {
            Ok((documents::read::<Run>("a list", run)?, documents::read::<Trials>("a list", trials)?))
        };
        rows.iter().map(read).collect()
    }

    async fn runs(&self, filter: &RunFilter, keyset: &Keyset) -> Result<Vec<RunView>, StoreError> {
        let rows: Vec<String> = sqlx::query_scalar(PAGE)
            .bind(keyset.before_id.as_deref())
            .bind(i64::from(keyset.limit) + 1)
            .bind(filter.job.as_ref().map(|job| job.as_str().to_owned()))
            .fetch_all(&self.readers)
            .await?;
        rows.iter().map(|text| documents::read::<Run>("a list", text)).collect()
    }

    async fn trajectory(&self, id: &TrajectoryId) -> Result<TrajectoryView, StoreError> {
        one::<Trajectory>(&self.readers, TRAJECTORY, "trajectory", id.as_str()).await
    }
}

/// Keeps a run with all that belongs to it.
pub(super) async fn insert(connection: &mut SqliteConnection, new: NewRun) -> Result<(), StoreError> {
    let NewRun { view, goals, convergence, trajectory, trials } = new;
    sqlx::query(INSERT)
        .bind(view.id.as_str())
        .bind(view.job.as_str())
        .bind(view.repetition)
        .bind(number(view.seed)?)
        .bind(number(view.evaluations)?)
        .bind(view.discrepancy)
        .bind(&view.digest)
        .bind(view.created_at.0)
        .bind(documents::write::<Run>(view.clone())?)
        .execute(&mut *connection)
        .await?;
    sqlx::query(INSERT_GOALS)
        .bind(view.id.as_str())
        .bind(documents::write::<documents::RunGoals>(goals)?)
        .bind(documents::write::<Convergence>(convergence)?)
        .execute(&mut *connection)
        .await?;
    trials::insert(&mut *connection, &view.id, trials).await?;
    if let Some(trajectory) = trajectory {
        sqlx::query(INSERT_TRAJECTORY)
            .bind(trajectory.id.as_str())
            .bind(view.id.as_str())
            .bind(trajectory.created_at.0)
            .bind(documents::write::<Trajectory>(trajectory.clone())?)
            .execute(connection)
            .await?;
    }
    Ok(())
}
