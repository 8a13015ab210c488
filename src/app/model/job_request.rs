//! Requests for jobs.

use super::experiment::ExperimentRequest;
use super::id::{ActionId, DemonstrationId, JobId, RobotId, RunId, WorldId};
use crate::framework::execution::ExecutionSpec;
use crate::framework::generalization::Weighting;
use crate::framework::recognition::Metric;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// A new job; `kind` picks one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum CreateJob {
    /// Makes an action of demonstrations.
    Generalization(GeneralizationRequest),
    /// Executes an action on a robot.
    Execution(Box<ExecutionRequest>),
    /// Runs many settings many times.
    Experiment(ExperimentRequest),
}

/// Which demonstrations become an action, and how.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct GeneralizationRequest {
    /// Name of the action; a taken name makes a new version of it.
    pub name: String,
    /// At least one, each once.
    pub demonstrations: Vec<DemonstrationId>,
    /// Shortest time between goals, seconds (> 0).
    pub t_min_s: f64,
    /// How samples are weighted.
    #[serde(default)]
    pub weighting: Weighting,
    /// Features by name, in the order they shall have; all when absent.
    #[serde(default)]
    pub features: Option<Vec<String>>,
    /// Default metric for recognition.
    #[serde(default)]
    pub metric: Metric,
}

/// Which action is executed on which robot in which world, and how.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct ExecutionRequest {
    /// Display name; made of the names of action and robot when absent.
    #[serde(default)]
    pub name: Option<String>,
    /// The action.
    pub action: ActionId,
    /// The robot.
    pub robot: RobotId,
    /// The world.
    pub world: WorldId,
    /// Method, metric, when a goal ends.
    pub execution: ExecutionSpec,
    /// Seed of the first repetition, below 2^53; drawn and recorded when absent. Repetition r uses seed + r.
    #[serde(default)]
    pub seed: Option<u64>,
    /// Number of runs, 1 to 1000.
    #[serde(default = "one")]
    pub repetitions: u32,
    /// Slows the job down to about so many evaluations a second, to be watched.
    #[serde(default)]
    pub max_evaluations_per_s: Option<f64>,
    /// Runs on the same robot, with the same tool, world and features, whose trials the method `model` begins with,
    /// newest first. When absent they are found, and told here; an empty list is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub earlier_runs: Option<Vec<EarlierRun>>,
}

/// A run whose trials another one begins with.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct EarlierRun {
    /// The run.
    pub run: RunId,
    /// Its job; filled in.
    #[serde(default)]
    pub job: Option<JobId>,
    /// How many of its trials are used, the latest ones; filled in.
    #[serde(default)]
    pub trials: Option<u32>,
}

fn one() -> u32 {
    1
}
