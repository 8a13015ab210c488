//! Recognition: which action an observation shows, or none.

use crate::app::model::{
    ActionId, ActionView, AppError, ErrorKind, IncomparableCandidate, Observed, PageQuery, RecognitionCandidate,
    RecognitionView, RecognizeRequest, limits,
};
use crate::app::{UseCases, compute};
use crate::framework::generalization::{Goals, GoalsError};
use crate::framework::recognition::{Recognition, RecognizeError, RecognizeSpec, observed_rows, recognize};
use std::collections::{BTreeMap, BTreeSet};

impl UseCases {
    /// Compares an observation with the candidates, synchronously.
    ///
    /// # Errors
    /// `Invalid` request, including references to resources that do not exist.
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
            Observed::Rows { features, rows } => Goals::new(features, &rows).map_err(refused_rows),
        }
    }

    async fn candidates(&self, named: &[ActionId]) -> Result<Vec<ActionView>, AppError> {
        if named.is_empty() {
            let page = PageQuery { page_size: Some(limits::MAX_CANDIDATES), page_token: None };
            let mut latest = BTreeSet::new();
            let actions = self.list_actions(page).await?.items;
            return Ok(actions.into_iter().filter(|action| latest.insert(action.name.clone())).collect());
        }
        if named.len() > limits::MAX_CANDIDATES as usize {
            let detail = format!("{} candidates are named: give at most {}", named.len(), limits::MAX_CANDIDATES);
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

/// An observation has the shape of goals, but its errors speak of rows.
fn refused_rows(error: GoalsError) -> AppError {
    let refuse = |place: String, detail: String| AppError::field(place, "invalid_observation", detail);
    match error {
        GoalsError::Empty { features: 0, .. } => {
            refuse("/observed/features".to_owned(), "an observation needs at least 1 feature".to_owned())
        }
        GoalsError::Empty { .. } => {
            refuse("/observed/rows".to_owned(), "an observation needs at least 1 row".to_owned())
        }
        GoalsError::Ragged { goal, found, expected } => refuse(
            format!("/observed/rows/{goal}"),
            format!("row {goal} has {found} values, but there are {expected} features: give one value per feature"),
        ),
        GoalsError::NonFinite { goal, feature, value } => refuse(
            format!("/observed/rows/{goal}"),
            format!("row {goal}, feature {feature:?} is {value}, not a finite number"),
        ),
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

#[cfg(test)]
mod tests {
    use crate::app::bench::Bench;
    use crate::app::model::{ActionId, AppError, Observed, RecognizeRequest};
    use crate::framework::Feature;
    use crate::framework::recognition::Metric;
    use uuid::Uuid;

    fn request(observed: Observed) -> RecognizeRequest {
        RecognizeRequest { observed, candidates: Vec::new(), metric: Metric::default(), threshold: None }
    }

    async fn goals_of(bench: &Bench, action: &ActionId) -> Observed {
        let goals = bench.app.action_goals(action).await.unwrap();
        Observed::Rows { features: goals.features, rows: goals.goals }
    }

    fn place(error: &AppError) -> &str {
        &error.details[0].pointer
    }

    #[tokio::test]
    async fn an_action_is_recognized_by_its_own_goals_in_its_latest_version() {
        let bench = Bench::new();
        let (first, second) = (bench.action("wax").await.id, bench.action("wax").await.id);
        let found = bench.app.recognize(request(goals_of(&bench, &first).await)).await.unwrap();
        assert_eq!(found.recognized, Some(second));
        assert_eq!((found.candidates.len(), found.candidates[0].discrepancy), (1, 0.0));
        let named = RecognizeRequest { candidates: vec![first.clone()], ..request(goals_of(&bench, &first).await) };
        assert_eq!(bench.app.recognize(named).await.unwrap().recognized, Some(first));
    }

    #[tokio::test]
    async fn an_observation_without_an_actions_features_is_incomparable_with_it() {
        let bench = Bench::new();
        let action = bench.action("wax").await;
        let rows = Observed::Rows { features: vec![Feature::new("force", "N")], rows: vec![vec![1.0], vec![2.0]] };
        let found = bench.app.recognize(request(rows)).await.unwrap();
        assert_eq!((found.recognized, found.candidates.len()), (None, 0));
        assert_eq!((&found.incomparable[0].action, &found.incomparable[0].observed_unit), (&action.id, &None));
    }

    #[tokio::test]
    async fn every_wrong_part_of_a_question_is_told_by_its_place() {
        let bench = Bench::new();
        let action = bench.action("wax").await.id;
        let observed = goals_of(&bench, &action).await;
        let missing = vec![action, ActionId::from_uuid(Uuid::from_u128(99))];
        let unknown = RecognizeRequest { candidates: missing, ..request(observed.clone()) };
        assert_eq!(place(&bench.app.recognize(unknown).await.unwrap_err()), "/candidates/1");
        let negative = RecognizeRequest { threshold: Some(-1.0), ..request(observed) };
        assert_eq!(place(&bench.app.recognize(negative).await.unwrap_err()), "/threshold");
        let x = || vec![Feature::new("x", "mm")];
        for (features, rows, expected) in [
            (x(), vec![vec![1.0], vec![]], "/observed/rows/1"),
            (x(), vec![vec![f64::NAN]], "/observed/rows/0"),
            (x(), Vec::new(), "/observed/rows"),
            (Vec::new(), vec![vec![]], "/observed/features"),
        ] {
            let error = bench.app.recognize(request(Observed::Rows { features, rows })).await.unwrap_err();
            assert_eq!(place(&error), expected);
            assert!(!error.message.contains("goal"), "{}", error.message);
        }
    }
}
