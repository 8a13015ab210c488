//! A generalization: demonstrations become an action. Short enough to need no checkpoint.

use super::held::{Gone, Held};
use crate::app::demonstrations::decode;
use crate::app::model::{ActionGoals, ActionId, ActionView, GeneralizationRequest, JobProgress, JobView};
use crate::app::ports::{Advance, StoreError, Transition};
use crate::framework::demonstration::Demonstration;
use crate::framework::generalization::{GeneralizeError, GeneralizeSpec, Generalized, generalize};
use crate::framework::job::{Event, State};

enum Outcome {
    Made(Generalized),
    Refused(GeneralizeError),
    Unreadable(String),
}

/// Runs the job to its end.
pub(super) async fn run(held: &Held, job: &JobView, request: GeneralizationRequest) -> Result<(), Gone> {
    if held.transition(Transition::plain(Event::Start)).await? != State::Running {
        return let_go(held).await;
    }
    let mut encoded = Vec::with_capacity(request.demonstrations.len());
    for id in &request.demonstrations {
        match held.ports.store.demonstration_samples(id).await {
            Ok(bytes) => encoded.push(bytes),
            Err(StoreError::NotFound { .. }) => {
                let message = format!("{id} was deleted before it was read: submit the job again without it");
                return held.fail("demonstration_deleted", message).await.map(drop);
            }
            Err(error @ StoreError::Corrupt { .. }) => {
                return held.fail("corrupt_input", error.to_string()).await.map(drop);
            }
            Err(error) => return Err(Gone::Store(error)),
        }
    }
    let spec =
        GeneralizeSpec { t_min_s: request.t_min_s, weighting: request.weighting, features: request.features.clone() };
    let computed = tokio::task::spawn_blocking(move || compute(&encoded, &spec)).await;
    match computed {
        Ok(Outcome::Made(made)) => complete(held, job, request, made).await,
        Ok(Outcome::Refused(error)) => held.fail("not_generalizable", error.to_string()).await.map(drop),
        Ok(Outcome::Unreadable(cause)) => held.fail("corrupt_input", cause).await.map(drop),
        Err(panic) => held.fail("internal", format!("the computation panicked: {panic}")).await.map(drop),
    }
}

fn compute(encoded: &[Vec<u8>], spec: &GeneralizeSpec) -> Outcome {
    let decoded: Result<Vec<Demonstration>, _> = encoded.iter().map(|bytes| decode(bytes)).collect();
    let demonstrations = match decoded {
        Ok(demonstrations) => demonstrations,
        Err(error) => return Outcome::Unreadable(error.to_string()),
    };
    match generalize(&demonstrations, spec) {
        Ok(made) => Outcome::Made(made),
        Err(error) => Outcome::Refused(error),
    }
}

async fn complete(held: &Held, job: &JobView, request: GeneralizationRequest, made: Generalized) -> Result<(), Gone> {
    let id = ActionId::from_uuid(held.ports.ids.uuid());
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
        created_at: held.ports.clock.now(),
    };
    let goals = ActionGoals {
        action: id,
        features: made.goals.features().to_vec(),
        goals: made.goals.rows().map(<[f64]>::to_vec).collect(),
        spread: made.spread,
    };
    let progress = JobProgress {
        fraction: 1.0,
        repetitions: 1,
        goals: view.goals,
        goal_index: view.goals,
        ..job.progress.clone()
    };
    let step = Advance {
        action: Some((view, goals)),
        progress: Some(progress),
        transition: Some(Transition::plain(Event::Succeed)),
        ..Advance::default()
    };
    held.advance(step).await.map(drop)
}

/// What a user asked before the work began.
async fn let_go(held: &Held) -> Result<(), Gone> {
    if held.transition(Transition::plain(Event::Rest)).await? == State::Cancelling {
        held.transition(Transition::plain(Event::Stop)).await?;
    }
    Ok(())
}
