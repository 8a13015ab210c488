//! Actions: generalized from demonstrations by a job; every version is immutable.

use crate::app::demonstrations::Export;
use crate::app::id::{ActionId, DemonstrationId, JobId};
use crate::app::jobs::{GeneralizationRequest, JobView};
use crate::app::{
    App, AppError, ErrorKind, Keyset, Page, PageQuery, Timestamp, compute, out_of_bounds, unknown_format,
};
use crate::framework::Feature;
use crate::framework::generalization::{Goals, RbfSpec, Weighting, goals_to_csv, interpolate};
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
        let keyset = Keyset::new(&page, "actions")?;
        let actions = self.ports.store.actions(&keyset).await?;
        Ok(keyset.page(actions, |action| action.id.to_string()))
    }

    /// One version of an action.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn get_action(&self, id: &ActionId) -> Result<ActionView, AppError> {
        Ok(self.ports.store.action(id).await?)
    }

    /// Its goals.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn action_goals(&self, id: &ActionId) -> Result<ActionGoals, AppError> {
        Ok(self.ports.store.action_goals(id).await?)
    }

    /// `n` points (2 to 10000) of the curve through the goals, by multiquadric radial basis functions.
    ///
    /// # Errors
    /// `NotFound`; `Malformed` n; `Conflict` when no accurate curve goes through these goals.
    pub async fn interpolate_action(&self, id: &ActionId, n: u32) -> Result<Interpolation, AppError> {
        if !(2..=10_000).contains(&n) {
            return Err(out_of_bounds("n", n, "2 to 10000"));
        }
        let goals = self.load_goals(id).await?;
        let curve = compute(move || interpolate(&goals, n as usize, &RbfSpec::default()))
            .await?
            .map_err(|error| AppError::new(ErrorKind::Conflict, "no_curve", error.to_string()))?;
        Ok(Interpolation {
            action: id.clone(),
            x: (0..n).map(|i| f64::from(i) / f64::from(n - 1)).collect(),
            values: curve.rows().map(<[f64]>::to_vec).collect(),
            features: curve.features().to_vec(),
        })
    }

    /// The goals as `csv` or `json`.
    ///
    /// # Errors
    /// `NotFound`; `Malformed` format.
    pub async fn export_action(&self, id: &ActionId, format: &str) -> Result<Export, AppError> {
        let view = self.get_action(id).await?;
        let goals = self.load_goals(id).await?;
        let name = format!("{}-v{}", view.name, view.version);
        match format {
            "csv" => Ok(Export::new("text/csv; charset=utf-8", &name, "csv", goals_to_csv(&goals).into_bytes())),
            "json" => {
                let bytes = serde_json::to_vec(&goals).map_err(AppError::internal)?;
                Ok(Export::new("application/json", &name, "json", bytes))
            }
            other => Err(unknown_format(other, "csv or json")),
        }
    }

    pub(super) async fn load_goals(&self, id: &ActionId) -> Result<Goals, AppError> {
        let stored = self.action_goals(id).await?;
        Goals::new(stored.features, &stored.goals).map_err(AppError::internal)
    }
}
