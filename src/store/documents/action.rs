//! One version of an action, and its goals.

use super::{document, unchanged, versions};
use crate::app::model::{ActionGoals, ActionId, ActionView, DemonstrationId, JobId, Timestamp};
use crate::framework::Feature;
use crate::framework::generalization::Weighting;
use crate::framework::recognition::Metric;

document! {
    /// An action without its goals.
    Action keeps ActionView {
        id: ActionId,
        name: String,
        version: u32,
        features: Vec<Feature>,
        goals: u32,
        mean_duration_s: f64,
        t_min_s: f64,
        weighting: Weighting,
        metric: Metric,
        demonstrations: Vec<DemonstrationId>,
        job: JobId,
        created_at: Timestamp,
    }
}
versions! { Action keeps ActionView, "action", [unchanged] }

document! {
    /// The goals of an action.
    GoalMatrix keeps ActionGoals {
        action: ActionId,
        features: Vec<Feature>,
        goals: Vec<Vec<f64>>,
        spread: Vec<Vec<f64>>,
    }
}
versions! { GoalMatrix keeps ActionGoals, "goals", [unchanged] }
