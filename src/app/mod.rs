//! The one service layer: use-cases and the ports they need.
//!
//! # Architecture Invariants
//! - A use-case is one method of [`UseCases`], the same for REST and gRPC; the request and view types are the REST bodies.
//! - Use-cases are only had on behalf of a [`Caller`], from [`App::on_behalf_of`].
//! - Everything that is not pure comes through a port: the store, the clock, the source of ids and seeds.
//! - What a job needs is resolved when it is submitted and stored with it: later changes of what it names do not
//!   reach it.

mod access;
pub mod actions;
#[cfg(test)]
pub(crate) mod bench;
mod caller;
pub mod demonstrations;
pub mod experiments;
pub mod jobs;
pub mod json_pointer;
pub mod methods;
pub mod model;
pub mod ports;
pub mod recognitions;
pub mod robots;
pub mod runs;
pub mod strict_json;
pub mod trajectories;
pub mod worlds;

pub use access::Access;
pub use caller::Caller;

use crate::framework::{is_display_name, is_hidden};
use model::{AppError, ErrorKind, Timestamp, limits};
use ports::{Clock, Events, Ids, Store};
use std::ops::RangeInclusive;
use std::sync::Arc;
use tokio::sync::watch;

/// Ports the service is plugged into.
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
    upload_limit_bytes: usize,
}

/// The use-cases of the service, on behalf of one caller.
#[derive(Clone)]
pub struct UseCases {
    ports: Ports,
    upload_limit_bytes: usize,
    caller: Caller,
}

impl App {
    /// The service on these ports; not ready yet.
    #[must_use]
    pub fn new(ports: Ports) -> Self {
        Self { ports, ready: watch::Sender::new(false), upload_limit_bytes: limits::DEFAULT_UPLOAD_BYTES }
    }

    /// The same service with another limit on the bytes of one upload.
    #[must_use]
    pub fn with_upload_limit(self, bytes: usize) -> Self {
        Self { upload_limit_bytes: bytes, ..self }
    }

    /// The use-cases on behalf of `caller`.
    #[must_use]
    pub fn on_behalf_of(&self, caller: Caller) -> UseCases {
        UseCases { ports: self.ports.clone(), upload_limit_bytes: self.upload_limit_bytes, caller }
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

    /// Sets whether workers run; `false` as soon as the server is asked to stop.
    pub fn set_ready(&self, ready: bool) {
        self.ready.send_replace(ready);
    }

    /// Ports the service is plugged into, for the workers.
    #[must_use]
    pub fn ports(&self) -> &Ports {
        &self.ports
    }
}

impl UseCases {
    /// Maximum size of one upload, bytes; whoever receives uploads enforces it while they arrive.
    #[must_use]
    pub fn upload_limit_bytes(&self) -> usize {
        self.upload_limit_bytes
    }

    fn now(&self) -> Timestamp {
        self.ports.clock.now()
    }
}

/// Rejects a display name that is too long or holds hidden characters.
fn check_name(pointer: &str, name: &str) -> Result<(), AppError> {
    if is_display_name(name) {
        return Ok(());
    }
    let (bounds, length) = (limits::in_words(&limits::NAME_CHARS), name.chars().count());
    let found = match name.chars().find(|&character| is_hidden(character)) {
        Some(hidden) => format!("holds the hidden character U+{:04X}", u32::from(hidden)),
        None if name.trim().is_empty() => "has none".to_owned(),
        None => format!("has {length}"),
    };
    let detail = format!("a name has {bounds} visible characters, this one {found}");
    Err(AppError::field(pointer, "invalid_name", detail))
}

/// Runs CPU work away from the tasks that answer requests.
async fn compute<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> Result<T, AppError> {
    tokio::task::spawn_blocking(work).await.map_err(AppError::internal)
}

/// A number of a query, if it is within its bounds.
fn within(name: &str, value: u32, bounds: &RangeInclusive<u32>) -> Result<u32, AppError> {
    if bounds.contains(&value) { Ok(value) } else { Err(out_of_bounds(name, value, &limits::in_words(bounds))) }
}

/// The error of a value of a query that is out of its bounds.
fn out_of_bounds(name: &str, value: impl std::fmt::Display, bounds: &str) -> AppError {
    AppError::new(ErrorKind::Malformed, "invalid_query", format!("{name} is {value}: give {bounds}"))
}

/// A format that an export does not have.
fn unknown_format(format: &str, known: &str) -> AppError {
    AppError::new(ErrorKind::Malformed, "unknown_format", format!("there is no format {format:?}: give {known}"))
}

/// An error with its causes in one line; a cause that its effect already quotes is left out.
#[must_use]
pub fn chain_text(error: &(dyn std::error::Error + 'static)) -> String {
    let mut text = error.to_string();
    let mut next = error.source();
    while let Some(cause) = next {
        let cause_text = cause.to_string();
        if !text.contains(cause_text.trim()) {
            text = format!("{text}: {cause_text}");
        }
        next = cause.source();
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cause_is_told_once() {
        let cause = anyhow::anyhow!("no such file");
        assert_eq!(chain_text(cause.context("cannot read x").as_ref()), "cannot read x: no such file");
        let twice = anyhow::anyhow!("bad number\n").context("line 1: bad number");
        assert_eq!(chain_text(twice.as_ref()), "line 1: bad number");
    }
}
