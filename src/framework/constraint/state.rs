//! State of the judge of one goal; saved and resumed as it is.

use super::penalty::PenaltyState;
use crate::method::per_goal::{Incumbent, OptimizerError, SearchSpace, Tally};
use crate::random::RandomStream;
use serde::{Deserialize, Serialize};

/// Version of [`JudgeState`]; incremented when its meaning changes.
pub(super) const STATE_VERSION: u32 = 1;

/// A candidate handed out and not reported back yet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Judged {
    pub id: u64,
    pub joints: Vec<f64>,
    /// One violation per constraint; empty if the candidate is feasible.
    pub violations: Vec<f64>,
}

/// Complete state of the judge of a goal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JudgeState {
    pub(super) version: u32,
    pub(super) rng: RandomStream,
    pub(super) penalty: PenaltyState,
    pub(super) generation: u64,
    /// Number of consecutive rejections.
    pub(super) attempts: u32,
    pub(super) waiting: Vec<Judged>,
    pub(super) known: Option<Incumbent>,
    /// The smallest violations of an infeasible candidate, one per constraint.
    pub(super) nearest: Option<Vec<f64>>,
    pub(super) tally: Tally,
}

impl JudgeState {
    pub(super) fn check(&self, space: &SearchSpace) -> Result<(), OptimizerError> {
        let method = "judge";
        if self.version != STATE_VERSION {
            return Err(OptimizerError::Version { method, found: self.version, expected: STATE_VERSION });
        }
        let genes = self.known.as_ref().map_or(space.lower.len(), |known| known.joints.len());
        let features = self.known.as_ref().map_or(space.features, |known| known.observation.len());
        for (what, found, expected) in
            [("genes of the best", genes, space.lower.len()), ("features of the best", features, space.features)]
        {
            if found != expected {
                return Err(OptimizerError::Shape { method, what, found, expected });
            }
        }
        Ok(())
    }
}
