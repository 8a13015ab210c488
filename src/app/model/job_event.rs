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
    /// 1 for the first event of the job, then counted up without gaps.
    pub seq: u64,
    /// The job.
    pub job: JobId,
    /// When.
    pub at: Timestamp,
    /// What.
    #[serde(flatten)]
    pub data: EventData,
}

/// What happened; `type` picks one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum EventData {
    /// The job is in another state.
    State {
        /// The new state.
        state: State,
        /// Why.
        #[schema(required = true)]
        reason: Option<String>,
        /// How often a worker claimed it.
        attempt: u32,
    },
    /// The job went on.
    Progress {
        /// How far it is.
        progress: JobProgress,
    },
    /// Events before this one are not kept or were never there: read the job anew. Sent, never stored.
    Resync,
    /// A goal ended.
    Goal {
        /// The goal.
        goal: GoalProgress,
    },
    /// A method that owns the whole run made a trial.
    Trial {
        /// The trial.
        trial: TrialProgress,
    },
    /// A repetition ended.
    Run {
        /// The run.
        run: RunId,
        /// Its trajectory.
        #[schema(required = true)]
        trajectory: Option<TrajectoryId>,
        /// Repetition, from 0.
        repetition: u32,
        /// Its seed.
        seed: u64,
        /// Evaluations.
        evaluations: u64,
        /// Discrepancy, features' unit.
        discrepancy: f64,
        /// Share painted, %.
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
    /// The asked position is unknown (too old or of another server): read the job anew and go on after `last_seq`.
    pub resync: bool,
    /// Sequence number of the job's last event.
    pub last_seq: u64,
    /// Whether the job is final and these are its last events.
    pub end: bool,
}
