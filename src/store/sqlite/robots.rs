//! Robots and worlds: kept once, never changed, deleted when no job names them.

use super::rows::{count, json, one, page, text};
use super::statements::statements;
use super::{SqliteStore, engine_error};
use crate::app::model::{Keyset, RobotView, WorldView};
use crate::app::ports::{NewRobot, StoreError};

statements! {
    NEXT_VERSION = "SELECT coalesce(max(version), 0) + 1 FROM robots WHERE name = ?1";
    INSERT = "INSERT INTO robots (id, name, version, created_at, view, urdf) VALUES (?1, ?2, ?3, ?4, ?5, ?6)";
    ONE = "SELECT view FROM robots WHERE id = ?1";
    URDF = "SELECT urdf FROM robots WHERE id = ?1";
    PAGE = "SELECT view FROM robots WHERE (?1 IS NULL OR id < ?1) ORDER BY id DESC LIMIT ?2";
    USES = "SELECT count(*) FROM jobs WHERE robot_id = ?1";
    DELETE = "DELETE FROM robots WHERE id = ?1";
    INSERT_WORLD = "INSERT INTO worlds (id, name, created_at, view) VALUES (?1, ?2, ?3, ?4)";
    ONE_WORLD = "SELECT view FROM worlds WHERE id = ?1";
    PAGE_WORLDS = "SELECT view FROM worlds WHERE (?1 IS NULL OR id < ?1) ORDER BY id DESC LIMIT ?2";
    USES_WORLD = "SELECT count(*) FROM jobs WHERE world_id = ?1";
    DELETE_WORLD = "DELETE FROM worlds WHERE id = ?1";
}

pub(super) async fn insert(store: &SqliteStore, new: NewRobot) -> Result<RobotView, StoreError> {
    store
        .writer
        .write(move |connection| {
            Box::pin(async move {
                let NewRobot { mut view, urdf } = new;
                view.version = sqlx::query_scalar(NEXT_VERSION)
                    .bind(&view.name)
                    .fetch_one(&mut *connection)
                    .await
                    .map_err(engine_error)?;
                sqlx::query(INSERT)
                    .bind(view.id.as_str())
                    .bind(&view.name)
                    .bind(view.version)
                    .bind(view.created_at.0)
                    .bind(json(&view)?)
                    .bind(urdf)
                    .execute(connection)
                    .await
                    .map_err(engine_error)?;
                Ok(view)
            })
        })
        .await
}

pub(super) async fn get(store: &SqliteStore, id: &str) -> Result<RobotView, StoreError> {
    one(&store.readers, ONE, "robot", id).await
}

pub(super) async fn urdf(store: &SqliteStore, id: &str) -> Result<String, StoreError> {
    text(&store.readers, URDF, "robot", id).await
}

pub(super) async fn list(store: &SqliteStore, keyset: &Keyset) -> Result<Vec<RobotView>, StoreError> {
    page(&store.readers, PAGE, keyset).await
}

pub(super) async fn delete(store: &SqliteStore, id: String) -> Result<(), StoreError> {
    delete_unused(store, id, "robot", USES, DELETE).await
}

pub(super) async fn insert_world(store: &SqliteStore, view: WorldView) -> Result<(), StoreError> {
    store
        .writer
        .write(move |connection| {
            Box::pin(async move {
                sqlx::query(INSERT_WORLD)
                    .bind(view.id.as_str())
                    .bind(&view.name)
                    .bind(view.created_at.0)
                    .bind(json(&view)?)
                    .execute(connection)
                    .await
                    .map_err(engine_error)?;
                Ok(())
            })
        })
        .await
}

pub(super) async fn world(store: &SqliteStore, id: &str) -> Result<WorldView, StoreError> {
    one(&store.readers, ONE_WORLD, "world", id).await
}

pub(super) async fn worlds(store: &SqliteStore, keyset: &Keyset) -> Result<Vec<WorldView>, StoreError> {
    page(&store.readers, PAGE_WORLDS, keyset).await
}

pub(super) async fn delete_world(store: &SqliteStore, id: String) -> Result<(), StoreError> {
    delete_unused(store, id, "world", USES_WORLD, DELETE_WORLD).await
}

async fn delete_unused(
    store: &SqliteStore,
    id: String,
    kind: &'static str,
    uses: &'static str,
    delete: &'static str,
) -> Result<(), StoreError> {
    store
        .writer
        .write(move |connection| {
            Box::pin(async move {
                let used: i64 =
                    sqlx::query_scalar(uses).bind(&id).fetch_one(&mut *connection).await.map_err(engine_error)?;
                if used > 0 {
                    return Err(StoreError::InUse { id, count: count(used) });
                }
                let done = sqlx::query(delete).bind(&id).execute(connection).await.map_err(engine_error)?;
                if done.rows_affected() == 0 {
                    return Err(StoreError::NotFound { kind, id });
                }
                Ok(())
            })
        })
        .await
}
