//! The one service layer: use-cases and the ports they need.
//!
//! # Architecture Invariants
//! - A use-case is one method of [`App`], the same for REST and gRPC; the request and view types are the REST bodies.
//! - Everything that is not pure comes through a port: the store, the clock, the source of ids and seeds.
//! - What a job needs is resolved when it is submitted and stored with it: later changes of what it names do not
//!   reach it.

mod access;
pub mod actions;
pub mod demonstrations;
mod error;
pub mod id;
pub mod jobs;
mod page;
pub mod ports;
pub mod recognitions;
pub mod robots;
pub mod runs;
mod time;
pub mod trajectories;
pub mod worlds;

pub use access::Access;
pub use error::{AppError, ErrorKind, FieldError};
pub use page::{DEFAULT_PAGE_SIZE, Keyset, MAX_PAGE_SIZE, Page, PageQuery};
pub use time::Timestamp;

use std::sync::Arc;

/// The service; clones share everything.
#[derive(Clone)]
pub struct App {
    inner: Arc<Inner>,
}

struct Inner {}

impl App {
    fn unfinished(&self) -> AppError {
        let _ = &self.inner;
        AppError::unavailable("starting", "the service is starting")
    }

    /// Whether requests can be answered and workers run.
    #[must_use]
    pub fn is_ready(&self) -> bool {
        Arc::strong_count(&self.inner) > 0
    }
}
