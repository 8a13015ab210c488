//! Recognition: the question and its answer.

use super::id::{ActionId, DemonstrationId};
use crate::framework::Feature;
use crate::framework::recognition::{FeatureDiscrepancy, Metric};
use crate::framework::tagged;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

tagged! {
    /// The observation: a stored demonstration, or rows.
    #[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
    #[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
    pub enum Observed {
        /// A demonstration that was uploaded before.
        Demonstration {
            /// Id of the demonstration.
            demonstration: DemonstrationId,
        },
        /// Rows in order of time.
        Rows {
            /// Features in column order.
            features: Vec<Feature>,
            /// One row per sample, with one value per feature.
            rows: Vec<Vec<f64>>,
        },
    }
}

/// Request for a recognition.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct RecognizeRequest {
    /// The observation.
    pub observed: Observed,
    /// Candidate actions; if absent or empty, the latest version of every action, at most 200.
    #[serde(default)]
    pub candidates: Vec<ActionId>,
    /// Metric of the discrepancy.
    #[serde(default)]
    pub metric: Metric,
    /// Largest relative discrepancy (dimensionless) of a recognized action; 0.3 if absent.
    #[serde(default)]
    pub threshold: Option<f64>,
}

/// Result of a recognition, best candidate first.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RecognitionView {
    /// The recognized action; absent if *unknown*.
    #[schema(required = true)]
    pub recognized: Option<ActionId>,
    /// Metric in use.
    pub metric: Metric,
    /// Threshold in use, relative discrepancy.
    pub threshold: f64,
    /// All comparable candidates, best first.
    pub candidates: Vec<RecognitionCandidate>,
    /// Candidates whose features were not observed.
    pub incomparable: Vec<IncomparableCandidate>,
}

/// One candidate with its discrepancy.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RecognitionCandidate {
    /// Id of the action.
    pub action: ActionId,
    /// Name shown next to the marker.
    pub name: String,
    /// Discrepancy, features' unit.
    pub discrepancy: f64,
    /// Mean distance of matched rows and goals divided by the action's size, dimensionless.
    pub relative_discrepancy: f64,
    /// Whether the relative discrepancy is within the threshold.
    pub within_threshold: bool,
    /// The discrepancy split by feature.
    pub per_feature: Vec<FeatureDiscrepancy>,
    /// Warping path: pairs of observed row and goal, from 0; empty for `sum_of_features`.
    pub path: Vec<[u32; 2]>,
}

/// A candidate that cannot be compared with the observation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct IncomparableCandidate {
    /// Id of the action.
    pub action: ActionId,
    /// Name shown next to the marker.
    pub name: String,
    /// Feature that is missing or has another unit.
    pub feature: Feature,
    /// Unit in the observation; absent if the feature was not observed.
    #[schema(required = true)]
    pub observed_unit: Option<String>,
}
