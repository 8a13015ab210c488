//! The store in memory: a test double that passes the conformance suite of the engines.
//!
//! A write works on a copy of everything, which takes the place of the present state if the write succeeds: it is done
//! whole or not at all.

mod jobs;
mod queue;
mod resources;

use super::{KeptTrials, NewDemonstration, NewExperiment, NewRun, Store, StoreError, Usage};
use crate::app::model::{
    ActionGoals, ActionId, ActionView, DemonstrationId, ExperimentId, JobEvent, JobId, JobView, Keyset, RobotId,
    RobotView, RunId, Timestamp, Work, WorldId, WorldView,
};
use crate::app::ports::Clock;
use crate::framework::experiment::RunRow;
use async_trait::async_trait;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use tokio::sync::watch;

/// A store that forgets everything with the process.
pub struct MemoryStore {
    clock: Arc<dyn Clock>,
    data: Mutex<Data>,
    connection: watch::Sender<Connection>,
    /// Number of writes refused for lack of a connection.
    refused: watch::Sender<u64>,
}

/// Answers to writes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Connection {
    /// They are done.
    #[default]
    Open,
    /// They are refused with [`StoreError::Unavailable`].
    Refused,
    /// Heartbeats get no answer; other writes are done.
    Hanging,
}

#[derive(Clone, Default)]
struct Data {
    epoch: u64,
    demonstrations: BTreeMap<DemonstrationId, NewDemonstration>,
    actions: BTreeMap<ActionId, (ActionView, ActionGoals)>,
    robots: BTreeMap<RobotId, (RobotView, String)>,
    worlds: BTreeMap<WorldId, WorldView>,
    jobs: BTreeMap<JobId, Job>,
    keys: BTreeMap<String, Key>,
    runs: BTreeMap<RunId, NewRun>,
    experiments: BTreeMap<ExperimentId, Experiment>,
}

#[derive(Clone)]
struct Job {
    view: JobView,
    work: Work,
    uses: Usage,
    crashes: u32,
    lease: Option<Lease>,
    checkpoint: Option<Vec<u8>>,
    events: Vec<JobEvent>,
}

#[derive(Clone)]
struct Lease {
    token: String,
    epoch: u64,
    until: Duration,
}

#[derive(Clone)]
struct Key {
    body_sha256: String,
    job: JobId,
    given_at: Timestamp,
}

#[derive(Clone)]
struct Experiment {
    new: NewExperiment,
    rows: BTreeMap<(u32, u32), RunRow>,
}

impl MemoryStore {
    /// An empty store whose leases end by `clock`.
    #[must_use]
    pub fn new(clock: Arc<dyn Clock>) -> Self {
        Self { clock, data: Mutex::default(), connection: watch::Sender::default(), refused: watch::Sender::default() }
    }

    /// Changes how the store answers from now on.
    pub fn set_connection(&self, connection: Connection) {
        self.connection.send_replace(connection);
    }

    /// Number of writes refused so far.
    #[must_use]
    pub fn refused(&self) -> watch::Receiver<u64> {
        self.refused.subscribe()
    }

    fn read<T>(&self, read: impl FnOnce(&Data) -> T) -> T {
        read(&self.data.lock().unwrap_or_else(PoisonError::into_inner))
    }

    fn write<T>(&self, write: impl FnOnce(&mut Data) -> Result<T, StoreError>) -> Result<T, StoreError> {
        if *self.connection.borrow() == Connection::Refused {
            self.refused.send_modify(|count| *count += 1);
            return Err(StoreError::Unavailable);
        }
        let mut data = self.data.lock().unwrap_or_else(PoisonError::into_inner);
        let mut copy = data.clone();
        let answer = write(&mut copy)?;
        *data = copy;
        Ok(answer)
    }
}

#[async_trait]
impl Store for MemoryStore {
    async fn ping(&self) -> Result<(), StoreError> {
        Ok(())
    }
}

fn found<T>(value: Option<T>, kind: &'static str, id: &impl ToString) -> Result<T, StoreError> {
    value.ok_or_else(|| StoreError::NotFound { kind, id: id.to_string() })
}

fn taken(what: &str) -> StoreError {
    StoreError::Corrupt { what: what.to_owned(), cause: "it is there already".to_owned() }
}

/// The values of a page, newest first, one more than asked for.
fn page<K: ToString, V: Clone>(all: &BTreeMap<K, V>, keyset: &Keyset, wanted: impl Fn(&V) -> bool) -> Vec<V> {
    let is_before = |key: &K| keyset.before_id.as_ref().is_none_or(|before| key.to_string() < *before);
    let matching = all.iter().rev().filter(|(key, value)| is_before(key) && wanted(value));
    matching.take(keyset.limit as usize + 1).map(|(_, value)| value.clone()).collect()
}

/// Refuses to delete what jobs use.
fn check_unused(data: &Data, id: &str, uses: impl Fn(&Usage) -> bool) -> Result<(), StoreError> {
    match data.jobs.values().filter(|job| uses(&job.uses)).count() as u64 {
        0 => Ok(()),
        count => Err(StoreError::InUse { id: id.to_owned(), count }),
    }
}

fn trials(new: &NewRun) -> KeptTrials {
    if new.trials.trials.is_empty() { KeptTrials::default() } else { new.trials.clone() }
}
