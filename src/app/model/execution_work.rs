//! The whole input of an execution, resolved when it was submitted.

use super::id::{ActionId, RobotId, WorldId};
use crate::framework::execution::Problem;
use crate::framework::trajectory::PlanSpec;
use serde::{Deserialize, Serialize};

/// A self-contained execution.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ExecutionWork {
    /// Action named in the request; shown with the runs.
    pub action: ActionId,
    /// Robot named in the request.
    pub robot: RobotId,
    /// World named in the request.
    pub world: WorldId,
    /// Goals, robot, world and method.
    pub problem: Problem,
    /// Digest of everything that determines an observation: later runs with the same one may begin with these runs'
    /// trials.
    #[serde(default, rename = "setting")]
    pub setup_key: Option<String>,
    /// Seed of repetition 0; repetition r uses seed + r.
    pub seed: u64,
    /// Number of runs.
    pub repetitions: u32,
    /// Slows the job down to about this many evaluations per second.
    pub max_evaluations_per_s: Option<f64>,
    /// Choices for the trajectories of the runs.
    #[serde(default, skip_serializing_if = "PlanSpec::is_default")]
    pub planning: PlanSpec,
}
