//! Use-cases of jobs on test doubles: one submission per key, references, steering.

use crate::app::bench::{Bench, generalization};
use crate::app::model::{
    ActionId, AppError, CreateJob, DemonstrationId, ErrorKind, ExecutionRequest, JobFilter, JobId, PageQuery,
    PatchDemonstration,
};
use crate::app::ports::{Advance, Events as _, Queue as _, TestClock, Transition, Wake};
use crate::framework::job::{Event, State};
use crate::framework::trajectory::PlanSpec;
use rstest::rstest;
use serde_json::{Value, json};
use std::time::Duration;
use uuid::Uuid;

fn places(error: &AppError) -> Vec<(&str, &str)> {
    error.details.iter().map(|place| (place.pointer.as_str(), place.code.as_str())).collect()
}

#[tokio::test]
async fn a_key_submits_once_even_if_what_it_names_is_gone() {
    let bench = Bench::new();
    let demonstration = bench.demonstration().await;
    let request = || CreateJob::Generalization(generalization(vec![demonstration.clone()]));
    let first = bench.app.create_job(request(), Some("k".to_owned())).await.unwrap();
    bench.app.delete_demonstration(&demonstration, None).await.unwrap();
    assert_eq!(bench.app.create_job(request(), Some("k".to_owned())).await.unwrap().id, first.id);
    let other = CreateJob::Generalization(generalization(Vec::new()));
    assert_eq!(bench.app.create_job(other, Some("k".to_owned())).await.unwrap_err().code, "idempotency_key_reused");
    let page = PageQuery::default();
    assert_eq!(bench.app.list_jobs(JobFilter::default(), page).await.unwrap().items.len(), 1);
}

#[tokio::test]
async fn a_key_is_forgotten_two_days_after_its_job_ended() {
    let bench = Bench::new();
    let demonstration = bench.demonstration().await;
    let submit = async || {
        let request = CreateJob::Generalization(generalization(vec![demonstration.clone()]));
        bench.app.create_job(request, Some("k".to_owned())).await.unwrap().id
    };
    let first = submit().await;
    bench.clock.advance(Duration::from_hours(100));
    assert_eq!(submit().await, first, "the job has not ended");
    bench.app.cancel_job(&first).await.unwrap();
    bench.clock.advance(Duration::from_hours(49));
    // Another submission with a key forgets the old ones.
    let request = CreateJob::Generalization(generalization(vec![demonstration.clone()]));
    bench.app.create_job(request, Some("other".to_owned())).await.unwrap();
    assert_ne!(submit().await, first);
}

#[tokio::test]
async fn keys_that_no_header_can_carry_are_malformed() {
    let bench = Bench::new();
    for wrong in ["", "naïve", "line\nbreak", &"k".repeat(256)] {
        let request = CreateJob::Generalization(generalization(Vec::new()));
        let error = bench.app.create_job(request, Some(wrong.to_owned())).await.unwrap_err();
        assert_eq!((error.kind, error.code), (ErrorKind::Malformed, "invalid_idempotency_key"), "{wrong:?}");
    }
}

#[tokio::test]
async fn every_wrong_demonstration_is_told_by_its_place() {
    let bench = Bench::new();
    let (good, noisy) = (bench.demonstration().await, bench.demonstration().await);
    let exclude = PatchDemonstration { name: None, excluded: Some("noisy".to_owned()) };
    bench.app.patch_demonstration(&noisy, exclude, None).await.unwrap();
    let missing = DemonstrationId::from_uuid(Uuid::from_u128(99));
    let request = generalization(vec![good.clone(), good, noisy, missing]);
    let error = bench.app.create_job(CreateJob::Generalization(request), None).await.unwrap_err();
    let expected =
        [("/demonstrations/1", "duplicate"), ("/demonstrations/2", "excluded"), ("/demonstrations/3", "not_found")];
    assert_eq!(places(&error), expected);
}

#[tokio::test]
async fn an_execution_of_nothing_names_each_missing_reference() {
    let bench = Bench::new();
    let (robot, world) = (bench.robot().await, bench.world().await);
    let request: ExecutionRequest = serde_json::from_value(json!({
        "action": ActionId::from_uuid(Uuid::from_u128(99)), "robot": robot.id, "world": world.id,
        "execution": {"method": "sst"}, "repetitions": 0,
    }))
    .unwrap();
    let validation = bench.app.validate_job(CreateJob::Execution(Box::new(request)), None).await.unwrap();
    let places: Vec<_> = validation.errors.iter().map(|place| place.pointer.as_str()).collect();
    assert_eq!((validation.valid, places.as_slice()), (false, &["/repetitions", "/action"][..]));
}

