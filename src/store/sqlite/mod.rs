//! SQLite: one writer with group commit, readers in a pool, in WAL mode with a full sync at each commit.

mod actions;
mod demonstrations;
mod error;
mod events;
mod experiments;
mod job_row;
mod jobs;
mod migrations;
mod open;
mod queue;
mod robots;
mod rows;
mod runs;
mod statements;
#[cfg(test)]
mod tests;
mod trials;
mod unused;
mod worlds;
mod writer;

pub use open::OpenError;

use crate::app::ports::{Store, StoreError};
use async_trait::async_trait;
use sqlx::sqlite::{SqlitePool, SqlitePoolOptions};
use std::path::Path;
use std::sync::atomic::{AtomicI64, Ordering};
use std::time::{Duration, Instant};
use writer::Writer;

/// Reading connections.
const READERS: u32 = 4;

/// The store in one SQLite file.
pub struct SqliteStore {
    writer: Writer,
    readers: SqlitePool,
    started: Instant,
    epoch: AtomicI64,
}

impl SqliteStore {
    /// Opens or creates the database in `path`.
    ///
    /// # Errors
    /// [`OpenError`] names the gate that did not open.
    pub async fn open(path: &Path) -> Result<Self, OpenError> {
        let connection = open::open(path).await?;
        let writer = Writer::start(connection, open::writing(path));
        let readers = SqlitePoolOptions::new()
            .max_connections(READERS)
            .acquire_timeout(Duration::from_secs(5))
            .connect_with(open::reading(path))
            .await?;
        Ok(Self { writer, readers, started: Instant::now(), epoch: AtomicI64::new(0) })
    }

    fn epoch(&self) -> i64 {
        self.epoch.load(Ordering::Acquire)
    }

    fn monotonic_ms(&self) -> i64 {
        i64::try_from(self.started.elapsed().as_millis()).unwrap_or(i64::MAX)
    }

    fn lease_end(&self, lease: Duration) -> i64 {
        self.monotonic_ms().saturating_add(i64::try_from(lease.as_millis()).unwrap_or(i64::MAX))
    }
}

#[async_trait]
impl Store for SqliteStore {
    async fn ping(&self) -> Result<(), StoreError> {
        sqlx::query("SELECT 1").execute(&self.readers).await?;
        Ok(())
    }
}
