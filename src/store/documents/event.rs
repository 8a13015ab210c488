//! An event of a job; its number, its job and its time are columns.

use super::progress::{Goal, Progress, Trial, with_trials};
use super::{unchanged, versions};
use crate::app::model::{EventData, RunId, TrajectoryId};
use crate::app::ports::StoreError;
use crate::framework::infinite_as_null;
use crate::framework::job::State;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// An event by its type.
#[derive(Debug, Serialize, Deserialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub(in crate::store) enum Event {
    /// The job changed its state.
    State { state: State, reason: Option<String>, attempt: u32 },
    /// The job made progress.
    Progress { progress: Progress },
    /// A goal ended.
    Goal { goal: Goal },
    /// A method that owns the whole run made a trial.
    Trial { trial: Trial },
    /// A repetition ended.
    Run {
        run: RunId,
        trajectory: Option<TrajectoryId>,
        repetition: u32,
        seed: u64,
        evaluations: u64,
        #[serde(with = "infinite_as_null::number")]
        discrepancy: f64,
        painted_percent: Option<f64>,
        digest: String,
    },
}
// Version 1 is that of the builds without verdicts: what is missing is read as none.
versions! { Event keeps EventData, "event", [with_trials_of_progress, unchanged] }

fn with_trials_of_progress(mut event: Value) -> Value {
    if let Some(progress) = event.get_mut("progress") {
        *progress = with_trials(progress.take());
    }
    event
}

impl TryFrom<EventData> for Event {
    type Error = StoreError;

    /// Refuses a resync, which is sent but never stored.
    fn try_from(data: EventData) -> Result<Self, StoreError> {
        Ok(match data {
            EventData::State { state, reason, attempt } => Self::State { state, reason, attempt },
            EventData::Progress { progress } => Self::Progress { progress: progress.into() },
            EventData::Goal { goal } => Self::Goal { goal: goal.into() },
            EventData::Trial { trial } => Self::Trial { trial: trial.into() },
            EventData::Run { run, trajectory, repetition, seed, evaluations, discrepancy, painted_percent, digest } => {
                Self::Run { run, trajectory, repetition, seed, evaluations, discrepancy, painted_percent, digest }
            }
            EventData::Resync => {
                let cause = "a resync is sent, never stored".to_owned();
                return Err(StoreError::Corrupt { what: "event to be stored".to_owned(), cause });
            }
        })
    }
}

impl From<Event> for EventData {
    fn from(event: Event) -> Self {
        match event {
            Event::State { state, reason, attempt } => Self::State { state, reason, attempt },
            Event::Progress { progress } => Self::Progress { progress: progress.into() },
            Event::Goal { goal } => Self::Goal { goal: goal.into() },
            Event::Trial { trial } => Self::Trial { trial: trial.into() },
            Event::Run { run, trajectory, repetition, seed, evaluations, discrepancy, painted_percent, digest } => {
                Self::Run { run, trajectory, repetition, seed, evaluations, discrepancy, painted_percent, digest }
            }
        }
    }
}