#[rstest]
#[case(json!({"speed": 1.5}), "/planning/speed")]
#[case(json!({"acceleration": 0}), "/planning/acceleration")]
#[case(json!({"sample_s": 0}), "/planning/sample_s")]
#[case(json!({"joint_limits": {"knee": {}}}), "/planning/joint_limits/knee")]
#[case(json!({"joint_limits": {"elbow_pitch": {"velocity": 4}}}), "/planning/joint_limits/elbow_pitch/velocity")]
#[tokio::test]
async fn a_wrong_choice_for_the_trajectories_is_told_by_its_place(#[case] planning: Value, #[case] place: &str) {
    let bench = Bench::new();
    let (action, robot, world) = (bench.action("wax").await, bench.robot().await, bench.world().await);
    let request = |planning: &Value| {
        let request: ExecutionRequest = serde_json::from_value(json!({
            "action": action.id, "robot": robot.id, "world": world.id, "execution": {"method": "sst"},
            "planning": planning,
        }))
        .unwrap();
        CreateJob::Execution(Box::new(request))
    };
    let error = bench.app.create_job(request(&planning), None).await.unwrap_err();
    assert_eq!(places(&error), [(place, "invalid_planning")]);
    let job = bench.app.create_job(request(&Value::Null), None).await.unwrap();
    let CreateJob::Execution(shown) = job.request else { panic!("{:?}", job.request) };
    assert_eq!(shown.planning, Some(PlanSpec::default()));
}

#[tokio::test]
async fn steering_wakes_whoever_waits_and_is_refused_after_the_end() {
    let bench = Bench::new();
    let demonstration = bench.demonstration().await;
    let mut wakes = bench.events.subscribe();
    let request = CreateJob::Generalization(generalization(vec![demonstration]));
    let id = bench.app.create_job(request, None).await.unwrap().id;
    assert_eq!(wakes.try_recv(), Ok(Wake::Queued));
    assert_eq!(bench.app.pause_job(&id).await.unwrap().state, State::Paused);
    assert_eq!(wakes.try_recv(), Ok(Wake::Job(id.clone())));
    assert_eq!(bench.app.resume_job(&id).await.unwrap().state, State::Queued);
    assert_eq!((wakes.try_recv(), wakes.try_recv()), (Ok(Wake::Job(id.clone())), Ok(Wake::Queued)));
    assert_eq!(bench.app.cancel_job(&id).await.unwrap().state, State::Cancelled);
    assert_eq!(bench.app.cancel_job(&id).await.unwrap_err().code, "invalid_state");
    let missing = JobId::from_uuid(Uuid::from_u128(99));
    assert_eq!(bench.app.pause_job(&missing).await.unwrap_err().kind, ErrorKind::NotFound);
}

#[tokio::test]
async fn a_clone_is_the_same_work_in_a_job_of_its_own() {
    let bench = Bench::new();
    let demonstration = bench.demonstration().await;
    let request = CreateJob::Generalization(generalization(vec![demonstration]));
    let first = bench.app.create_job(request, None).await.unwrap();
    let again = bench.app.clone_job(&first.id, Some("c".to_owned())).await.unwrap();
    assert_ne!(again.id, first.id);
    assert_eq!((&again.request, &again.name), (&first.request, &first.name));
    assert_eq!(bench.app.clone_job(&first.id, Some("c".to_owned())).await.unwrap().id, again.id);
}

#[tokio::test]
async fn a_wait_ends_with_the_next_event_and_events_are_bounded() {
    let bench = Bench::new();
    let demonstration = bench.demonstration().await;
    let request = CreateJob::Generalization(generalization(vec![demonstration]));
    let id = bench.app.create_job(request, None).await.unwrap().id;
    let unchanged = bench.app.wait_job(&id, 1, Duration::from_millis(1)).await.unwrap();
    assert_eq!((unchanged.last_seq, unchanged.state), (1, State::Queued));
    let at = TestClock::START;
    let claim = bench.store.claim("t".to_owned(), Duration::from_mins(1), 3, at).await.unwrap().unwrap().claim;
    let step = Advance { transition: Some(Transition::plain(Event::Start)), ..Advance::default() };
    bench.store.advance(&claim, step, at).await.unwrap();
    let job = bench.app.wait_job(&id, 1, Duration::from_mins(1)).await.unwrap();
    assert_eq!((job.last_seq, job.state, job.started_at), (3, State::Running, Some(at)));
    assert_eq!(bench.app.job_events(&id, 1, 1).await.unwrap().events.len(), 1);
    assert_eq!(bench.app.job_events(&id, 0, 1001).await.unwrap_err().kind, ErrorKind::Malformed);
}
