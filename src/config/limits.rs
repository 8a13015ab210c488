//! `[limits]`: bounds on sizes and times.

use super::{OutOfBounds, within};
use crate::app::model::limits;
use serde::Deserialize;

/// Bounds beyond which a request is rejected as too large or too slow.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct LimitsConfig {
    /// Maximum size of one upload, bytes.
    pub upload_bytes: usize,
    /// Maximum size of any other body and of a gRPC message, bytes.
    pub body_bytes: usize,
    /// Maximum time until the head of a response, ms; uploads, streams and gRPC are exempt.
    pub answer_ms: u64,
    /// Maximum time until the head of a request has arrived, ms.
    pub request_head_ms: u64,
    /// Maximum number of concurrent connections.
    pub connections: usize,
}

impl Default for LimitsConfig {
    fn default() -> Self {
        Self {
            upload_bytes: limits::DEFAULT_UPLOAD_BYTES,
            body_bytes: limits::DEFAULT_BODY_BYTES,
            answer_ms: 90_000,
            request_head_ms: 10_000,
            connections: 1024,
        }
    }
}

impl LimitsConfig {
    pub(super) fn check(&self) -> Result<(), OutOfBounds> {
        within("limits.upload_bytes", self.upload_bytes, &(1 << 10..=1 << 30), "1024 to 1073741824")?;
        within("limits.body_bytes", self.body_bytes, &(1 << 10..=1 << 30), "1024 to 1073741824")?;
        within("limits.answer_ms", self.answer_ms, &(1000..=3_600_000), "1000 to 3600000")?;
        within("limits.request_head_ms", self.request_head_ms, &(100..=600_000), "100 to 600000")?;
        within("limits.connections", self.connections, &(1..=100_000), "1 to 100000")
    }
}
