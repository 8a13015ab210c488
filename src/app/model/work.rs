//! All a job needs, resolved when it was submitted.

use super::id::{ActionId, DemonstrationId, ExperimentId, RobotId, WorldId};
use super::job::JobKind;
use super::job_request::GeneralizationRequest;
use crate::framework::execution::Problem;
use serde::{Deserialize, Serialize};

/// What a worker does.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Work {
    /// Makes an action of demonstrations; their samples never change, only they may be deleted meanwhile.
    Generalization(GeneralizationRequest),
    /// Runs a problem.
    Execution(Box<ExecutionWork>),
    /// Runs an experiment; its plan is stored once, with it.
    Experiment {
        /// The experiment.
        experiment: ExperimentId,
    },
}

/// An execution, self-contained.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ExecutionWork {
    /// What was named in the request; shown with the runs.
    pub action: ActionId,
    /// The robot named.
    pub robot: RobotId,
    /// The world named.
    pub world: WorldId,
    /// Goals, robot, world and method.
    pub problem: Problem,
    /// What decides what a pose shows, as a digest: later runs with the same one may begin with these runs' trials.
    #[serde(default)]
    pub setting: Option<String>,
    /// Seed of repetition 0; repetition r uses seed + r.
    pub seed: u64,
    /// Number of runs.
    pub repetitions: u32,
    /// Slows the job down to about so many evaluations a second.
    pub max_evaluations_per_s: Option<f64>,
}

impl Work {
    /// What kind of job it is.
    #[must_use]
    pub fn kind(&self) -> JobKind {
        match self {
            Self::Generalization(_) => JobKind::Generalization,
            Self::Execution(_) => JobKind::Execution,
            Self::Experiment { .. } => JobKind::Experiment,
        }
    }

    /// The demonstrations it reads while it works.
    #[must_use]
    pub fn demonstrations(&self) -> &[DemonstrationId] {
        match self {
            Self::Generalization(request) => &request.demonstrations,
            Self::Execution(_) | Self::Experiment { .. } => &[],
        }
    }
}
