//! Results of an execution, goal by goal, and progress of a running one.

use super::path::{Executed, PathPose};
use super::true_discrepancy::DiscrepancyEstimate;
use super::verdict::{Judgement, RunVerdict};
use crate::method::per_goal::{Provenance, StopReason, Tally};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// An improvement of the best discrepancy.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TracePoint {
    /// Number of evaluations for this goal so far, including this one.
    pub evaluations: u64,
    /// Best discrepancy since the start of the goal.
    pub discrepancy: f64,
}

/// Result of one goal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GoalResult {
    /// Goal index from 0.
    pub index: usize,
    /// Number of evaluations for this goal.
    pub evaluations: u64,
    /// Number of trials of this goal that could not be executed; they do not count as evaluations.
    pub failures: u64,
    /// Discrepancy of the whole partial observation O_1..O_j against X_1..X_j, features' unit.
    pub discrepancy: f64,
    /// Discrepancy of the winner when executed; `None` unless `discrepancy` is an estimate for a winner that the search
    /// never executed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub true_discrepancy: Option<f64>,
    /// Reason why the search for this goal ended.
    pub stop_reason: StopReason,
    /// Verdict on this goal; decided anew from the rest when a run is resumed.
    #[serde(default)]
    pub judgement: Judgement,
    /// U_j: free joints in gene order, rad or m.
    pub joints: Vec<f64>,
    /// O_j: the observed features, in the goals' order.
    pub observation: Vec<f64>,
    /// Origin of the discrepancy.
    pub provenance: Provenance,
    /// Whether the joints satisfy the constraints; true if there are none.
    #[serde(default = "satisfied")]
    pub feasible: bool,
    /// Number of fitness values of this goal by origin.
    #[serde(default)]
    pub tally: Tally,
    /// Convergence: one point per improvement, thinned evenly beyond 256.
    pub trace: Vec<TracePoint>,
}

/// Progress of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Progress {
    /// Index of the goal being searched; equal to `goals` if finished.
    pub goal_index: usize,
    /// Number of goals n.
    pub goals: usize,
    /// Number of evaluations over all goals so far.
    pub evaluations: u64,
    /// Number of evaluations for the current goal.
    pub goal_evaluations: u64,
    /// Best discrepancy for the current goal; `None` before the first evaluation.
    pub best_discrepancy: Option<f64>,
    /// Whether every goal has ended.
    pub finished: bool,
    /// Results of the goals that have ended.
    pub results: Vec<GoalResult>,
}

/// A finished run of one seed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunResult {
    /// Seed of the run.
    pub seed: u64,
    /// Number of evaluations over all goals.
    pub evaluations: u64,
    /// Discrepancy after the last goal, features' unit.
    pub discrepancy: f64,
    /// Discrepancy of the last goal's winner when executed; `None` unless `discrepancy` is an estimate for a winner
    /// that the search never executed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub true_discrepancy: Option<f64>,
    /// Estimate of the discrepancy of the winners' undisturbed effects; `None` unless the method models the features and
    /// was told their noise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub estimate: Option<DiscrepancyEstimate>,
    /// Whether the last goal's joints satisfy the constraints; true if there are none.
    #[serde(default = "satisfied")]
    pub valid: bool,
    /// Number of fitness values of all goals by origin.
    #[serde(default)]
    pub tally: Tally,
    /// Painted share, %. Goal-by-goal methods: the value closest to 100 among the last goal's executed candidates.
    /// Whole-run methods: the share after all accepted trials; 0 if none was accepted. `None` unless the world is a
    /// surface.
    pub painted_percent: Option<f64>,
    /// All goals, in order.
    pub goals: Vec<GoalResult>,
    /// The poses that leave the run's effect, in order of execution.
    #[serde(default)]
    pub path: Vec<PathPose>,
    /// SHA-256 (hex) of each goal's joints, evaluations and discrepancy, to the last bit.
    pub digest: String,
}

impl GoalResult {
    pub(super) fn executed(&self) -> Executed<'_> {
        Executed { joints: &self.joints, observation: Some(&self.observation) }
    }
}

fn satisfied() -> bool {
    true
}

impl RunResult {
    /// U_1..U_n, one row per goal.
    #[must_use]
    pub fn waypoints(&self) -> Vec<Vec<f64>> {
        self.goals.iter().map(|g| g.joints.clone()).collect()
    }

    /// The verdict on the run.
    #[must_use]
    pub fn verdict(&self) -> RunVerdict {
        let goals: Vec<_> = self.goals.iter().map(|goal| (goal.judgement.verdict, goal.feasible)).collect();
        RunVerdict::of(&goals)
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

/// Maximum number of points in a trace.
const TRACE_LIMIT: usize = 256;

/// Records an improvement; beyond the limit, every second point except the last is dropped.
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
