//! Actions: generalized from demonstrations by a job; every version is immutable.

use crate::app::demonstrations::Export;
use crate::app::id::{ActionId, DemonstrationId, JobId};
use crate::app::jobs::{GeneralizationRequest, JobView};
use crate::app::{App, AppError, Page, PageQuery, Timestamp};
use crate::framework::Feature;
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
    /// `per_sample` or `per_demonstration`.
    pub weighting: String,
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

impl App {
    /// Starts a generalization job; the action is in the job's result.
    ///
    /// # Errors
    /// `Invalid` request; `Conflict` and `Invalid` by idempotency as [`App::create_job`].
    pub async fn create_action(
        &self,
        request: GeneralizationRequest,
        idempotency_key: Option<String>,
    ) -> Result<JobView, AppError> {
        self.create_job(crate::app::jobs::CreateJob::Generalization(request), idempotency_key).await
    }

    /// Newest first.
    ///
    /// # Errors
    /// `Malformed` page.
    pub async fn list_actions(&self, page: PageQuery) -> Result<Page<ActionView>, AppError> {
        let _ = page;
        Err(self.unfinished())
    }

    /// One version of an action.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn get_action(&self, id: &ActionId) -> Result<ActionView, AppError> {
        let _ = id;
        Err(self.unfinished())
    }

    /// Its goals.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn action_goals(&self, id: &ActionId) -> Result<ActionGoals, AppError> {
        let _ = id;
        Err(self.unfinished())
    }

    /// `n` points of the curve through the goals (2 to 10000).
    ///
    /// # Errors
    /// `NotFound`; `Malformed` n.
    pub async fn interpolate_action(&self, id: &ActionId, n: u32) -> Result<Interpolation, AppError> {
        let _ = (id, n);
        Err(self.unfinished())
    }

    /// The goals as `csv` or `json`.
    ///
    /// # Errors
    /// `NotFound`; `Malformed` format.
    pub async fn export_action(&self, id: &ActionId, format: &str) -> Result<Export, AppError> {
        let _ = (id, format);
        Err(self.unfinished())
    }
}
