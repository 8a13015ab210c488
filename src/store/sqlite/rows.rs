//! Reads rows: the contents of documents, one at a time or by page.

use crate::app::model::Keyset;
use crate::app::ports::StoreError;
use crate::store::documents::{self, Document};
use serde::Serialize;
use serde::de::DeserializeOwned;
use sha2::{Digest, Sha256};
use sqlx::sqlite::SqlitePool;

/// JSON of a parameter.
pub(super) fn json<T: Serialize>(value: &T) -> Result<String, StoreError> {
    serde_json::to_string(value)
        .map_err(|error| StoreError::Corrupt { what: "parameter".to_owned(), cause: error.to_string() })
}

/// The value of JSON that a statement returned.
pub(super) fn value<T: DeserializeOwned>(what: &str, text: &str) -> Result<T, StoreError> {
    serde_json::from_str(text).map_err(|error| StoreError::Corrupt { what: what.to_owned(), cause: error.to_string() })
}

/// SHA-256 of stored bytes, hexadecimal.
pub(super) fn digest(bytes: &[u8]) -> String {
    hex::encode(Sha256::digest(bytes))
}

/// Bytes that still have the digest stored with them.
pub(super) fn checked(what: &str, sha256: &str, bytes: Vec<u8>) -> Result<Vec<u8>, StoreError> {
    let found = digest(&bytes);
    if found == sha256 {
        return Ok(bytes);
    }
    Err(StoreError::Corrupt { what: what.to_owned(), cause: format!("SHA-256 is {found}, not {sha256}") })
}

/// A number of the service as SQLite keeps it.
pub(super) fn number(value: u64) -> Result<i64, StoreError> {
    i64::try_from(value)
        .map_err(|_| StoreError::Corrupt { what: "number to be stored".to_owned(), cause: format!("{value} > 2^63") })
}

/// A count, which is never negative in the store.
pub(super) fn count(value: i64) -> u64 {
    u64::try_from(value).unwrap_or(0)
}

/// The row found, or `NotFound`.
pub(super) fn found<T>(row: Option<T>, kind: &'static str, id: &str) -> Result<T, StoreError> {
    row.ok_or_else(|| StoreError::NotFound { kind, id: id.to_owned() })
}

/// The first column of the one row that `statement` finds by `id`.
pub(super) async fn text(
    pool: &SqlitePool,
    statement: &'static str,
    kind: &'static str,
    id: &str,
) -> Result<String, StoreError> {
    found(sqlx::query_scalar(statement).bind(id).fetch_optional(pool).await?, kind, id)
}

/// The document in the first column of the one row that `statement` finds by `id`.
pub(super) async fn one<D: Document>(
    pool: &SqlitePool,
    statement: &'static str,
    kind: &'static str,
    id: &str,
) -> Result<D::Content, StoreError> {
    documents::read::<D>(id, &text(pool, statement, kind, id).await?)
}

/// The documents of a page; `statement` takes the id to start before and the limit.
pub(super) async fn page<D: Document>(
    pool: &SqlitePool,
    statement: &'static str,
    keyset: &Keyset,
) -> Result<Vec<D::Content>, StoreError> {
    let rows: Vec<String> = sqlx::query_scalar(statement)
        .bind(keyset.before_id.as_deref())
        .bind(i64::from(keyset.limit) + 1)
        .fetch_all(pool)
        .await?;
    rows.iter().map(|text| documents::read::<D>("a list", text)).collect()
}
