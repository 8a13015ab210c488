//! Actions: generalized from demonstrations by a job; every version is immutable.

use crate::app::model::{
    ActionGoals, ActionId, ActionView, AppError, CreateJob, ErrorKind, Export, GeneralizationRequest, Interpolation,
    JobView, Keyset, Page, PageQuery, limits,
};
use crate::app::{App, compute, unknown_format, within};
use crate::framework::generalization::{Goals, RbfSpec, goals_to_csv, interpolate};

impl App {
    /// Starts a generalization job, whose result names the action.
    ///
    /// # Errors
    /// `Invalid` request; with an idempotency key as for [`App::create_job`].
    pub async fn create_action(
        &self,
        request: GeneralizationRequest,
        idempotency_key: Option<String>,
    ) -> Result<JobView, AppError> {
        self.create_job(CreateJob::Generalization(request), idempotency_key).await
    }

    /// Lists actions, newest first.
    ///
    /// # Errors
    /// `Malformed` page.
    pub async fn list_actions(&self, page: PageQuery) -> Result<Page<ActionView>, AppError> {
        let keyset = Keyset::new(&page, "actions")?;
        let actions = self.ports.store.actions(&keyset).await?;
        Ok(keyset.page(actions, |action| action.id.to_string()))
    }

    /// Reads one version of an action.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn get_action(&self, id: &ActionId) -> Result<ActionView, AppError> {
        Ok(self.ports.store.action(id).await?)
    }

    /// Reads the goals of an action.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn action_goals(&self, id: &ActionId) -> Result<ActionGoals, AppError> {
        Ok(self.ports.store.action_goals(id).await?)
    }

    /// Interpolates `n` points of the curve through the goals with multiquadric radial basis functions.
    ///
    /// # Errors
    /// `NotFound`; `Malformed` n; `Conflict` if there is no accurate curve through these goals.
    pub async fn interpolate_action(&self, id: &ActionId, n: u32) -> Result<Interpolation, AppError> {
        within("n", n, &limits::INTERPOLATION_POINTS)?;
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

    /// Exports the goals as `csv` or `json`.
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
