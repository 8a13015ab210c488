//! `[jobs]`: concurrency, leases and checkpoints.

use super::{OutOfBounds, within};
use serde::Deserialize;

/// Settings of the job runner.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct JobsConfig {
    /// Jobs run concurrently; one per core if absent.
    pub workers: Option<usize>,
    /// Lease duration, ms: a job without a heartbeat for this long is requeued.
    pub lease_ms: u64,
    /// Heartbeat interval, ms; at most a third of the lease.
    pub heartbeat_ms: u64,
    /// Checkpoint interval, ms.
    pub checkpoint_ms: u64,
}

impl Default for JobsConfig {
    fn default() -> Self {
        Self { workers: None, lease_ms: 6000, heartbeat_ms: 2000, checkpoint_ms: 250 }
    }
}

impl JobsConfig {
    pub(super) fn check(&self) -> Result<(), OutOfBounds> {
        within("jobs.workers", self.workers.unwrap_or(1), &(1..=1024), "1 to 1024")?;
        within("jobs.lease_ms", self.lease_ms, &(500..=3_600_000), "500 to 3600000")?;
        within("jobs.heartbeat_ms", self.heartbeat_ms, &(50..=self.lease_ms / 3), "50 to a third of jobs.lease_ms")?;
        within("jobs.checkpoint_ms", self.checkpoint_ms, &(10..=60_000), "10 to 60000")
    }
}
