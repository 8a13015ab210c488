//! The job state machine: which event takes a job from which state to which.
//!
//! # Invariants
//! - A final state accepts no events: a job ends exactly once.
//! - `Interrupted` stores nothing: the job's progress is in its checkpoint.

use serde::{Deserialize, Serialize};

/// State of a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema), schema(as = JobState))]
#[serde(rename_all = "SCREAMING_SNAKE_CASE")]
pub enum State {
    /// Waiting for a worker.
    Queued,
    /// A worker has claimed it and is reading its inputs.
    Preparing,
    /// A worker is computing.
    Running,
    /// Asked to pause; the worker first writes a checkpoint.
    Pausing,
    /// Paused at its checkpoint until resumed.
    Paused,
    /// Lost its worker; continues from its last checkpoint.
    Interrupted,
    /// Asked to cancel; the worker has not stopped yet.
    Cancelling,
    /// Ended at a user's request.
    Cancelled,
    /// Ended with a result.
    Succeeded,
    /// Ended without a result; the reason is stored with the job.
    Failed,
}

/// Events that move a job between states.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Event {
    /// A worker claimed it.
    Claim,
    /// The worker has read its inputs.
    Start,
    /// A user asked to pause.
    Pause,
    /// The worker paused at a checkpoint.
    Rest,
    /// A user asked to resume.
    Resume,
    /// Its worker was lost.
    LoseWorker,
    /// The job is offered to workers again.
    Requeue,
    /// A user asked to cancel.
    Cancel,
    /// The worker stopped after a cancel.
    Stop,
    /// The result is complete.
    Succeed,
    /// The job cannot be completed.
    Fail,
}

/// An event that the current state does not accept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("a job that is {state:?} does not accept {event:?}")]
pub struct InvalidTransition {
    /// State of the job.
    pub state: State,
    /// Rejected event.
    pub event: Event,
}

impl State {
    /// All states.
    pub const ALL: [Self; 10] = [
        Self::Queued,
        Self::Preparing,
        Self::Running,
        Self::Pausing,
        Self::Paused,
        Self::Interrupted,
        Self::Cancelling,
        Self::Cancelled,
        Self::Succeeded,
        Self::Failed,
    ];

    /// Name in JSON and in stores.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Queued => "QUEUED",
            Self::Preparing => "PREPARING",
            Self::Running => "RUNNING",
            Self::Pausing => "PAUSING",
            Self::Paused => "PAUSED",
            Self::Interrupted => "INTERRUPTED",
            Self::Cancelling => "CANCELLING",
            Self::Cancelled => "CANCELLED",
            Self::Succeeded => "SUCCEEDED",
            Self::Failed => "FAILED",
        }
    }

    /// The state with that name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|state| state.as_str() == name)
    }

    /// Whether the job has ended; no event is accepted any more.
    #[must_use]
    pub fn is_final(self) -> bool {
        matches!(self, Self::Succeeded | Self::Failed | Self::Cancelled)
    }

    /// Whether a worker holds the job.
    #[must_use]
    pub fn is_held(self) -> bool {
        matches!(self, Self::Preparing | Self::Running | Self::Pausing | Self::Cancelling)
    }

    /// The state after `event`.
    ///
    /// # Errors
    /// [`InvalidTransition`] if this state does not accept the event.
    pub fn apply(self, event: Event) -> Result<Self, InvalidTransition> {
        use State::{
            Cancelled, Cancelling, Failed, Interrupted, Paused, Pausing, Preparing, Queued, Running, Succeeded,
        };
        Ok(match (self, event) {
            (Queued, Event::Claim) => Preparing,
            (Preparing, Event::Start) | (Pausing, Event::Resume) => Running,
            (Preparing | Running, Event::Pause) => Pausing,
            (Pausing, Event::Rest | Event::LoseWorker) | (Queued | Interrupted, Event::Pause) => Paused,
            // A worker that shuts down returns the jobs it holds.
            (Paused, Event::Resume) | (Interrupted | Preparing | Running, Event::Requeue) => Queued,
            (Preparing | Running, Event::LoseWorker) => Interrupted,
            (Preparing | Running | Pausing, Event::Cancel) => Cancelling,
            (Queued | Paused | Interrupted, Event::Cancel) | (Cancelling, Event::Stop | Event::LoseWorker) => Cancelled,
            // The last slice may finish before the worker notices a pause or a cancel; the result is kept.
            (Running | Pausing | Cancelling, Event::Succeed) => Succeeded,
            (Queued | Preparing | Running | Pausing | Interrupted | Cancelling, Event::Fail) => Failed,
            (state, event) => return Err(InvalidTransition { state, event }),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use State::{Cancelled, Cancelling, Failed, Interrupted, Paused, Pausing, Preparing, Queued, Running, Succeeded};

    const EVENTS: [Event; 11] = [
        Event::Claim,
        Event::Start,
        Event::Pause,
        Event::Rest,
        Event::Resume,
        Event::LoseWorker,
        Event::Requeue,
        Event::Cancel,
        Event::Stop,
        Event::Succeed,
        Event::Fail,
    ];

    /// One row per state, one column per event of [`EVENTS`].
    fn table() -> [[Option<State>; 11]; 10] {
        let no = None;
        let to = Some;
        [
            // Claim, Start, Pause, Rest, Resume, LoseWorker, Requeue, Cancel, Stop, Succeed, Fail
            [to(Preparing), no, to(Paused), no, no, no, no, to(Cancelled), no, no, to(Failed)],
            [no, to(Running), to(Pausing), no, no, to(Interrupted), to(Queued), to(Cancelling), no, no, to(Failed)],
            [no, no, to(Pausing), no, no, to(Interrupted), to(Queued), to(Cancelling), no, to(Succeeded), to(Failed)],
            [no, no, no, to(Paused), to(Running), to(Paused), no, to(Cancelling), no, to(Succeeded), to(Failed)],
            [no, no, no, no, to(Queued), no, no, to(Cancelled), no, no, no],
            [no, no, to(Paused), no, no, no, to(Queued), to(Cancelled), no, no, to(Failed)],
            [no, no, no, no, no, to(Cancelled), no, no, to(Cancelled), to(Succeeded), to(Failed)],
            [no; 11],
            [no; 11],
            [no; 11],
        ]
    }

    #[test]
    fn every_state_answers_every_event_as_the_table_says() {
        for (state, row) in State::ALL.into_iter().zip(table()) {
            for (event, expected) in EVENTS.into_iter().zip(row) {
                let found = state.apply(event);
                assert_eq!(found, expected.ok_or(InvalidTransition { state, event }), "{state:?} {event:?}");
            }
        }
    }

    #[test]
    fn only_final_states_are_dead_ends_and_they_are_held_by_nobody() {
        for state in State::ALL {
            let accepts = EVENTS.into_iter().any(|event| state.apply(event).is_ok());
            assert_eq!(accepts, !state.is_final(), "{state:?}");
            assert!(!(state.is_final() && state.is_held()), "{state:?}");
        }
    }

    #[test]
    fn names_are_those_of_json() {
        for state in State::ALL {
            assert_eq!(serde_json::to_value(state).unwrap(), state.as_str());
            assert_eq!(State::from_name(state.as_str()), Some(state));
        }
        assert_eq!(State::from_name("queued"), None);
    }
}
