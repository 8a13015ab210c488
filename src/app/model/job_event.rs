//! Events of a job, numbered without gaps.

use super::id::{JobId, RunId, TrajectoryId};
use super::job_progress::{GoalProgress, JobProgress, TrialProgress};
use super::time::Timestamp;
use crate::framework::job::State;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// One event of a job.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct JobEvent {
    /// Sequence number: 1 for the first event of the job, then counting up without gaps.
    pub seq: u64,
    /// Job it belongs to.
    pub job: JobId,
    /// Time of the event.
    pub at: Timestamp,
    /// Content of the event.
    #[serde(flatten)]
    pub data: EventData,
}

/// Content of an event; `type` selects the variant.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum EventData {
    /// The state changed.
    State {
        /// The new state.
        state: State,
        /// Reason for the state; absent if the state says it all.
        #[schema(required = true)]
        reason: Option<String>,
        /// Number of times a worker claimed the job.
        attempt: u32,
    },
    /// The job made progress.
    Progress {
        /// Progress so far.
        progress: JobProgress,
    },
    /// Earlier events are not available: read the job anew. Sent, never stored.
    Resync,
    /// A goal ended.
    Goal {
        /// Result of the goal.
        goal: GoalProgress,
    },
    /// A method that plans the whole run made a trial.
    Trial {
        /// Outcome of the trial.
        trial: TrialProgress,
    },
    /// A repetition ended.
    Run {
        /// Id of the finished run.
        run: RunId,
        /// Id of its trajectory; absent if it has none.
        #[schema(required = true)]
        trajectory: Option<TrajectoryId>,
        /// Repetition, from 0.
        repetition: u32,
        /// Seed of the repetition.
        seed: u64,
        /// Number of evaluations.
        evaluations: u64,
        /// Discrepancy, features' unit.
        discrepancy: f64,
        /// Painted share, %; absent unless the world is a surface.
        #[schema(required = true)]
        painted_percent: Option<f64>,
        /// SHA-256 of the result's bits, hexadecimal.
        digest: String,
    },
}

/// Some events of a job.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct EventPage {
    /// Events in the order of `seq`.
    pub events: Vec<JobEvent>,
    /// Whether the requested position is unknown (too old or of another server): read the job anew and continue after
    /// `last_seq`.
    pub resync: bool,
    /// Sequence number of the job's last event.
    pub last_seq: u64,
    /// Whether the job is final and these are its last events.
    pub end: bool,
}
