//! State of a run: saved at any point, resumed bit for bit.

use super::error::ProblemError;
use super::result::{GoalResult, TracePoint};
use crate::constraint::JudgeState;
use crate::method::per_goal::{OptimizerError, OptimizerState, StopReason};
use crate::method::whole_run::Trial;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// Version of [`IetState`]; incremented when its meaning changes.
pub(super) const STATE_VERSION: u32 = 1;

/// A saved run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct IetState {
    pub(super) version: u32,
    pub(super) seed: u64,
    pub(super) results: Vec<GoalResult>,
    pub(super) evaluations: u64,
    pub(super) goal: GoalState,
    pub(super) painted: Option<f64>,
    pub(super) optimizer: Option<OptimizerState>,
    /// State of the judge; `None` if there are no constraints.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) judge: Option<JudgeState>,
    /// Trials of a method that plans the whole run; empty for other methods.
    #[serde(default)]
    pub(super) log: Vec<Trial>,
}

/// State of the goal being searched.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct GoalState {
    pub evaluations: u64,
    pub failures: u64,
    pub best: Option<f64>,
    pub painted: Option<f64>,
    pub trace: Vec<TracePoint>,
    /// Number of evaluations executed on a robot.
    pub real: u64,
    /// Reason why the search is over, while its winner waits to be executed.
    pub ended: Option<StopReason>,
}

impl IetState {
    /// Seed of the saved run.
    #[must_use]
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// Number of evaluations made before it was saved.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// This state in the present layout: earlier builds saved the optimiser inside the state of the judge.
    ///
    /// # Errors
    /// [`OptimizerError::Memory`] if that state cannot be read.
    pub(super) fn upgraded(self) -> Result<Self, OptimizerError> {
        const ENCLOSING: &str = "constrained";
        let Some(state) = self.optimizer.clone().filter(|state| state.method() == ENCLOSING) else { return Ok(self) };
        let unreadable = |source| OptimizerError::Memory { method: ENCLOSING, source };
        let mut judge: Map<String, Value> = state.read(ENCLOSING)?;
        let inner = judge.remove("inner").unwrap_or_default();
        Ok(Self {
            optimizer: Some(serde_json::from_value(inner).map_err(unreadable)?),
            judge: Some(serde_json::from_value(judge.into()).map_err(unreadable)?),
            ..self
        })
    }

    /// Checks that the state fits a problem with n `goals`, poses of `genes` joints and m `features`.
    pub(super) fn check(
        &self,
        is_whole_run: bool,
        goals: usize,
        genes: usize,
        features: usize,
    ) -> Result<(), ProblemError> {
        if self.version != STATE_VERSION {
            return Err(ProblemError::Version { found: self.version, expected: STATE_VERSION });
        }
        let shape = |what, found, expected| Err(ProblemError::Shape { what, found, expected });
        if self.results.len() > goals {
            return shape("finished goals", self.results.len(), goals);
        }
        let searching = usize::from(self.optimizer.is_some());
        if !is_whole_run && searching != usize::from(self.results.len() < goals) {
            return shape("goals being searched", searching, 1 - searching);
        }
        for trial in &self.log {
            if trial.joints.len() != genes {
                return shape("joints", trial.joints.len(), genes);
            }
        }
        for result in &self.results {
            if result.joints.len() != genes {
                return shape("joints", result.joints.len(), genes);
            }
            if result.observation.len() != features {
                return shape("features", result.observation.len(), features);
            }
        }
        Ok(())
    }
}
