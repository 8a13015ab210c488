//! Progress of a job, with the finished goals and the trials of its present repetition.

use super::{complete, document, unchanged, versions};
use crate::app::model::{GoalProgress, JobProgress, TrialProgress};
use crate::framework::execution::Judgement;
use crate::framework::infinite_as_null;
use crate::framework::method::per_goal::StopReason;
use serde_json::{Value, json};

document! {
    /// Progress of a job.
    Progress keeps JobProgress {
        fraction: f64,
        repetition: u32,
        repetitions: u32,
        goal_index: u32,
        goals: u32,
        evaluations: u64,
        goal_evaluations: u64,
        total_evaluations: u64,
        discrepancy: Option<f64>,
    }
    each { finished_goals: Goal, trials: Trial, }
}
// Version 1 is that of the builds without verdicts: what is missing is read as none.
versions! { Progress keeps JobProgress, "progress", [with_trials, unchanged] }

/// Version 0 of the builds before methods that remember their trials has none.
pub(super) fn with_trials(mut progress: Value) -> Value {
    complete(&mut progress, "trials", json!([]));
    progress
}

document! {
    /// A finished goal.
    Goal keeps GoalProgress {
        repetition: u32,
        index: u32,
        evaluations: u64,
        #[serde(with = "infinite_as_null::number")]
        discrepancy: f64,
        stop_reason: StopReason,
        judgement: Option<Judgement>,
        joints: Vec<f64>,
        #[serde(with = "infinite_as_null")]
        observation: Vec<f64>,
        residual: Option<f64>,
    }
}

document! {
    /// A trial and its residual.
    Trial keeps TrialProgress {
        repetition: u32,
        index: u32,
        goal: u32,
        residual: Option<f64>,
    }
}
