//! Runs, their goals, trials and convergence, as shown.

use super::id::{ActionId, JobId, RobotId, RunId, TrajectoryId, WorldId};
use super::time::Timestamp;
use crate::framework::CellSet;
use crate::framework::Feature;
use crate::framework::execution::{DiscrepancyEstimate, Judgement, Replay, RunVerdict};
use crate::framework::method::per_goal::{Provenance, StopReason, Tally};
use crate::framework::method::whole_run::Trial;
use crate::framework::motion::JointStep;
use crate::framework::recognition::Metric;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// One finished repetition.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RunView {
    /// Id of the run.
    pub id: RunId,
    /// Job it belongs to.
    pub job: JobId,
    /// Repetition, from 0.
    pub repetition: u32,
    /// Action that was executed.
    pub action: ActionId,
    /// Robot that executed it.
    pub robot: RobotId,
    /// World it was executed in.
    pub world: WorldId,
    /// Method name, for example `sst`.
    pub method: String,
    /// Metric of the discrepancies.
    pub metric: Metric,
    /// Seed of the repetition.
    pub seed: u64,
    /// Number of evaluations over all goals.
    pub evaluations: u64,
    /// Discrepancy of the whole observation, features' unit.
    pub discrepancy: f64,
    /// Discrepancy of the last goal's winner when executed; absent unless `discrepancy` is an estimate.
    #[schema(required = true)]
    pub true_discrepancy: Option<f64>,
    /// Estimate of the discrepancy of the winners' undisturbed effects, with its interval of 95 %; absent unless the method
    /// models the features (`model`) and was told their `noise`: other methods have nothing to tell noise from effect by.
    #[schema(required = true)]
    pub estimate: Option<DiscrepancyEstimate>,
    /// Verdict on the run; absent for runs of earlier versions.
    #[schema(required = true)]
    pub verdict: Option<RunVerdict>,
    /// Whether the last goal's joints satisfy the constraints; true if there are none.
    pub valid: bool,
    /// Number of fitness values of all goals by origin.
    pub provenance: Tally,
    /// Painted share that the trajectory leaves, %, by its replay; absent unless the world is a surface.
    #[schema(required = true)]
    pub painted_percent: Option<f64>,
    /// Number of goals.
    pub goals: u32,
    /// Largest move of one joint between successive goals, the first from the robot's home pose; 1 rad counts as much
    /// as 1 m. Absent for runs of earlier versions.
    #[schema(required = true)]
    pub largest_step: Option<JointStep>,
    /// Effect of the poses and of the motion when they were executed once more, in simulation, before the run was stored;
    /// absent for runs of earlier versions.
    #[schema(required = true)]
    pub replay: Option<Replay>,
    /// SHA-256 of the result's bits, hexadecimal.
    pub digest: String,
    /// Trajectory; absent if none stays within the limits, as `trajectory_problem` explains.
    #[schema(required = true)]
    pub trajectory: Option<TrajectoryId>,
    /// Reason why there is no trajectory; absent if there is one.
    #[schema(required = true)]
    pub trajectory_problem: Option<String>,
    /// Time at which it ended.
    pub created_at: Timestamp,
}

#[cfg(test)]
use crate::framework::execution::{AlongMotion, RunOutcome};

