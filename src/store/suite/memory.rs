//! The in-memory double keeps every promise of the engines.

use super::conformance;
use crate::app::ports::{MemoryStore, TestClock};
use std::sync::Arc;

conformance! { async { ((), MemoryStore::new(Arc::new(TestClock::new()))) } }
