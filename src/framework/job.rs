//! The job state machine: which event moves a job from which state to which.
//!
//! # Invariants
//! - A final state accepts no event at all: a job ends exactly once.
//! - `Interrupted` and `Halted` remember nothing: what a job was doing is in its checkpoint.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Where a job stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "SCREAMING_SNAKE_CASE")]
#[schema(as = JobState)]
pub enum State {
    /// Waits for a worker.
    Queued,
    /// A worker has it and reads what it needs.
    Preparing,
    /// A worker computes.
    Running,
    /// Asked to pause; the worker writes a checkpoint first.
    Pausing,
    /// Rests at its checkpoint until resumed.
    Paused,
    /// Waits for a person's approval of a trajectory.
    AwaitingApproval,
    /// Stopped for safety (stop, lost lease, lost link); needs a person's acknowledgement.
    Halted,
    /// Its worker was lost; goes on from its last checkpoint.
    Interrupted,
    /// Asked to cancel; the worker has not seen it yet.
    Cancelling,
    /// Ended on request.
    Cancelled,
    /// Ended with its result.
    Succeeded,
    /// Ended without a result; the reason is stored with it.
    Failed,
}

/// What happens to a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Event {
    /// A worker claimed it.
    Claim,
    /// The worker has all it needs.
    Start,
    /// A user asks to pause.
    Pause,
    /// The worker rests at a checkpoint.
    Rest,
    /// A user asks to go on.
    Resume,
    /// The job needs an approval before it goes on.
    AskApproval,
    /// A person approved.
    Approve,
    /// A stop, a lost lease or a lost link of a robot.
    Halt,
    /// A person saw why it halted: it waits for a worker again.
    Acknowledge,
    /// Its worker was lost.
    LoseWorker,
    /// It is offered to workers again.
    Requeue,
    /// A user asks to cancel.
    Cancel,
    /// The worker stopped for good.
    Stop,
    /// The result is complete.
    Succeed,
    /// It cannot be completed.
    Fail,
}

/// An event that the state does not accept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("a job that is {state:?} does not accept {event:?}")]
pub struct InvalidTransition {
    /// The job's state.
    pub state: State,
    /// The refused event.
    pub event: Event,
}

impl State {
    /// All states.
    pub const ALL: [Self; 12] = [
        Self::Queued,
        Self::Preparing,
        Self::Running,
        Self::Pausing,
        Self::Paused,
        Self::AwaitingApproval,
        Self::Halted,
        Self::Interrupted,
        Self::Cancelling,
        Self::Cancelled,
        Self::Succeeded,
        Self::Failed,
    ];

    /// Whether the job ended: no event is accepted any more.
    #[must_use]
    pub fn is_final(self) -> bool {
        matches!(self, Self::Succeeded | Self::Failed | Self::Cancelled)
    }

    /// Whether a worker holds the job.
    #[must_use]
    pub fn is_held(self) -> bool {
        matches!(self, Self::Preparing | Self::Running | Self::Pausing | Self::Cancelling | Self::AwaitingApproval)
    }

    /// The state after `event`.
    ///
    /// # Errors
    /// [`InvalidTransition`] when this state does not accept the event.
    pub fn apply(self, event: Event) -> Result<Self, InvalidTransition> {
        use State::{
            AwaitingApproval, Cancelled, Cancelling, Failed, Halted, Interrupted, Paused, Pausing, Preparing, Queued,
            Running, Succeeded,
        };
        Ok(match (self, event) {
            (Queued, Event::Claim) => Preparing,
            (Preparing, Event::Start) | (AwaitingApproval, Event::Approve) | (Pausing, Event::Resume) => Running,
            (Preparing | Running, Event::Pause) => Pausing,
            (Pausing, Event::Rest) | (Queued | Interrupted, Event::Pause) => Paused,
            (Paused, Event::Resume) | (Halted, Event::Acknowledge) | (Interrupted, Event::Requeue) => Queued,
            // A worker that shuts down gives back what it holds; what it was asked meanwhile is then done at once.
            (Preparing | Running, Event::Requeue) => Queued,
            (Running, Event::AskApproval) => AwaitingApproval,
            (Preparing | Running | Pausing | AwaitingApproval | Cancelling, Event::Halt) => Halted,
            (Preparing | Running | AwaitingApproval, Event::LoseWorker) => Interrupted,
            (Pausing, Event::LoseWorker) => Paused,
            (Preparing | Running | Pausing | AwaitingApproval, Event::Cancel) => Cancelling,
            (Queued | Paused | Halted | Interrupted, Event::Cancel) | (Cancelling, Event::Stop | Event::LoseWorker) => {
                Cancelled
            }
            // The last slice may end before the worker sees a pause or a cancel: the result is kept.
            (Running | Pausing | Cancelling, Event::Succeed) => Succeeded,
            (Queued | Preparing | Running | Pausing | AwaitingApproval | Interrupted | Cancelling, Event::Fail) => {
                Failed
            }
            (state, event) => return Err(InvalidTransition { state, event }),
        })
    }
}
