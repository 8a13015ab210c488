//! Robots: kept once, never changed, deleted if no job uses them.

use super::SqliteStore;
use super::rows::{one, page, text};
use super::statements::statements;
use super::unused::{Unused, delete_unused};
use crate::app::model::{Keyset, RobotId, RobotView};
use crate::app::ports::{NewRobot, Robots, StoreError};
use crate::store::documents::{self, Robot};
use async_trait::async_trait;
use sqlx::sqlite::SqliteConnection;

statements! {
    NEXT_VERSION = "SELECT coalesce(max(version), 0) + 1 FROM robots WHERE name = ?1";
    INSERT = "INSERT INTO robots (id, name, version, created_at, view, urdf) VALUES (?1, ?2, ?3, ?4, ?5, ?6)";
    ONE = "SELECT view FROM robots WHERE id = ?1";
    URDF = "SELECT urdf FROM robots WHERE id = ?1";
    PAGE = "SELECT view FROM robots WHERE (?1 IS NULL OR id < ?1) ORDER BY id DESC LIMIT ?2";
    USES = "SELECT count(*) FROM jobs WHERE robot_id = ?1";
    DELETE = "DELETE FROM robots WHERE id = ?1";
}

#[async_trait]
impl Robots for SqliteStore {
    async fn insert_robot(&self, new: NewRobot) -> Result<RobotView, StoreError> {
        self.writer.write(move |connection| Box::pin(insert(connection, new))).await
    }

    async fn robot(&self, id: &RobotId) -> Result<RobotView, StoreError> {
        one::<Robot>(&self.readers, ONE, "robot", id.as_str()).await
    }

    async fn robot_urdf(&self, id: &RobotId) -> Result<String, StoreError> {
        text(&self.readers, URDF, "robot", id.as_str()).await
    }

    async fn robots(&self, keyset: &Keyset) -> Result<Vec<RobotView>, StoreError> {
        page::<Robot>(&self.readers, PAGE, keyset).await
    }

    async fn delete_robot(&self, id: &RobotId) -> Result<(), StoreError> {
        let unused = Unused { id: id.to_string(), kind: "robot", uses: USES, delete: DELETE };
        self.writer.write(move |connection| Box::pin(delete_unused(connection, unused))).await
    }
}

async fn insert(connection: &mut SqliteConnection, new: NewRobot) -> Result<RobotView, StoreError> {
    let NewRobot { mut view, urdf } = new;
    view.version = sqlx::query_scalar(NEXT_VERSION).bind(&view.name).fetch_one(&mut *connection).await?;
    sqlx::query(INSERT)
        .bind(view.id.as_str())
        .bind(&view.name)
        .bind(view.version)
        .bind(view.created_at.0)
        .bind(documents::write::<Robot>(view.clone())?)
        .bind(urdf)
        .execute(connection)
        .await?;
    Ok(view)
}
