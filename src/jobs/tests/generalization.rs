//! Generalization jobs on their own: the action they make, and inputs that changed since the submission.

use super::{Held, ask, claim};
use crate::app::bench::{Bench, generalization};
use crate::app::model::{DemonstrationId, GeneralizationRequest, JobView, Work};
use crate::app::ports::{Demonstrations as _, Jobs as _, NewDemonstration};
use crate::framework::job::{Event, State};
use crate::jobs::generalization::run;
use crate::jobs::lease::Stop;

/// A claimed generalization of one demonstration.
async fn claimed(bench: &Bench) -> (Held, GeneralizationRequest) {
    let request = generalization(vec![bench.demonstration().await]);
    bench.app.create_action(request, None).await.unwrap();
    let held = claim(bench).await;
    let Work::Generalization(request) = held.work.clone() else { panic!("another kind: {:?}", held.work) };
    (held, request)
}

async fn as_stored(bench: &Bench, held: &Held) -> JobView {
    bench.store.job(&held.job.id).await.unwrap()
}

fn failure(ended: Result<(), Stop>) -> (&'static str, String) {
    match ended {
        Err(Stop::Failed { code, message }) => (code, message),
        other => panic!("{other:?}"),
    }
}

#[tokio::test]
async fn demonstrations_become_a_new_version_of_the_action() {
    let bench = Bench::new();
    for version in [1, 2] {
        let (held, request) = claimed(&bench).await;
        run(&held.claimed, &held.job, request.clone()).await.unwrap();
        let job = as_stored(&bench, &held).await;
        let action = bench.app.get_action(&job.result.action.unwrap()).await.unwrap();
        assert_eq!((action.name.as_str(), action.version, &action.job), ("wipe", version, &job.id));
        assert_eq!(action.demonstrations, request.demonstrations);
        let goals = bench.app.action_goals(&action.id).await.unwrap();
        assert_eq!((goals.goals.len(), goals.features.as_slice()), (4, action.features.as_slice()));
        let progress = job.progress;
        assert_eq!((job.state, progress.fraction, progress.goals, action.goals), (State::Succeeded, 1.0, 4, 4));
    }
}

#[tokio::test]
async fn a_demonstration_deleted_since_the_submission_is_named_with_the_remedy() {
    let bench = Bench::new();
    let (held, request) = claimed(&bench).await;
    let [deleted] = request.demonstrations.as_slice() else { panic!("one demonstration was named") };
    bench.app.delete_demonstration(deleted, None).await.unwrap();
    let (code, message) = failure(run(&held.claimed, &held.job, request.clone()).await);
    assert_eq!(code, "demonstration_deleted");
    assert_eq!(message, format!("{deleted} was deleted before it was read: submit the job again without it"));
}

/// Puts unreadable samples in the place of a demonstration's.
async fn damage(bench: &Bench, id: &DemonstrationId) {
    let (view, report) =
        (bench.store.demonstration(id).await.unwrap(), bench.store.demonstration_report(id).await.unwrap());
    bench.store.delete_demonstration(id, None).await.unwrap();
    let damaged = NewDemonstration { view, report, samples: vec![1, 2, 3] };
    bench.store.insert_demonstration(damaged).await.unwrap();
}

#[tokio::test]
async fn samples_that_cannot_be_read_fail_the_job() {
    let bench = Bench::new();
    let (held, request) = claimed(&bench).await;
    damage(&bench, &request.demonstrations[0]).await;
    assert_eq!(failure(run(&held.claimed, &held.job, request).await).0, "corrupt_input");
    assert_eq!(as_stored(&bench, &held).await.result.action, None);
}

#[tokio::test]
async fn a_period_longer_than_the_demonstrations_fails_the_job_with_both_numbers() {
    let bench = Bench::new();
    let (held, request) = claimed(&bench).await;
    let request = GeneralizationRequest { t_min_s: 3.5, ..request };
    let (code, message) = failure(run(&held.claimed, &held.job, request).await);
    assert_eq!(code, "not_generalizable");
    assert!(message.contains("3.5 s is longer than the mean duration of 2 s"), "{message}");
}

#[tokio::test]
async fn a_job_paused_before_its_start_makes_no_action() {
    let bench = Bench::new();
    let (held, request) = claimed(&bench).await;
    ask(&bench, &held.job.id, Event::Pause).await;
    assert!(matches!(run(&held.claimed, &held.job, request).await, Err(Stop::Released)));
    let job = as_stored(&bench, &held).await;
    assert_eq!((job.state, job.result.action), (State::Paused, None));
}
