//! Actions: generalized from demonstrations by a job; every version is immutable.

use crate::app::model::{
    ActionGoals, ActionId, ActionView, AppError, CreateJob, ErrorKind, Export, GeneralizationRequest, Interpolation,
    JobView, Keyset, Page, PageQuery, limits,
};
use crate::app::{UseCases, compute, unknown_format, within};
use crate::framework::generalization::{Goals, RbfSpec, goals_to_csv, interpolate};

impl UseCases {
    /// Starts a generalization job, whose result names the action.
    ///
    /// # Errors
    /// `Invalid` request; with an idempotency key as for [`UseCases::create_job`].
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

#[cfg(test)]
mod tests {
    use crate::app::bench::Bench;
    use crate::app::model::{ActionId, ErrorKind, PageQuery};
    use uuid::Uuid;

    #[tokio::test]
    async fn a_name_that_is_used_again_is_the_next_version() {
        let bench = Bench::new();
        let (first, second, other) = (bench.action("wax").await, bench.action("wax").await, bench.action("wipe").await);
        assert_eq!([first.version, second.version, other.version], [1, 2, 1]);
        let listed = bench.app.list_actions(PageQuery::default()).await.unwrap().items;
        assert_eq!(listed, [other, second, first]);
    }

    #[tokio::test]
    async fn a_curve_starts_and_ends_at_the_outer_goals() {
        let bench = Bench::new();
        let action = bench.action("wax").await;
        let goals = bench.app.action_goals(&action.id).await.unwrap().goals;
        let curve = bench.app.interpolate_action(&action.id, 50).await.unwrap();
        assert_eq!((curve.values.len(), curve.x[0], curve.x[49]), (50, 0.0, 1.0));
        for (point, goal) in [(&curve.values[0], &goals[0]), (&curve.values[49], &goals[goals.len() - 1])] {
            assert!(point.iter().zip(goal).all(|(a, b)| (a - b).abs() < 0.01), "{point:?} is not {goal:?}");
        }
        for wrong in [1, 100_001] {
            assert_eq!(bench.app.interpolate_action(&action.id, wrong).await.unwrap_err().kind, ErrorKind::Malformed);
        }
    }

    #[tokio::test]
    async fn an_export_is_named_after_the_version_and_has_a_line_per_goal() {
        let bench = Bench::new();
        let action = bench.action("wax").await;
        let csv = bench.app.export_action(&action.id, "csv").await.unwrap();
        let text = String::from_utf8(csv.bytes).unwrap();
        assert_eq!((csv.file_name.as_str(), text.lines().count()), ("wax-v1.csv", action.goals as usize + 1));
        assert_eq!(bench.app.export_action(&action.id, "xlsx").await.unwrap_err().code, "unknown_format");
        let missing = ActionId::from_uuid(Uuid::from_u128(99));
        assert_eq!(bench.app.export_action(&missing, "csv").await.unwrap_err().kind, ErrorKind::NotFound);
    }
}
