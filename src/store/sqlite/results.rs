//! What jobs made: actions, runs, trajectories. Written by [`super::claims`] together with the job, read here.

use super::rows::{json, number, one, page, value};
use super::statements::statements;
use super::{SqliteStore, engine_error};
use crate::app::model::{
    ActionGoals, ActionView, ConvergencePoint, Keyset, RunFilter, RunGoals, RunView, TrajectoryView,
};
use crate::app::ports::{NewRun, StoreError};
use sqlx::sqlite::SqliteConnection;

statements! {
    ACTION = "SELECT view FROM actions WHERE id = ?1";
    ACTION_GOALS = "SELECT goals FROM actions WHERE id = ?1";
    ACTIONS = "SELECT view FROM actions WHERE (?1 IS NULL OR id < ?1) ORDER BY id DESC LIMIT ?2";
    NEXT_VERSION = "SELECT coalesce(max(version), 0) + 1 FROM actions WHERE name = ?1";
    INSERT_ACTION = "INSERT INTO actions (id, name, version, job_id, created_at, view, goals)
        VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)";
    RUN = "SELECT view FROM runs WHERE id = ?1";
    RUN_GOALS = "SELECT goals FROM run_goals WHERE run_id = ?1";
    RUN_CONVERGENCE = "SELECT convergence FROM run_goals WHERE run_id = ?1";
    RUNS = "SELECT view FROM runs WHERE (?1 IS NULL OR id < ?1) AND (?3 IS NULL OR job_id = ?3)
        ORDER BY id DESC LIMIT ?2";
    INSERT_RUN = "INSERT INTO runs
        (id, job_id, repetition, seed, evaluations, discrepancy, digest, created_at, view)
        VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9)";
    INSERT_RUN_GOALS = "INSERT INTO run_goals (run_id, goals, convergence) VALUES (?1, ?2, ?3)";
    TRAJECTORY = "SELECT view FROM trajectories WHERE id = ?1";
    INSERT_TRAJECTORY = "INSERT INTO trajectories (id, run_id, created_at, view) VALUES (?1, ?2, ?3, ?4)";
}

pub(super) async fn action(store: &SqliteStore, id: &str) -> Result<ActionView, StoreError> {
    one(&store.readers, ACTION, "action", id).await
}

pub(super) async fn action_goals(store: &SqliteStore, id: &str) -> Result<ActionGoals, StoreError> {
    one(&store.readers, ACTION_GOALS, "action", id).await
}

pub(super) async fn actions(store: &SqliteStore, keyset: &Keyset) -> Result<Vec<ActionView>, StoreError> {
    page(&store.readers, ACTIONS, keyset).await
}

pub(super) async fn insert_action(
    connection: &mut SqliteConnection,
    mut view: ActionView,
    goals: &ActionGoals,
) -> Result<(), StoreError> {
    view.version =
        sqlx::query_scalar(NEXT_VERSION).bind(&view.name).fetch_one(&mut *connection).await.map_err(engine_error)?;
    sqlx::query(INSERT_ACTION)
        .bind(view.id.as_str())
        .bind(&view.name)
        .bind(view.version)
        .bind(view.job.as_str())
        .bind(view.created_at.0)
        .bind(json(&view)?)
        .bind(json(goals)?)
        .execute(connection)
        .await
        .map_err(engine_error)?;
    Ok(())
}

pub(super) async fn run(store: &SqliteStore, id: &str) -> Result<RunView, StoreError> {
    one(&store.readers, RUN, "run", id).await
}

pub(super) async fn run_goals(store: &SqliteStore, id: &str) -> Result<RunGoals, StoreError> {
    one(&store.readers, RUN_GOALS, "run", id).await
}

pub(super) async fn run_convergence(store: &SqliteStore, id: &str) -> Result<Vec<ConvergencePoint>, StoreError> {
    one(&store.readers, RUN_CONVERGENCE, "run", id).await
}

pub(super) async fn runs(store: &SqliteStore, filter: &RunFilter, keyset: &Keyset) -> Result<Vec<RunView>, StoreError> {
    let rows: Vec<String> = sqlx::query_scalar(RUNS)
        .bind(keyset.before_id.as_deref())
        .bind(i64::from(keyset.limit) + 1)
        .bind(filter.job.as_ref().map(|job| job.as_str().to_owned()))
        .fetch_all(&store.readers)
        .await
        .map_err(engine_error)?;
    rows.iter().map(|text| value("run", text)).collect()
}

pub(super) async fn insert_run(connection: &mut SqliteConnection, new: &NewRun) -> Result<(), StoreError> {
    let view = &new.view;
    sqlx::query(INSERT_RUN)
        .bind(view.id.as_str())
        .bind(view.job.as_str())
        .bind(view.repetition)
        .bind(number(view.seed)?)
        .bind(number(view.evaluations)?)
        .bind(view.discrepancy)
        .bind(&view.digest)
        .bind(view.created_at.0)
        .bind(json(view)?)
        .execute(&mut *connection)
        .await
        .map_err(engine_error)?;
    sqlx::query(INSERT_RUN_GOALS)
        .bind(view.id.as_str())
        .bind(json(&new.goals)?)
        .bind(json(&new.convergence)?)
        .execute(&mut *connection)
        .await
        .map_err(engine_error)?;
    super::trials::insert(connection, new).await?;
    if let Some(trajectory) = &new.trajectory {
        sqlx::query(INSERT_TRAJECTORY)
            .bind(trajectory.id.as_str())
            .bind(view.id.as_str())
            .bind(trajectory.created_at.0)
            .bind(json(trajectory)?)
            .execute(connection)
            .await
            .map_err(engine_error)?;
    }
    Ok(())
}

pub(super) async fn trajectory(store: &SqliteStore, id: &str) -> Result<TrajectoryView, StoreError> {
    one(&store.readers, TRAJECTORY, "trajectory", id).await
}
