//! Recognition: which action an observed stream shows, or none of them.

use crate::app::actions::ActionView;
use crate::app::id::{ActionId, DemonstrationId};
use crate::app::{App, AppError, ErrorKind, MAX_PAGE_SIZE, PageQuery, compute};
use crate::framework::Feature;
use crate::framework::generalization::Goals;
use crate::framework::recognition::{
    FeatureDiscrepancy, Metric, Recognition, RecognizeError, RecognizeSpec, observed_rows, recognize,
};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
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

impl App {
    /// Compares what was observed with the candidates, at once.
    ///
    /// # Errors
    /// `Invalid` request, references to nothing included.
    pub async fn recognize(&self, request: RecognizeRequest) -> Result<RecognitionView, AppError> {
        let observed = self.observed(request.observed).await?;
        let actions = self.candidates(&request.candidates).await?;
        let mut candidates = Vec::with_capacity(actions.len());
        for action in &actions {
            candidates.push((action.id.to_string(), self.load_goals(&action.id).await?));
        }
        let spec = RecognizeSpec { metric: request.metric, threshold: request.threshold };
        let found = compute(move || recognize(&observed, &candidates, &spec)).await?.map_err(|error| {
            let pointer = match error {
                RecognizeError::Threshold { .. } => "/threshold",
                RecognizeError::TooLarge { .. } => "/observed",
            };
            AppError::field(pointer, "invalid_recognition", error.to_string())
        })?;
        view(found, &actions)
    }

    async fn observed(&self, observed: Observed) -> Result<Goals, AppError> {
        match observed {
            Observed::Demonstration { demonstration } => {
                let loaded = self.load_demonstration(&demonstration).await.map_err(|error| match error.kind {
                    ErrorKind::NotFound => AppError::field("/observed/demonstration", "not_found", error.message),
                    _ => error,
                })?;
                compute(move || observed_rows(&loaded)).await?.map_err(|error| {
                    AppError::field("/observed/demonstration", "invalid_observation", error.to_string())
                })
            }
            Observed::Rows { features, rows } => Goals::new(features, &rows)
                .map_err(|error| AppError::field("/observed/rows", "invalid_observation", error.to_string())),
        }
    }

    async fn candidates(&self, named: &[ActionId]) -> Result<Vec<ActionView>, AppError> {
        if named.is_empty() {
            let page = PageQuery { page_size: Some(MAX_PAGE_SIZE), page_token: None };
            let mut latest = BTreeSet::new();
            let actions = self.list_actions(page).await?.items;
            return Ok(actions.into_iter().filter(|action| latest.insert(action.name.clone())).collect());
        }
        if named.len() > MAX_PAGE_SIZE as usize {
            let detail = format!("{} candidates are named: give at most {MAX_PAGE_SIZE}", named.len());
            return Err(AppError::field("/candidates", "out_of_range", detail));
        }
        let mut actions = Vec::with_capacity(named.len());
        for (index, id) in named.iter().enumerate() {
            actions.push(self.get_action(id).await.map_err(|error| match error.kind {
                ErrorKind::NotFound => AppError::field(format!("/candidates/{index}"), "not_found", error.message),
                _ => error,
            })?);
        }
        Ok(actions)
    }
}

fn view(found: Recognition, actions: &[ActionView]) -> Result<RecognitionView, AppError> {
    let by_id: BTreeMap<&str, &ActionView> = actions.iter().map(|action| (action.id.as_str(), action)).collect();
    let action = |id: &str| {
        by_id
            .get(id)
            .map(|action| (action.id.clone(), action.name.clone()))
            .ok_or_else(|| AppError::internal(format!("recognition answered with {id}, which was no candidate")))
    };
    let candidates = found.matches.into_iter().map(|found| {
        let (id, name) = action(&found.name)?;
        Ok(RecognitionCandidate {
            action: id,
            name,
            discrepancy: found.discrepancy,
            relative_discrepancy: found.relative_discrepancy,
            within_threshold: found.within_threshold,
            per_feature: found.features,
            path: found.path,
        })
    });
    let incomparable = found.incomparable.into_iter().map(|found| {
        let (id, name) = action(&found.name)?;
        Ok(IncomparableCandidate { action: id, name, feature: found.feature, observed_unit: found.observed_unit })
    });
    Ok(RecognitionView {
        recognized: found.recognized.map(|id| action(&id).map(|(id, _)| id)).transpose()?,
        metric: found.metric,
        threshold: found.threshold,
        candidates: candidates.collect::<Result<_, AppError>>()?,
        incomparable: incomparable.collect::<Result<_, AppError>>()?,
    })
}
