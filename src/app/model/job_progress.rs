//! Progress of a job: counts, finished goals, trials.

use super::run::RunGoal;
use crate::framework::execution::Judgement;
use crate::framework::method::per_goal::StopReason;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Progress of a job.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct JobProgress {
    /// Finished share, 0 to 1.
    pub fraction: f64,
    /// Current repetition, from 0.
    pub repetition: u32,
    /// Number of repetitions.
    pub repetitions: u32,
    /// Current goal of the current repetition, from 0.
    pub goal_index: u32,
    /// Number of goals.
    pub goals: u32,
    /// Evaluations of the current repetition.
    pub evaluations: u64,
    /// Evaluations of the current goal.
    pub goal_evaluations: u64,
    /// Evaluations of all repetitions.
    pub total_evaluations: u64,
    /// Best discrepancy of the current goal, features' unit; absent before the first evaluation.
    #[schema(required = true)]
    pub discrepancy: Option<f64>,
    /// Finished goals of the current repetition; empty in events, which report each goal once.
    pub finished_goals: Vec<GoalProgress>,
    /// Trials of the current repetition if the method plans the whole run; likewise empty in events.
    pub trials: Vec<TrialProgress>,
}

/// One trial of a method that plans the whole run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct TrialProgress {
    /// Repetition, from 0.
    pub repetition: u32,
    /// Index of the trial, from 0.
    pub index: u32,
    /// The goal it was made for, from 0.
    pub goal: u32,
    /// Distance of the observation from that goal (Euclidean, features' unit); absent if the observation was lost.
    #[schema(required = true)]
    pub residual: Option<f64>,
}

/// One finished goal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct GoalProgress {
    /// Repetition, from 0.
    pub repetition: u32,
    /// Index of the goal, from 0.
    pub index: u32,
    /// Evaluations of this goal.
    pub evaluations: u64,
    /// Discrepancy of the observation up to this goal, features' unit.
    pub discrepancy: f64,
    /// Reason why the goal ended.
    pub stop_reason: StopReason,
    /// Verdict on the goal; absent in events of earlier versions.
    #[schema(required = true)]
    pub judgement: Option<Judgement>,
    /// Free joints, rad or m.
    pub joints: Vec<f64>,
    /// Observation at these joints.
    pub observation: Vec<f64>,
    /// Distance of the observation from the goal (Euclidean, features' unit): for a goal missed the best found.
    #[schema(required = true)]
    pub residual: Option<f64>,
}

impl GoalProgress {
    /// Progress from a goal of a finished run.
    #[must_use]
    pub fn of_run(repetition: u32, goal: &RunGoal) -> Self {
        Self {
            repetition,
            index: goal.index,
            evaluations: goal.evaluations,
            discrepancy: goal.discrepancy,
            stop_reason: goal.stop_reason,
            judgement: goal.judgement,
            joints: goal.joints.clone(),
            observation: goal.observation.clone(),
            residual: goal.residual,
        }
    }
}
