//! Actions, as they are shown.

use super::id::{ActionId, DemonstrationId, JobId};
use super::time::Timestamp;
use crate::framework::Feature;
use crate::framework::generalization::Weighting;
use crate::framework::recognition::Metric;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// One immutable version of an action, without its goals.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ActionView {
    /// Its id.
    pub id: ActionId,
    /// Display name; versions of one action share it.
    pub name: String,
    /// 1 for the first of that name, then counted up.
    pub version: u32,
    /// Features in column order.
    pub features: Vec<Feature>,
    /// Number of goals n.
    pub goals: u32,
    /// Mean duration of the demonstrations, seconds.
    pub mean_duration_s: f64,
    /// Shortest time between goals that was asked for, seconds.
    pub t_min_s: f64,
    /// How samples were weighted.
    pub weighting: Weighting,
    /// Default metric for recognition.
    pub metric: Metric,
    /// What it was made of.
    pub demonstrations: Vec<DemonstrationId>,
    /// The job that made it.
    pub job: JobId,
    /// When it was made.
    pub created_at: Timestamp,
}

/// The matrix X.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ActionGoals {
    /// The action.
    pub action: ActionId,
    /// Features in column order.
    pub features: Vec<Feature>,
    /// One row a goal, one value a feature.
    pub goals: Vec<Vec<f64>>,
    /// Standard deviation of each value over the demonstrations, feature's unit.
    pub spread: Vec<Vec<f64>>,
}

/// The curve through the goals.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Interpolation {
    /// The action.
    pub action: ActionId,
    /// Features in column order.
    pub features: Vec<Feature>,
    /// Where each row lies between the first goal (0) and the last (1).
    pub x: Vec<f64>,
    /// One row a point, one value a feature.
    pub values: Vec<Vec<f64>>,
}
