//! Time.

use crate::app::model::Timestamp;
use std::time::Duration;

/// Time of the day, for showing, and time that passes, for measuring; no lease and no deadline depends on the former.
pub trait Clock: Send + Sync {
    /// Now.
    fn now(&self) -> Timestamp;

    /// Time since some fixed moment; it never jumps.
    fn elapsed(&self) -> Duration;
}
