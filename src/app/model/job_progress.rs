//! Progress of a job: counts, finished goals, trials.

use super::run::RunGoal;
use crate::framework::method::per_goal::StopReason;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// How far a job is.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct JobProgress {
    /// Finished share, 0 to 1.
    pub fraction: f64,
    /// Present repetition, from 0.
    pub repetition: u32,
    /// Number of repetitions.
    pub repetitions: u32,
    /// Present goal of the present repetition, from 0.
    pub goal_index: u32,
    /// Number of goals.
    pub goals: u32,
    /// Evaluations of the present repetition.
    pub evaluations: u64,
    /// Evaluations of the present goal.
    pub goal_evaluations: u64,
    /// Evaluations of all repetitions.
    pub total_evaluations: u64,
    /// Best discrepancy of the present goal, features' unit.
    #[schema(required = true)]
    pub discrepancy: Option<f64>,
    /// Finished goals of the present repetition; left out of events, which tell each goal once.
    pub finished_goals: Vec<GoalProgress>,
    /// Trials of the present repetition, where the method remembers each one; left out of events likewise.
    pub trials: Vec<TrialProgress>,
}

/// One trial of a method that owns the whole run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct TrialProgress {
    /// Repetition, from 0.
    pub repetition: u32,
    /// Trial, from 0.
    pub index: u32,
    /// The goal it was made for, from 0.
    pub goal: u32,
    /// Distance of what was observed from that goal (Euclidean, features' unit); none when the observation was lost.
    #[schema(required = true)]
    pub residual: Option<f64>,
}

/// One finished goal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct GoalProgress {
    /// Repetition, from 0.
    pub repetition: u32,
    /// Goal, from 0.
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
    /// Distance of the observation from the goal (Euclidean, features' unit): for a goal out of reach the best found.
    #[schema(required = true)]
    pub residual: Option<f64>,
}

impl GoalProgress {
    /// The same goal, as the run shows it.
    #[must_use]
    pub fn of_run(repetition: u32, goal: &RunGoal) -> Self {
        Self {
            repetition,
            index: goal.index,
            evaluations: goal.evaluations,
            discrepancy: goal.discrepancy,
            stop_reason: goal.stop_reason,
            joints: goal.joints.clone(),
            observation: goal.observation.clone(),
            residual: goal.residual,
        }
    }
}
