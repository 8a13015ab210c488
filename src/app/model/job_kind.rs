//! Job kinds: the name of each one, its request, and the work for a worker.
//!
//! A new kind adds a variant to the three enums of this file and its request.

use super::execution_work::ExecutionWork;
use super::experiment::ExperimentRequest;
use super::id::{ActionId, DemonstrationId, ExperimentId, JobId, RobotId, RunId, WorldId};
use crate::framework::execution::ExecutionSpec;
use crate::framework::generalization::Weighting;
use crate::framework::recognition::Metric;
use crate::framework::tagged;
use crate::framework::trajectory::PlanSpec;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Kind of a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum JobKind {
    /// Generalizes demonstrations into an action.
    Generalization,
    /// Finds the joint trajectory with which a robot produces an action's effects.
    Execution,
    /// Runs many settings many times and compares them.
    Experiment,
}

impl JobKind {
    /// Name in JSON and in the store.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Generalization => "generalization",
            Self::Execution => "execution",
            Self::Experiment => "experiment",
        }
    }
}

tagged! {
    /// Request for a new job; `kind` selects the variant.
    #[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
    #[serde(tag = "kind", rename_all = "snake_case")]
    pub enum CreateJob {
        /// Generalizes demonstrations into an action.
        Generalization(GeneralizationRequest),
        /// Executes an action on a robot.
        Execution(Box<ExecutionRequest>),
        /// Runs many settings many times.
        Experiment(ExperimentRequest),
    }
}

/// Work for a worker.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Work {
    /// Generalizes demonstrations. Their samples never change, but they may be deleted meanwhile.
    Generalization(GeneralizationRequest),
    /// Executes a problem.
    Execution(Box<ExecutionWork>),
    /// Runs an experiment, whose plan is stored with the experiment.
    Experiment {
        /// Id of the experiment.
        experiment: ExperimentId,
    },
}

impl Work {
    /// Kind of the job.
    #[must_use]
    pub fn kind(&self) -> JobKind {
        match self {
            Self::Generalization(_) => JobKind::Generalization,
            Self::Execution(_) => JobKind::Execution,
            Self::Experiment { .. } => JobKind::Experiment,
        }
    }

    /// Demonstrations it reads while it runs.
    #[must_use]
    pub fn demonstrations(&self) -> &[DemonstrationId] {
        match self {
            Self::Generalization(request) => &request.demonstrations,
            Self::Execution(_) | Self::Experiment { .. } => &[],
        }
    }
}

/// Request for a generalization.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct GeneralizationRequest {
    /// Name of the action; an existing name makes a new version of it.
    pub name: String,
    /// Ids of one or more demonstrations, each once.
    pub demonstrations: Vec<DemonstrationId>,
    /// T_min, the minimum time between goals, seconds.
    pub t_min_s: f64,
    /// Weighting of the samples.
    #[serde(default)]
    pub weighting: Weighting,
    /// Names of the features to keep, in order; all if absent.
    #[serde(default)]
    pub features: Option<Vec<String>>,
    /// Default metric for recognition.
    #[serde(default)]
    pub metric: Metric,
}

/// Request for an execution: action, robot, world and method.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct ExecutionRequest {
    /// Display name; derived from the names of action and robot if absent.
    #[serde(default)]
    pub name: Option<String>,
    /// Id of the action.
    pub action: ActionId,
    /// Id of the robot.
    pub robot: RobotId,
    /// Id of the world.
    pub world: WorldId,
    /// Method, metric and stopping criteria.
    pub execution: ExecutionSpec,
    /// Seed of the first repetition; drawn and recorded if absent. Repetition r uses seed + r.
    #[serde(default)]
    pub seed: Option<u64>,
    /// Number of runs.
    #[serde(default = "one")]
    pub repetitions: u32,
    /// Slows the job down to about this many evaluations per second, so that it can be watched.
    #[serde(default)]
    pub max_evaluations_per_s: Option<f64>,
    /// Runs on the same robot, with the same tool, world and features, whose trials the method `model` starts from,
    /// newest first. If absent, they are looked up and recorded here; an empty list means none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub earlier_runs: Option<Vec<EarlierRun>>,
    /// Choices for the trajectories of the runs; the defaults if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub planning: Option<PlanSpec>,
    /// Whether the constraint `collision_free` is added with its defaults, unless one is given; true if absent. False
    /// for jobs of versions that did not check collisions.
    #[serde(default)]
    pub avoid_collisions: Option<bool>,
}

/// A run whose trials another run starts from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct EarlierRun {
    /// Id of the run.
    pub run: RunId,
    /// Its job; filled in by the service.
    #[serde(default)]
    pub job: Option<JobId>,
    /// Number of its (latest) trials used; filled in by the service.
    #[serde(default)]
    pub trials: Option<u32>,
}

fn one() -> u32 {
    1
}
