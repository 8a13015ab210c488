//! Opening the database: gates first, then migrations.

use super::migrations::MIGRATIONS;
use crate::app::ports::StoreError;
use sqlx::ConnectOptions as _;
use sqlx::sqlite::{SqliteConnectOptions, SqliteConnection, SqliteJournalMode, SqliteSynchronous};
use std::path::Path;
use std::time::Duration;

/// The first version without the WAL corruption that earlier ones can suffer.
const OLDEST_SQLITE: [u32; 3] = [3, 51, 3];

/// Reasons why the server does not open a database.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// The linked SQLite may corrupt a database in WAL mode.
    #[error("SQLite {found} is too old: 3.51.3 or later is needed")]
    SqliteVersion {
        /// Linked version.
        found: String,
    },
    /// A pragma did not take effect.
    #[error("pragma {name} is {found:?} but {expected:?} is needed; is the data directory on a network file system?")]
    Pragma {
        /// Pragma.
        name: &'static str,
        /// Value read back.
        found: String,
        /// Value needed.
        expected: &'static str,
    },
    /// A later version of this program wrote the database.
    #[error(
        "the database has schema {found}, this program knows {known}: start the later version, or restore a backup"
    )]
    NewerSchema {
        /// Schema of the database.
        found: i64,
        /// Schema of this program.
        known: i64,
    },
    /// A migration failed; the schema is as it was before that migration.
    #[error("a migration failed")]
    Migration(#[from] sqlx::migrate::MigrateError),
    /// The engine failed.
    #[error(transparent)]
    Store(#[from] StoreError),
}

impl From<sqlx::Error> for OpenError {
    fn from(error: sqlx::Error) -> Self {
        Self::Store(error.into())
    }
}

/// Options of the writing connection.
pub(super) fn writing(path: &Path) -> SqliteConnectOptions {
    SqliteConnectOptions::new()
        .filename(path)
        .create_if_missing(true)
        .journal_mode(SqliteJournalMode::Wal)
        .synchronous(SqliteSynchronous::Full)
        .foreign_keys(true)
        .busy_timeout(Duration::from_secs(5))
}

/// Options of the reading connections.
pub(super) fn reading(path: &Path) -> SqliteConnectOptions {
    writing(path).create_if_missing(false).pragma("query_only", "ON")
}

/// Opens the writing connection, checks the gates and brings the schema up to date.
pub(super) async fn open(path: &Path) -> Result<SqliteConnection, OpenError> {
    let mut connection = writing(path).connect().await?;
    check_version(&mut connection).await?;
    check_schema(&mut connection).await?;
    MIGRATIONS.run(&mut connection).await?;
    for (name, statement, expected) in [
        ("journal_mode", "PRAGMA journal_mode", "wal"),
        ("synchronous", "PRAGMA synchronous", "2"),
        ("foreign_keys", "PRAGMA foreign_keys", "1"),
    ] {
        let found = pragma(&mut connection, statement).await?;
        if found != expected {
            return Err(OpenError::Pragma { name, found, expected });
        }
    }
    Ok(connection)
}

async fn pragma(connection: &mut SqliteConnection, statement: &'static str) -> Result<String, StoreError> {
    use sqlx::{Row as _, ValueRef as _};
    let row = sqlx::query(statement).fetch_one(connection).await?;
    let is_text = row.try_get_raw(0)?.type_info().to_string() == "TEXT";
    if is_text {
        return Ok(row.try_get::<String, _>(0)?);
    }
    Ok(row.try_get::<i64, _>(0)?.to_string())
}

async fn check_version(connection: &mut SqliteConnection) -> Result<(), OpenError> {
    let found: String = sqlx::query_scalar("SELECT sqlite_version()").fetch_one(connection).await?;
    let parts: Vec<u32> = found.split('.').map(|part| part.parse().unwrap_or(0)).collect();
    if parts.as_slice() < OLDEST_SQLITE.as_slice() {
        return Err(OpenError::SqliteVersion { found });
    }
    Ok(())
}

async fn check_schema(connection: &mut SqliteConnection) -> Result<(), OpenError> {
    let known = MIGRATIONS.iter().map(|migration| migration.version).max().unwrap_or(0);
    let migrated: Option<i64> =
        sqlx::query_scalar("SELECT 1 FROM sqlite_schema WHERE type = 'table' AND name = '_sqlx_migrations'")
            .fetch_optional(&mut *connection)
            .await?;
    if migrated.is_none() {
        return Ok(());
    }
    let found: Option<i64> =
        sqlx::query_scalar("SELECT max(version) FROM _sqlx_migrations").fetch_one(connection).await?;
    match found {
        Some(found) if found > known => Err(OpenError::NewerSchema { found, known }),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sqlx::Connection as _;

    #[tokio::test]
    async fn a_newer_schema_is_refused_and_left_as_it_is() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("cgda.db");
        let mut connection = open(&path).await.unwrap();
        sqlx::query(
            "INSERT INTO _sqlx_migrations (version, description, success, checksum, execution_time)
             VALUES (9999, 'later', 1, x'00', 0)",
        )
        .execute(&mut connection)
        .await
        .unwrap();
        connection.close().await.unwrap();
        let before = std::fs::read(&path).unwrap();
        assert!(matches!(open(&path).await, Err(OpenError::NewerSchema { found: 9999, known: 4 })));
        assert_eq!(std::fs::read(&path).unwrap(), before);
    }
}
