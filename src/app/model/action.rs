//! Actions, as shown.

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
    /// Id of this version.
    pub id: ActionId,
    /// Display name; versions of one action share it.
    pub name: String,
    /// Version number: 1 for the first of that name, then counting up.
    pub version: u32,
    /// Features in column order.
    pub features: Vec<Feature>,
    /// Number of goals n.
    pub goals: u32,
    /// Mean duration of the demonstrations, seconds.
    pub mean_duration_s: f64,
    /// T_min, the requested minimum time between goals, seconds.
    pub t_min_s: f64,
    /// Weighting of the samples.
    pub weighting: Weighting,
    /// Default metric for recognition.
    pub metric: Metric,
    /// Demonstrations it was generalized from.
    pub demonstrations: Vec<DemonstrationId>,
    /// Job that created it.
    pub job: JobId,
    /// Creation time.
    pub created_at: Timestamp,
}

/// The matrix X of an action: n goals of m features.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ActionGoals {
    /// Id of the action.
    pub action: ActionId,
    /// Features in column order.
    pub features: Vec<Feature>,
    /// n rows, one per goal, with one value per feature.
    pub goals: Vec<Vec<f64>>,
    /// Standard deviation of each value over the demonstrations, feature's unit.
    pub spread: Vec<Vec<f64>>,
}

/// Points of the curve through an action's goals.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Interpolation {
    /// Id of the action.
    pub action: ActionId,
    /// Features in column order.
    pub features: Vec<Feature>,
    /// Position of each row between the first goal (0) and the last (1).
    pub x: Vec<f64>,
    /// One row per point, with one value per feature.
    pub values: Vec<Vec<f64>>,
}
