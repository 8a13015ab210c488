//! Demonstrations and their samples.

use super::SqliteStore;
use super::rows::{checked, digest, found, number, one, page};
use super::statements::statements;
use crate::app::model::{DemonstrationId, DemonstrationReport, DemonstrationView, Keyset, PatchDemonstration};
use crate::app::ports::rules::check_revision;
use crate::app::ports::{Demonstrations, NewDemonstration, StoreError};
use crate::store::documents::{self, Demonstration, Report};
use async_trait::async_trait;
use sqlx::sqlite::SqliteConnection;

statements! {
    INSERT = "INSERT INTO demonstrations (id, name, revision, excluded, sha256, created_at, view, report)
        VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)";
    INSERT_SAMPLES = "INSERT INTO demonstration_samples (demonstration_id, sha256, data) VALUES (?1, ?2, ?3)";
    ONE = "SELECT view FROM demonstrations WHERE id = ?1";
    REPORT = "SELECT report FROM demonstrations WHERE id = ?1";
    SAMPLES = "SELECT sha256, data FROM demonstration_samples WHERE demonstration_id = ?1";
    PAGE = "SELECT view FROM demonstrations WHERE (?1 IS NULL OR id < ?1) ORDER BY id DESC LIMIT ?2";
    WITH_CONTENT = "SELECT view FROM demonstrations WHERE sha256 = ?1 ORDER BY id";
    UPDATE = "UPDATE demonstrations SET name = ?2, revision = ?3, excluded = ?4, view = ?5 WHERE id = ?1";
    DELETE = "DELETE FROM demonstrations WHERE id = ?1";
}

#[async_trait]
impl Demonstrations for SqliteStore {
    async fn insert_demonstration(&self, new: NewDemonstration) -> Result<(), StoreError> {
        self.writer.write(move |connection| Box::pin(insert(connection, new))).await
    }

    async fn demonstration(&self, id: &DemonstrationId) -> Result<DemonstrationView, StoreError> {
        one::<Demonstration>(&self.readers, ONE, "demonstration", id.as_str()).await
    }

    async fn demonstration_report(&self, id: &DemonstrationId) -> Result<DemonstrationReport, StoreError> {
        one::<Report>(&self.readers, REPORT, "demonstration", id.as_str()).await
    }

    async fn demonstration_samples(&self, id: &DemonstrationId) -> Result<Vec<u8>, StoreError> {
        let row: Option<(String, Vec<u8>)> =
            sqlx::query_as(SAMPLES).bind(id.as_str()).fetch_optional(&self.readers).await?;
        let (sha256, data) = found(row, "demonstration", id.as_str())?;
        checked(id.as_str(), &sha256, data)
    }

    async fn demonstrations(&self, keyset: &Keyset) -> Result<Vec<DemonstrationView>, StoreError> {
        page::<Demonstration>(&self.readers, PAGE, keyset).await
    }

    async fn demonstrations_with_content(&self, sha256: &str) -> Result<Vec<DemonstrationId>, StoreError> {
        let rows: Vec<String> = sqlx::query_scalar(WITH_CONTENT).bind(sha256).fetch_all(&self.readers).await?;
        rows.iter().map(|text| documents::read::<Demonstration>("a list", text).map(|view| view.id)).collect()
    }

    async fn patch_demonstration(
        &self,
        id: &DemonstrationId,
        change: PatchDemonstration,
        if_match: Option<u64>,
    ) -> Result<DemonstrationView, StoreError> {
        let id = id.clone();
        self.writer.write(move |connection| Box::pin(patch(connection, id, change, if_match))).await
    }

    async fn delete_demonstration(&self, id: &DemonstrationId, if_match: Option<u64>) -> Result<(), StoreError> {
        let id = id.clone();
        self.writer.write(move |connection| Box::pin(delete(connection, id, if_match))).await
    }
}

async fn insert(connection: &mut SqliteConnection, new: NewDemonstration) -> Result<(), StoreError> {
    let NewDemonstration { view, report, samples } = new;
    sqlx::query(INSERT)
        .bind(view.id.as_str())
        .bind(&view.name)
        .bind(number(view.revision)?)
        .bind(&view.excluded)
        .bind(&view.sha256)
        .bind(view.created_at.0)
        .bind(documents::write::<Demonstration>(view.clone())?)
        .bind(documents::write::<Report>(report)?)
        .execute(&mut *connection)
        .await?;
    sqlx::query(INSERT_SAMPLES).bind(view.id.as_str()).bind(digest(&samples)).bind(samples).execute(connection).await?;
    Ok(())
}

async fn patch(
    connection: &mut SqliteConnection,
    id: DemonstrationId,
    change: PatchDemonstration,
    if_match: Option<u64>,
) -> Result<DemonstrationView, StoreError> {
    let view = matching(connection, &id, if_match).await?.patched(change);
    sqlx::query(UPDATE)
        .bind(id.as_str())
        .bind(&view.name)
        .bind(number(view.revision)?)
        .bind(&view.excluded)
        .bind(documents::write::<Demonstration>(view.clone())?)
        .execute(connection)
        .await?;
    Ok(view)
}

async fn delete(
    connection: &mut SqliteConnection,
    id: DemonstrationId,
    if_match: Option<u64>,
) -> Result<(), StoreError> {
    matching(connection, &id, if_match).await?;
    sqlx::query(DELETE).bind(id.as_str()).execute(connection).await?;
    Ok(())
}

/// The demonstration, if it has the revision named.
async fn matching(
    connection: &mut SqliteConnection,
    id: &DemonstrationId,
    if_match: Option<u64>,
) -> Result<DemonstrationView, StoreError> {
    let row: Option<String> = sqlx::query_scalar(ONE).bind(id.as_str()).fetch_optional(connection).await?;
    let view = documents::read::<Demonstration>(id.as_str(), &found(row, "demonstration", id.as_str())?)?;
    check_revision(&view, if_match)?;
    Ok(view)
}
