//! Generalization jobs: demonstrations become an action. Too short to need a checkpoint.

use super::lease::{ClaimedJob, Stop, blocking};
use crate::app::demonstrations::decode;
use crate::app::model::ActionId;
use crate::app::model::{ActionGoals, ActionView};
use crate::app::model::{GeneralizationRequest, JobProgress, JobView};
use crate::app::ports::{Advance, Product, StoreError};
use crate::framework::demonstration::Demonstration;
use crate::framework::generalization::{GeneralizeSpec, Generalized, generalize};

/// Runs the job to its end.
pub(super) async fn run(claimed: &ClaimedJob, job: &JobView, request: GeneralizationRequest) -> Result<(), Stop> {
    claimed.start().await?;
    let mut encoded = Vec::with_capacity(request.demonstrations.len());
    for id in &request.demonstrations {
        match claimed.ports.store.demonstration_samples(id).await {
            Ok(bytes) => encoded.push(bytes),
            Err(StoreError::NotFound { .. }) => {
                let message = format!("{id} was deleted before it was read: submit the job again without it");
                return Err(Stop::failed("demonstration_deleted", message));
            }
            Err(error) => return Err(error.into()),
        }
    }
    let spec =
        GeneralizeSpec { t_min_s: request.t_min_s, weighting: request.weighting, features: request.features.clone() };
    let made = blocking(move || compute(&encoded, &spec)).await??;
    let (action, goals) = action(claimed, job, request, made);
    let progress = JobProgress {
        fraction: 1.0,
        repetitions: 1,
        goals: action.goals,
        goal_index: action.goals,
        ..job.progress.clone()
    };
    let products = vec![Product::Action(Box::new((action, goals)))];
    let step = Advance { products, progress: Some(progress), ..Advance::default() };
    Ok(claimed.succeed(step).await?)
}

fn compute(encoded: &[Vec<u8>], spec: &GeneralizeSpec) -> Result<Generalized, Stop> {
    let decoded: Result<Vec<Demonstration>, _> = encoded.iter().map(|bytes| decode(bytes)).collect();
    let demonstrations = decoded.map_err(|error| Stop::failed("corrupt_input", error.to_string()))?;
    generalize(&demonstrations, spec).map_err(|error| Stop::failed("not_generalizable", error.to_string()))
}

fn action(
    claimed: &ClaimedJob,
    job: &JobView,
    request: GeneralizationRequest,
    made: Generalized,
) -> (ActionView, ActionGoals) {
    let id = ActionId::from_uuid(claimed.ports.ids.uuid());
    let view = ActionView {
        id: id.clone(),
        name: request.name,
        version: 0,
        features: made.goals.features().to_vec(),
        goals: u32::try_from(made.goals.len()).unwrap_or(u32::MAX),
        mean_duration_s: made.mean_duration_s,
        t_min_s: made.t_min_s,
        weighting: made.weighting,
        metric: request.metric,
        demonstrations: request.demonstrations,
        job: job.id.clone(),
        created_at: claimed.ports.clock.now(),
    };
    let goals = ActionGoals {
        action: id,
        features: made.goals.features().to_vec(),
        goals: made.goals.rows().map(<[f64]>::to_vec).collect(),
        spread: made.spread,
    };
    (view, goals)
}
