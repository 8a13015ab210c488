//! The Clock port.

use crate::app::model::Timestamp;
use std::time::Duration;

/// Wall-clock time for display and monotonic time for measuring; no lease or deadline depends on the wall clock.
pub trait Clock: Send + Sync {
    /// Wall-clock time.
    fn now(&self) -> Timestamp;

    /// Time since a fixed moment; monotonic.
    fn elapsed(&self) -> Duration;
}
