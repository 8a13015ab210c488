//! What an execution yields, goal by goal, and what can be told of one that runs.

use crate::method::per_goal::{Provenance, StopReason, Tally};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use utoipa::ToSchema;

/// A discrepancy that was the best so far, and when.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct TracePoint {
    /// Evaluations of this goal until then, this one included.
    pub evaluations: u64,
    /// Best discrepancy since the goal began.
    pub discrepancy: f64,
}

/// How one goal ended.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct GoalResult {
    /// Goal index from 0.
    pub index: usize,
    /// Evaluations of this goal.
    pub evaluations: u64,
    /// Trials of this goal that could not be executed; they are no evaluations.
    pub failures: u64,
    /// Discrepancy of the whole partial observation O_1..O_j against X_1..X_j, features' unit.
    pub discrepancy: f64,
    /// What the winner really does, where `discrepancy` is the value of one that was never executed by the search.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub true_discrepancy: Option<f64>,
    /// Why the search for this goal ended.
    pub stop_reason: StopReason,
    /// U_j: free joints in gene order, rad or m.
    pub joints: Vec<f64>,
    /// O_j: the features seen, in the goals' order.
    pub observation: Vec<f64>,
    /// Where the discrepancy comes from.
    pub provenance: Provenance,
    /// Whether the joints satisfy the constraints; true where there are none.
    #[serde(default = "satisfied")]
    pub feasible: bool,
    /// Where the fitness values of this goal come from, by count.
    #[serde(default)]
    pub tally: Tally,
    /// Convergence: one point an improvement, thinned out evenly beyond 256.
    pub trace: Vec<TracePoint>,
}

/// Where a run stands.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Progress {
    /// Index of the goal being searched; equal to `goals` when finished.
    pub goal_index: usize,
    /// Number of goals n.
    pub goals: usize,
    /// Evaluations of all goals so far.
    pub evaluations: u64,
    /// Evaluations of the goal being searched.
    pub goal_evaluations: u64,
    /// Best discrepancy of the goal being searched.
    pub best_discrepancy: Option<f64>,
    /// Whether every goal has ended.
    pub finished: bool,
    /// The goals that have ended.
    pub results: Vec<GoalResult>,
}

/// A finished run: one seed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RunResult {
    /// The seed.
    pub seed: u64,
    /// Evaluations of all goals.
    pub evaluations: u64,
    /// Discrepancy at the last goal, features' unit.
    pub discrepancy: f64,
    /// What the last goal's winner really does, where `discrepancy` is the value of one that was never executed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub true_discrepancy: Option<f64>,
    /// Whether the last goal's joints satisfy the constraints; true where there are none.
    #[serde(default = "satisfied")]
    pub valid: bool,
    /// Where the fitness values of all goals come from, by count.
    #[serde(default)]
    pub tally: Tally,
    /// Coverage worlds: over the last goal's executed candidates, the percentage nearest 100; for a method that owns
    /// the run, what the trials whose effect stays have painted. 0 where there is none.
    pub painted_percent: Option<f64>,
    /// All goals, in order.
    pub goals: Vec<GoalResult>,
    /// SHA-256 (hex) of each goal's joints, evaluations and discrepancy, to the last bit.
    pub digest: String,
}

fn satisfied() -> bool {
    true
}

impl RunResult {
    /// U_1..U_n, one row a goal.
    #[must_use]
    pub fn waypoints(&self) -> Vec<Vec<f64>> {
        self.goals.iter().map(|g| g.joints.clone()).collect()
    }
}

/// SHA-256 over goals in order: number of joints, joints, evaluations, discrepancy; all little-endian 64-bit words.
pub(super) fn digest(goals: &[GoalResult]) -> String {
    let mut hash = Sha256::new();
    for goal in goals {
        hash.update((goal.joints.len() as u64).to_le_bytes());
        for joint in &goal.joints {
            hash.update(joint.to_bits().to_le_bytes());
        }
        hash.update(goal.evaluations.to_le_bytes());
        hash.update(goal.discrepancy.to_bits().to_le_bytes());
    }
    hex::encode(hash.finalize())
}

/// Most points a trace keeps.
const TRACE_LIMIT: usize = 256;

/// Records an improvement; beyond the limit every second point but the last goes.
pub(super) fn record(trace: &mut Vec<TracePoint>, point: TracePoint) {
    trace.push(point);
    if trace.len() > TRACE_LIMIT {
        let last = trace.len() - 1;
        let mut index = 0;
        trace.retain(|_| {
            let keep = index % 2 == 0 || index == last;
            index += 1;
            keep
        });
    }
}