#[cfg(test)]
impl RunView {
    /// A valid run without a trajectory, for tests.
    pub(crate) fn sample() -> Self {
        let id = uuid::Uuid::from_u128(1);
        Self {
            id: RunId::from_uuid(id),
            job: JobId::from_uuid(id),
            repetition: 0,
            action: ActionId::from_uuid(id),
            robot: RobotId::from_uuid(id),
            world: WorldId::from_uuid(id),
            method: "sst".to_owned(),
            metric: Metric::default(),
            seed: 7,
            evaluations: 10,
            discrepancy: 0.1 + 0.2,
            true_discrepancy: None,
            estimate: Some(DiscrepancyEstimate { value: 0.3, lower: 0.2, upper: 0.5 }),
            verdict: Some(RunVerdict {
                outcome: RunOutcome::GoalsMissed,
                reached: 6,
                stopped_short: 2,
                out_of_reach: 1,
            }),
            valid: true,
            provenance: Tally { simulated: 9, inherited: 2, ..Tally::default() },
            painted_percent: None,
            goals: 0,
            largest_step: Some(JointStep { joint: "j2".to_owned(), goal_index: 1, size: 0.4 }),
            replay: Some(Replay {
                discrepancy: 0.3,
                painted_percent: None,
                along: Some(AlongMotion { discrepancy: 0.4, painted_percent: None }),
                largest_difference: None,
                agrees: true,
            }),
            digest: "d".to_owned(),
            trajectory: None,
            trajectory_problem: Some("too steep".to_owned()),
            created_at: Timestamp(1_700_000_000_000),
        }
    }
}

/// One goal of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RunGoal {
    /// Index of the goal, from 0.
    pub index: u32,
    /// Number of evaluations for this goal.
    pub evaluations: u64,
    /// Discrepancy of the observation up to this goal, features' unit.
    pub discrepancy: f64,
    /// Reason why the goal ended.
    pub stop_reason: StopReason,
    /// Verdict on the goal; absent for runs of earlier versions.
    #[schema(required = true)]
    pub judgement: Option<Judgement>,
    /// Free joints, rad or m.
    pub joints: Vec<f64>,
    /// Observation at these joints.
    pub observation: Vec<f64>,
    /// Requested features.
    pub goal: Vec<f64>,
    /// Distance of `observation` from `goal` (Euclidean, features' unit), the smallest one found if the goal is
    /// missed.
    #[schema(required = true)]
    pub residual: Option<f64>,
    /// Origin of the winner's discrepancy.
    pub winner: Provenance,
    /// Discrepancy of the winner when executed; absent unless `discrepancy` is an estimate.
    #[schema(required = true)]
    pub true_discrepancy: Option<f64>,
    /// Whether the joints satisfy the constraints; true if there are none.
    pub feasible: bool,
    /// Number of fitness values of this goal by origin.
    pub provenance: Tally,
}

/// All goals of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RunGoals {
    /// Id of the run.
    pub run: RunId,
    /// Features, in the order of `goal` and `observation`.
    pub features: Vec<Feature>,
    /// Free joints, in the order of `joints`.
    pub joint_names: Vec<String>,
    /// One entry per goal.
    pub goals: Vec<RunGoal>,
    /// The poses of the trajectory in order: every trial whose effect stays, with the goals it serves. Empty for runs of
    /// earlier versions.
    pub path: Vec<PathPose>,
    /// The cells that the path covers by its replay, 64 per word, row-major, lowest bit first; absent unless the world
    /// is a surface.
    #[schema(value_type = Option<Vec<u64>>, required = true)]
    pub painted_cells: Option<CellSet>,
}

/// One pose of a run's path.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PathPose {
    /// Free joints, rad or m; equal to those found by the search up to whole turns of a joint.
    pub joints: Vec<f64>,
    /// Indices of the goals it serves, from 0; empty for a trial that left an effect but serves no goal.
    pub goals: Vec<u32>,
}

/// Trials of a run whose method plans the whole run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RunTrials {
    /// Id of the run.
    pub run: RunId,
    /// Trials in the order they were made; empty for methods that search goal by goal.
    pub trials: Vec<Trial>,
}

/// Discrepancy against evaluations.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Convergence {
    /// Id of the run.
    pub run: RunId,
    /// Points, in the order of evaluations.
    pub points: Vec<ConvergencePoint>,
}

/// One point of a convergence curve.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ConvergencePoint {
    /// Goal index, from 0.
    pub goal_index: u32,
    /// Number of evaluations since the run began.
    pub evaluations: u64,
    /// Best discrepancy of the observation up to this goal, features' unit.
    pub discrepancy: f64,
}

/// Filter of a list of runs.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct RunFilter {
    /// Job of the runs; all if `None`.
    pub job: Option<JobId>,
}
