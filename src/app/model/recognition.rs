//! Recognition: the question and its answer.

use super::id::{ActionId, DemonstrationId};
use crate::framework::Feature;
use crate::framework::recognition::{FeatureDiscrepancy, Metric};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// What was observed: a demonstration of the service, or rows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Observed {
    /// A demonstration that was uploaded.
    Demonstration {
        /// Its id.
        demonstration: DemonstrationId,
    },
    /// Rows, in the order of time.
    Rows {
        /// Features in column order.
        features: Vec<Feature>,
        /// One row a sample, one value a feature.
        rows: Vec<Vec<f64>>,
    },
}

/// A question of recognition.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct RecognizeRequest {
    /// What was observed.
    pub observed: Observed,
    /// Candidate actions; when absent or empty, the latest version of every action, at most 200.
    #[serde(default)]
    pub candidates: Vec<ActionId>,
    /// How the discrepancy is measured.
    #[serde(default)]
    pub metric: Metric,
    /// Largest relative discrepancy of a recognised action (no unit); 0.3 when absent.
    #[serde(default)]
    pub threshold: Option<f64>,
}

/// The answer, best candidate first.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RecognitionView {
    /// The recognised action; absent is *unknown*.
    pub recognized: Option<ActionId>,
    /// The metric in use.
    pub metric: Metric,
    /// The threshold in use, relative discrepancy.
    pub threshold: f64,
    /// Every comparable candidate, best first.
    pub candidates: Vec<RecognitionCandidate>,
    /// Candidates whose features were not observed.
    pub incomparable: Vec<IncomparableCandidate>,
}

/// One candidate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RecognitionCandidate {
    /// The action.
    pub action: ActionId,
    /// Its name.
    pub name: String,
    /// Discrepancy, features' unit.
    pub discrepancy: f64,
    /// Discrepancy over the number of matched pairs and the size of the action, no unit.
    pub relative_discrepancy: f64,
    /// Whether it is within the threshold.
    pub within_threshold: bool,
    /// The discrepancy split by feature.
    pub per_feature: Vec<FeatureDiscrepancy>,
    /// Warping path: pairs of observed row and goal, from 0; empty for `sum_of_features`.
    pub path: Vec<[u32; 2]>,
}

/// A candidate that cannot be compared with what was observed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct IncomparableCandidate {
    /// The action.
    pub action: ActionId,
    /// Its name.
    pub name: String,
    /// The feature that is missing or in another unit.
    pub feature: Feature,
    /// Unit in which it was observed; absent where it was not observed.
    pub observed_unit: Option<String>,
}
