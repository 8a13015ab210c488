//! Demonstrations and their samples.

use super::rows::{checked, digest, json, number, one, page, value};
use super::statements::statements;
use super::{SqliteStore, engine_error};
use crate::app::model::{DemonstrationId, DemonstrationReport, DemonstrationView, Keyset, PatchDemonstration};
use crate::app::ports::{NewDemonstration, StoreError};
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

pub(super) async fn insert(store: &SqliteStore, new: NewDemonstration) -> Result<(), StoreError> {
    let (view, report) = (json(&new.view)?, json(&new.report)?);
    let revision = number(new.view.revision)?;
    let sha256 = digest(&new.samples);
    store
        .writer
        .write(move |connection| {
            Box::pin(async move {
                let id = new.view.id.as_str();
                sqlx::query(INSERT)
                    .bind(id)
                    .bind(&new.view.name)
                    .bind(revision)
                    .bind(&new.view.excluded)
                    .bind(&new.view.sha256)
                    .bind(new.view.created_at.0)
                    .bind(view)
                    .bind(report)
                    .execute(&mut *connection)
                    .await
                    .map_err(engine_error)?;
                sqlx::query(INSERT_SAMPLES)
                    .bind(id)
                    .bind(sha256)
                    .bind(new.samples)
                    .execute(connection)
                    .await
                    .map_err(engine_error)?;
                Ok(())
            })
        })
        .await
}

pub(super) async fn get(store: &SqliteStore, id: &str) -> Result<DemonstrationView, StoreError> {
    one(&store.readers, ONE, "demonstration", id).await
}

pub(super) async fn report(store: &SqliteStore, id: &str) -> Result<DemonstrationReport, StoreError> {
    one(&store.readers, REPORT, "demonstration", id).await
}

pub(super) async fn samples(store: &SqliteStore, id: &str) -> Result<Vec<u8>, StoreError> {
    let row: Option<(String, Vec<u8>)> =
        sqlx::query_as(SAMPLES).bind(id).fetch_optional(&store.readers).await.map_err(engine_error)?;
    let (sha256, data) = row.ok_or_else(|| StoreError::NotFound { kind: "demonstration", id: id.to_owned() })?;
    checked(id, &sha256, data)
}

pub(super) async fn list(store: &SqliteStore, keyset: &Keyset) -> Result<Vec<DemonstrationView>, StoreError> {
    page(&store.readers, PAGE, keyset).await
}

pub(super) async fn with_content(store: &SqliteStore, sha256: &str) -> Result<Vec<DemonstrationId>, StoreError> {
    let rows: Vec<String> =
        sqlx::query_scalar(WITH_CONTENT).bind(sha256).fetch_all(&store.readers).await.map_err(engine_error)?;
    rows.iter().map(|text| value::<DemonstrationView>("demonstration", text).map(|view| view.id)).collect()
}

pub(super) async fn patch(
    store: &SqliteStore,
    id: String,
    patch: PatchDemonstration,
    if_match: Option<u64>,
) -> Result<DemonstrationView, StoreError> {
    store
        .writer
        .write(move |connection| {
            Box::pin(async move {
                let mut view = matching(connection, &id, if_match).await?;
                if let Some(name) = patch.name {
                    view.name = name;
                }
                if let Some(reason) = patch.excluded {
                    view.excluded = Some(reason).filter(|reason| !reason.is_empty());
                }
                view.revision += 1;
                sqlx::query(UPDATE)
                    .bind(&id)
                    .bind(&view.name)
                    .bind(number(view.revision)?)
                    .bind(&view.excluded)
                    .bind(json(&view)?)
                    .execute(connection)
                    .await
                    .map_err(engine_error)?;
                Ok(view)
            })
        })
        .await
}

pub(super) async fn delete(store: &SqliteStore, id: String, if_match: Option<u64>) -> Result<(), StoreError> {
    store
        .writer
        .write(move |connection| {
            Box::pin(async move {
                matching(connection, &id, if_match).await?;
                sqlx::query(DELETE).bind(id).execute(connection).await.map_err(engine_error)?;
                Ok(())
            })
        })
        .await
}

async fn matching(
    connection: &mut SqliteConnection,
    id: &str,
    if_match: Option<u64>,
) -> Result<DemonstrationView, StoreError> {
    let row: Option<String> =
        sqlx::query_scalar(ONE).bind(id).fetch_optional(connection).await.map_err(engine_error)?;
    let text = row.ok_or_else(|| StoreError::NotFound { kind: "demonstration", id: id.to_owned() })?;
    let view: DemonstrationView = value(id, &text)?;
    match if_match {
        Some(expected) if expected != view.revision => {
            Err(StoreError::Revision { id: id.to_owned(), present: view.revision, expected })
        }
        _ => Ok(view),
    }
}
