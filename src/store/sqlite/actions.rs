//! Actions: written by [`super::queue`] together with the job that made them, read here.

use super::SqliteStore;
use super::rows::{one, page};
use super::statements::statements;
use crate::app::model::{ActionGoals, ActionId, ActionView, Keyset};
use crate::app::ports::{Actions, StoreError};
use crate::store::documents::{self, Action, GoalMatrix};
use async_trait::async_trait;
use sqlx::sqlite::SqliteConnection;

statements! {
    ONE = "SELECT view FROM actions WHERE id = ?1";
    GOALS = "SELECT goals FROM actions WHERE id = ?1";
    PAGE = "SELECT view FROM actions WHERE (?1 IS NULL OR id < ?1) ORDER BY id DESC LIMIT ?2";
    NEXT_VERSION = "SELECT coalesce(max(version), 0) + 1 FROM actions WHERE name = ?1";
    INSERT = "INSERT INTO actions (id, name, version, job_id, created_at, view, goals)
        VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)";
}

#[async_trait]
impl Actions for SqliteStore {
    async fn action(&self, id: &ActionId) -> Result<ActionView, StoreError> {
        one::<Action>(&self.readers, ONE, "action", id.as_str()).await
    }

    async fn action_goals(&self, id: &ActionId) -> Result<ActionGoals, StoreError> {
        one::<GoalMatrix>(&self.readers, GOALS, "action", id.as_str()).await
    }

    async fn actions(&self, keyset: &Keyset) -> Result<Vec<ActionView>, StoreError> {
        page::<Action>(&self.readers, PAGE, keyset).await
    }
}

/// Keeps an action as the next version of its name.
pub(super) async fn insert(
    connection: &mut SqliteConnection,
    mut view: ActionView,
    goals: ActionGoals,
) -> Result<(), StoreError> {
    view.version = sqlx::query_scalar(NEXT_VERSION).bind(&view.name).fetch_one(&mut *connection).await?;
    sqlx::query(INSERT)
        .bind(view.id.as_str())
        .bind(&view.name)
        .bind(view.version)
        .bind(view.job.as_str())
        .bind(view.created_at.0)
        .bind(documents::write::<Action>(view.clone())?)
        .bind(documents::write::<GoalMatrix>(goals)?)
        .execute(connection)
        .await?;
    Ok(())
}
