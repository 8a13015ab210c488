//! Worlds: kept once, never changed, deleted if no job uses them.

use super::SqliteStore;
use super::rows::{one, page};
use super::statements::statements;
use super::unused::{Unused, delete_unused};
use crate::app::model::{Keyset, WorldId, WorldView};
use crate::app::ports::{StoreError, Worlds};
use crate::store::documents::{self, World};
use async_trait::async_trait;
use sqlx::sqlite::SqliteConnection;

statements! {
    INSERT = "INSERT INTO worlds (id, name, created_at, view) VALUES (?1, ?2, ?3, ?4)";
    ONE = "SELECT view FROM worlds WHERE id = ?1";
    PAGE = "SELECT view FROM worlds WHERE (?1 IS NULL OR id < ?1) ORDER BY id DESC LIMIT ?2";
    USES = "SELECT count(*) FROM jobs WHERE world_id = ?1";
    DELETE = "DELETE FROM worlds WHERE id = ?1";
}

#[async_trait]
impl Worlds for SqliteStore {
    async fn insert_world(&self, new: WorldView) -> Result<(), StoreError> {
        self.writer.write(move |connection| Box::pin(insert(connection, new))).await
    }

    async fn world(&self, id: &WorldId) -> Result<WorldView, StoreError> {
        one::<World>(&self.readers, ONE, "world", id.as_str()).await
    }

    async fn worlds(&self, keyset: &Keyset) -> Result<Vec<WorldView>, StoreError> {
        page::<World>(&self.readers, PAGE, keyset).await
    }

    async fn delete_world(&self, id: &WorldId) -> Result<(), StoreError> {
        let unused = Unused { id: id.to_string(), kind: "world", uses: USES, delete: DELETE };
        self.writer.write(move |connection| Box::pin(delete_unused(connection, unused))).await
    }
}

async fn insert(connection: &mut SqliteConnection, view: WorldView) -> Result<(), StoreError> {
    sqlx::query(INSERT)
        .bind(view.id.as_str())
        .bind(&view.name)
        .bind(view.created_at.0)
        .bind(documents::write::<World>(view.clone())?)
        .execute(connection)
        .await?;
    Ok(())
}
