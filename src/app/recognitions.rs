//! Recognition: which action an observed stream shows, or none of them.

use crate::app::id::{ActionId, DemonstrationId};
use crate::app::{App, AppError};
use crate::framework::Feature;
use crate::framework::recognition::Metric;
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
    /// Candidate actions; all actions with the observed features when absent or empty.
    #[serde(default)]
    pub candidates: Vec<ActionId>,
    /// How the discrepancy is measured.
    #[serde(default)]
    pub metric: Metric,
    /// Above this discrepancy (features' unit) the best candidate is not recognised.
    #[serde(default)]
    pub threshold: Option<f64>,
}

/// The answer, best candidate first.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RecognitionView {
    /// The recognised action; absent is *unknown*.
    pub recognized: Option<ActionId>,
    /// The metric that was used.
    pub metric: Metric,
    /// The threshold that was used.
    pub threshold: Option<f64>,
    /// Every candidate, best first.
    pub candidates: Vec<RecognitionCandidate>,
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
    /// The discrepancy of each feature alone.
    pub per_feature: Vec<FeatureDiscrepancy>,
    /// Warping path: pairs of sample index and goal index.
    pub path: Vec<[u32; 2]>,
}

/// One feature's part.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct FeatureDiscrepancy {
    /// The feature.
    pub feature: Feature,
    /// Its discrepancy, the feature's unit.
    pub discrepancy: f64,
}

impl App {
    /// Compares what was observed with the candidates, at once.
    ///
    /// # Errors
    /// `Invalid` request; `NotFound` demonstration or candidate.
    pub async fn recognize(&self, request: RecognizeRequest) -> Result<RecognitionView, AppError> {
        let _ = request;
        Err(self.unfinished())
    }
}
