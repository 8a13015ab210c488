//! A run, its goals and its convergence.

use super::tally::{Tally, complete_tally};
use super::{complete, document, versions};
use crate::app::model::{
    ActionId, ConvergencePoint, JobId, PathPose, RobotId, RunGoal, RunGoals as Goals, RunId, RunView, Timestamp,
    TrajectoryId, WorldId,
};
use crate::framework::CellSet;
use crate::framework::Feature;
use crate::framework::execution::{DiscrepancyEstimate, Judgement, Replay, RunVerdict};
use crate::framework::infinite_as_null;
use crate::framework::method::per_goal::{Provenance, StopReason};
use crate::framework::motion::JointStep;
use crate::framework::recognition::Metric;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

document! {
    /// A run without its goals.
    Run keeps RunView {
        id: RunId,
        job: JobId,
        repetition: u32,
        action: ActionId,
        robot: RobotId,
        world: WorldId,
        method: String,
        metric: Metric,
        seed: u64,
        evaluations: u64,
        #[serde(with = "infinite_as_null::number")]
        discrepancy: f64,
        true_discrepancy: Option<f64>,
        estimate: Option<DiscrepancyEstimate>,
        verdict: Option<RunVerdict>,
        valid: bool,
        painted_percent: Option<f64>,
        goals: u32,
        largest_step: Option<JointStep>,
        replay: Option<Replay>,
        digest: String,
        trajectory: Option<TrajectoryId>,
        trajectory_problem: Option<String>,
        created_at: Timestamp,
    }
    with { provenance: Tally, }
}
// Version 2 is that of the builds without verdicts and estimates: what is missing is read as none.
versions! { Run keeps RunView, "run", [with_constraints, with_largest_step, with_replay] }

/// Version 0 of the builds without constraints: every run was valid, and nothing was counted.
fn with_constraints(mut run: Value) -> Value {
    complete(&mut run, "valid", true);
    complete_tally(&mut run);
    run
}

/// Version 1 of the builds that did not measure steps.
fn with_largest_step(mut run: Value) -> Value {
    complete(&mut run, "largest_step", Value::Null);
    run
}

/// Version 2 of the builds that did not replay their runs.
fn with_replay(mut run: Value) -> Value {
    complete(&mut run, "replay", Value::Null);
    run
}

document! {
    /// All goals of a run.
    RunGoals keeps Goals {
        run: RunId,
        features: Vec<Feature>,
        joint_names: Vec<String>,
        painted_cells: Option<CellSet>,
    }
    each { goals: ReachedGoal, path: KeptPose, }
}
versions! { RunGoals keeps Goals, "goals", [with_winners, with_path] }

/// Version 1 of the builds whose trajectories had one pose per goal.
fn with_path(mut goals: Value) -> Value {
    complete(&mut goals, "path", json!([]));
    complete(&mut goals, "painted_cells", Value::Null);
    goals
}

document! {
    /// One pose of a run's path.
    KeptPose keeps PathPose {
        joints: Vec<f64>,
        goals: Vec<u32>,
    }
}

document! {
    /// One goal of a run.
    ReachedGoal keeps RunGoal {
        index: u32,
        evaluations: u64,
        #[serde(with = "infinite_as_null::number")]
        discrepancy: f64,
        stop_reason: StopReason,
        judgement: Option<Judgement>,
        joints: Vec<f64>,
        #[serde(with = "infinite_as_null")]
        observation: Vec<f64>,
        goal: Vec<f64>,
        residual: Option<f64>,
        winner: Provenance,
        true_discrepancy: Option<f64>,
        feasible: bool,
    }
    with { provenance: Tally, }
}

/// Version 0 of the builds without constraints executed every candidate and found each one feasible.
fn with_winners(mut goals: Value) -> Value {
    for goal in goals.get_mut("goals").and_then(Value::as_array_mut).into_iter().flatten() {
        complete(goal, "winner", "simulated");
        complete(goal, "feasible", true);
        complete_tally(goal);
    }
    goals
}

/// Discrepancy over evaluations.
#[derive(Debug, Serialize, Deserialize)]
pub(in crate::store) struct Convergence {
    points: Vec<Point>,
}
versions! { Convergence keeps Vec<ConvergencePoint>, "convergence", [|points| json!({ "points": points })] }

document! {
    /// One point of a convergence curve.
    Point keeps ConvergencePoint {
        goal_index: u32,
        evaluations: u64,
        #[serde(with = "infinite_as_null::number")]
        discrepancy: f64,
    }
}

impl From<Vec<ConvergencePoint>> for Convergence {
    fn from(points: Vec<ConvergencePoint>) -> Self {
        Self { points: points.into_iter().map(Into::into).collect() }
    }
}

impl From<Convergence> for Vec<ConvergencePoint> {
    fn from(document: Convergence) -> Self {
        document.points.into_iter().map(Into::into).collect()
    }
}
