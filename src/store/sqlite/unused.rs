//! Deletes resources that no job uses.

use super::rows::count;
use crate::app::ports::StoreError;
use sqlx::sqlite::SqliteConnection;

/// A row to delete unless a job uses it.
pub(super) struct Unused {
    pub id: String,
    /// The resource, for errors.
    pub kind: &'static str,
    /// Counts the jobs that use the id.
    pub uses: &'static str,
    /// Deletes the row of the id.
    pub delete: &'static str,
}

/// Deletes the row.
///
/// # Errors
/// `InUse`; `NotFound`.
pub(super) async fn delete_unused(connection: &mut SqliteConnection, row: Unused) -> Result<(), StoreError> {
    let Unused { id, kind, uses, delete } = row;
    let used: i64 = sqlx::query_scalar(uses).bind(&id).fetch_one(&mut *connection).await?;
    if used > 0 {
        return Err(StoreError::InUse { id, count: count(used) });
    }
    let done = sqlx::query(delete).bind(&id).execute(connection).await?;
    if done.rows_affected() == 0 {
        return Err(StoreError::NotFound { kind, id });
    }
    Ok(())
}
