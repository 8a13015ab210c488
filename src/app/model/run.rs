//! Runs, their goals, trials and convergence, as they are shown.

use super::id::{ActionId, JobId, RobotId, RunId, TrajectoryId, WorldId};
use super::time::Timestamp;
use crate::framework::Feature;
use crate::framework::method::per_goal::{Provenance, StopReason, Tally};
use crate::framework::method::whole_run::Trial;
use crate::framework::recognition::Metric;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// One finished repetition.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RunView {
    /// Its id.
    pub id: RunId,
    /// The job it belongs to.
    pub job: JobId,
    /// Which repetition, from 0.
    pub repetition: u32,
    /// The action executed.
    pub action: ActionId,
    /// The robot.
    pub robot: RobotId,
    /// The world.
    pub world: WorldId,
    /// Method name, for example `sst`.
    pub method: String,
    /// How discrepancy was measured.
    pub metric: Metric,
    /// Its seed.
    pub seed: u64,
    /// Evaluations of all goals.
    pub evaluations: u64,
    /// Discrepancy of the whole observation, features' unit.
    pub discrepancy: f64,
    /// What the last goal's winner really does, where `discrepancy` is the value of one that was never executed.
    #[schema(required = true)]
    pub true_discrepancy: Option<f64>,
    /// Whether the last goal's joints satisfy the constraints; true where there are none.
    pub valid: bool,
    /// Where the fitness values of all goals come from, by count.
    pub provenance: Tally,
    /// Share of the surface painted, %, in a world of coverage.
    #[schema(required = true)]
    pub painted_percent: Option<f64>,
    /// Number of goals.
    pub goals: u32,
    /// SHA-256 of the result's bits, hexadecimal.
    pub digest: String,
    /// Its trajectory; absent when none could be made within the limits, which `trajectory_problem` explains.
    #[schema(required = true)]
    pub trajectory: Option<TrajectoryId>,
    /// Why there is no trajectory.
    #[schema(required = true)]
    pub trajectory_problem: Option<String>,
    /// When it ended.
    pub created_at: Timestamp,
}

/// One goal of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RunGoal {
    /// From 0.
    pub index: u32,
    /// Evaluations of this goal.
    pub evaluations: u64,
    /// Discrepancy of the observation up to this goal, features' unit.
    pub discrepancy: f64,
    /// Why the goal ended.
    pub stop_reason: StopReason,
    /// Free joints, rad or m.
    pub joints: Vec<f64>,
    /// What was observed there.
    pub observation: Vec<f64>,
    /// What was asked for.
    pub goal: Vec<f64>,
    /// Distance of `observation` from `goal` (Euclidean, features' unit): for a goal out of reach the best found.
    #[schema(required = true)]
    pub residual: Option<f64>,
    /// Where the winner's discrepancy comes from.
    pub winner: Provenance,
    /// What the winner really does, where `discrepancy` is the value of one that was never executed.
    #[schema(required = true)]
    pub true_discrepancy: Option<f64>,
    /// Whether the joints satisfy the constraints; true where there are none.
    pub feasible: bool,
    /// Where the fitness values of this goal come from, by count.
    pub provenance: Tally,
}

/// All goals of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RunGoals {
    /// The run.
    pub run: RunId,
    /// Features, in the order of `goal` and `observation`.
    pub features: Vec<Feature>,
    /// Free joints, in the order of `joints`.
    pub joint_names: Vec<String>,
    /// One entry a goal.
    pub goals: Vec<RunGoal>,
}

/// The trials of a run whose method remembers each one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RunTrials {
    /// The run.
    pub run: RunId,
    /// In the order they were made; none where the method remembers none.
    pub trials: Vec<Trial>,
}

/// Discrepancy against evaluations.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Convergence {
    /// The run.
    pub run: RunId,
    /// Points, in the order of evaluations.
    pub points: Vec<ConvergencePoint>,
}

/// One point of a convergence curve.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ConvergencePoint {
    /// Goal index, from 0.
    pub goal_index: u32,
    /// Evaluations since the run began.
    pub evaluations: u64,
    /// Best discrepancy of the observation up to this goal.
    pub discrepancy: f64,
}

/// Which runs.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct RunFilter {
    /// Of this job only.
    pub job: Option<JobId>,
}
