//! The one service layer: use-cases and the ports they need.
//!
//! # Architecture Invariants
//! - A use-case is one method of [`App`], the same for REST and gRPC; the request and view types are the REST bodies.
//! - Everything that is not pure comes through a port: the store, the clock, the source of ids and seeds.
//! - What a job needs is resolved when it is submitted and stored with it: later changes of what it names do not
//!   reach it.

mod access;
pub mod actions;
#[cfg(test)]
mod bench;
pub mod demonstrations;
pub mod experiments;
pub mod jobs;
pub mod json_pointer;
pub mod model;
pub mod ports;
pub mod recognitions;
pub mod robots;
pub mod runs;
pub mod strict_json;
pub mod trajectories;
pub mod worlds;

pub use access::Access;

use crate::framework::is_hidden;
use model::{AppError, ErrorKind, Timestamp};
use ports::{Clock, Events, Ids, Store};
use std::sync::Arc;
use tokio::sync::watch;

/// What the service is plugged into.
#[derive(Clone)]
pub struct Ports {
    /// Durable storage.
    pub store: Arc<dyn Store>,
    /// Time.
    pub clock: Arc<dyn Clock>,
    /// Ids and seeds.
    pub ids: Arc<dyn Ids>,
    /// Wake-ups.
    pub events: Arc<dyn Events>,
}

/// The service; clones share everything.
#[derive(Clone)]
pub struct App {
    ports: Ports,
    ready: watch::Sender<bool>,
}

impl App {
    /// The service on these ports; not ready yet.
    #[must_use]
    pub fn new(ports: Ports) -> Self {
        Self { ports, ready: watch::Sender::new(false) }
    }

    /// Whether workers run and the server is not stopping.
    #[must_use]
    pub fn is_ready(&self) -> bool {
        *self.ready.borrow()
    }

    /// Follows [`App::is_ready`].
    #[must_use]
    pub fn readiness(&self) -> watch::Receiver<bool> {
        self.ready.subscribe()
    }

    /// Tells whether workers run; `false` as soon as the server is asked to stop.
    pub fn set_ready(&self, ready: bool) {
        self.ready.send_replace(ready);
    }

    /// What the service is plugged into, for the workers.
    #[must_use]
    pub fn ports(&self) -> &Ports {
        &self.ports
    }

    fn now(&self) -> Timestamp {
        self.ports.clock.now()
    }
}

/// A display name without control characters, 1 to 128 characters long.
fn check_name(pointer: &str, name: &str) -> Result<(), AppError> {
    let length = name.chars().count();
    if name.trim().is_empty() || length > 128 || name.chars().any(is_hidden) {
        let detail = format!("a name has 1 to 128 visible characters, this one has {length}");
        return Err(AppError::field(pointer, "invalid_name", detail));
    }
    Ok(())
}

/// Runs CPU work away from the tasks that answer requests.
async fn compute<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> Result<T, AppError> {
    tokio::task::spawn_blocking(work).await.map_err(AppError::internal)
}

/// A number of a query that is out of its bounds.
fn out_of_bounds(name: &str, value: impl std::fmt::Display, bounds: &str) -> AppError {
    AppError::new(ErrorKind::Malformed, "invalid_query", format!("{name} is {value}: give {bounds}"))
}

/// A format that an export does not have.
fn unknown_format(format: &str, known: &str) -> AppError {
    AppError::new(ErrorKind::Malformed, "unknown_format", format!("there is no format {format:?}: give {known}"))
}

/// The error of a list of chosen things, with its whole chain of causes in one line.
fn chain_text(error: &(dyn std::error::Error + 'static)) -> String {
    let mut text = error.to_string();
    let mut next = error.source();
    while let Some(cause) = next {
        let cause_text = cause.to_string();
        if !text.contains(&cause_text) {
            text = format!("{text}: {cause_text}");
        }
        next = cause.source();
    }
    text
}
