//! Requests, lost leases and unreachable stores, as a worker meets them.

use super::{Held, ask, claim, claim_with, settings};
use crate::app::bench::{Bench, generalization};
use crate::app::ports::{Advance, Connection, Jobs as _, Queue as _};
use crate::framework::job::{Event, State};
use crate::jobs::Settings;
use crate::jobs::lease::{LeaseLost, Stop};
use rstest::rstest;
use std::time::Duration;

/// A claimed job that has not started.
async fn claimed(bench: &Bench) -> Held {
    let request = generalization(vec![bench.demonstration().await]);
    bench.app.create_action(request, None).await.unwrap();
    claim(bench).await
}

/// A claimed job that runs.
async fn started(bench: &Bench) -> Held {
    let held = claimed(bench).await;
    held.claimed.start().await.unwrap();
    held
}

/// Requests before the worker reads the state, and between reading and answering.
#[rstest]
#[case(&[], &[], false, State::Running)]
#[case(&[Event::Pause], &[], false, State::Paused)]
#[case(&[Event::Cancel], &[], false, State::Cancelled)]
#[case(&[], &[], true, State::Queued)]
#[case(&[Event::Pause], &[Event::Resume], false, State::Running)]
#[case(&[Event::Pause], &[Event::Cancel], false, State::Cancelled)]
#[case(&[Event::Pause], &[Event::Resume], true, State::Queued)]
#[case(&[], &[Event::Pause], true, State::Paused)]
#[case(&[], &[Event::Cancel], true, State::Cancelled)]
#[tokio::test]
async fn the_last_request_decides(
    #[case] before: &[Event],
    #[case] between: &[Event],
    #[case] is_stopping: bool,
    #[case] expected: State,
) {
    let bench = Bench::new();
    let Held { claimed, job, stop, .. } = started(&bench).await;
    for event in before {
        ask(&bench, &job.id, *event).await;
    }
    let state = claimed.advance(Advance::default()).await.unwrap();
    for event in between {
        ask(&bench, &job.id, *event).await;
    }
    if is_stopping {
        stop.cancel();
    }
    let settled = claimed.settle(state).await;
    assert_eq!(bench.store.job(&job.id).await.unwrap().state, expected);
    let continues = expected == State::Running;
    assert!(matches!((&settled, continues), (Ok(()), true) | (Err(Stop::Released), false)), "{settled:?}");
}

#[rstest]
#[case(Event::Pause, State::Paused)]
#[case(Event::Cancel, State::Cancelled)]
#[tokio::test]
async fn a_job_asked_to_stop_before_its_start_does_not_start(#[case] asked: Event, #[case] expected: State) {
    let bench = Bench::new();
    let Held { claimed, job, .. } = claimed(&bench).await;
    ask(&bench, &job.id, asked).await;
    assert!(matches!(claimed.start().await, Err(Stop::Released)));
    assert_eq!(bench.store.job(&job.id).await.unwrap().state, expected);
}

#[tokio::test]
async fn a_job_that_needs_a_person_rests_with_the_reason_until_it_is_resumed() {
    let bench = Bench::new();
    let Held { claimed, job, .. } = started(&bench).await;
    assert!(matches!(claimed.rest("look at the robot".to_owned()).await, Stop::Released));
    let resting = bench.store.job(&job.id).await.unwrap();
    assert_eq!((resting.state, resting.state_reason.as_deref()), (State::Paused, Some("look at the robot")));
    ask(&bench, &job.id, Event::Resume).await;
    assert_eq!(bench.store.job(&job.id).await.unwrap().state, State::Queued);
}

#[tokio::test]
async fn a_job_that_is_being_cancelled_ends_instead_of_resting() {
    let bench = Bench::new();
    let Held { claimed, job, .. } = started(&bench).await;
    ask(&bench, &job.id, Event::Cancel).await;
    assert!(matches!(claimed.rest("look at the robot".to_owned()).await, Stop::Released));
    assert_eq!(bench.store.job(&job.id).await.unwrap().state, State::Cancelled);
}

#[tokio::test]
async fn a_pause_wakes_work_that_waits_and_a_resumed_job_is_left_alone() {
    let bench = Bench::new();
    let Held { claimed, job, .. } = started(&bench).await;
    assert!(!claimed.is_interrupted());
    ask(&bench, &job.id, Event::Pause).await;
    claimed.interrupt().raised().await;
    ask(&bench, &job.id, Event::Resume).await;
    let state = claimed.advance(Advance::default()).await.unwrap();
    claimed.settle(state).await.unwrap();
    assert!(!claimed.is_interrupted());
}

#[tokio::test]
async fn a_stopping_server_wakes_work_that_waits() {
    let bench = Bench::new();
    let Held { claimed, stop, .. } = started(&bench).await;
    stop.cancel();
    claimed.interrupt().raised().await;
    assert!(claimed.is_interrupted());
}

#[tokio::test]
async fn a_job_that_was_taken_back_is_written_no_more() {
    let bench = Bench::new();
    let Held { claimed, job, .. } = started(&bench).await;
    bench.store.begin_epoch(bench.ports.clock.now()).await.unwrap();
    let events = bench.store.job(&job.id).await.unwrap().last_seq;
    assert!(matches!(claimed.advance(Advance::default()).await, Err(LeaseLost::Expired)));
    claimed.interrupt().raised().await;
    let taken = bench.store.job(&job.id).await.unwrap();
    assert_eq!((taken.state, taken.last_seq), (State::Queued, events));
}

/// Not quite half the lease: heartbeats may fail this long.
fn tolerated() -> Duration {
    settings().lease * 2 / 5
}

/// Waits until two more heartbeats have failed: the second began after this call.
async fn two_failures(bench: &Bench) {
    let mut refused = bench.store.refused();
    let before = *refused.borrow();
    refused.wait_for(|count| *count >= before + 2).await.unwrap();
}

#[tokio::test]
async fn a_job_is_given_up_after_half_a_lease_without_renewal_before_another_worker_can_have_it() {
    let bench = Bench::new();
    let Held { claimed, job, .. } = started(&bench).await;
    bench.store.set_connection(Connection::Refused);
    bench.clock.advance(tolerated());
    two_failures(&bench).await;
    assert!(!claimed.is_interrupted());

    bench.clock.advance(Duration::from_mins(10));
    claimed.interrupt().raised().await;
    bench.store.set_connection(Connection::Open);
    assert!(matches!(claimed.advance(Advance::default()).await, Err(LeaseLost::Expired)));
    let now = bench.ports.clock.now();
    assert_eq!(bench.store.reap(now).await.unwrap(), [], "the lease had not ended");

    bench.clock.advance(settings().lease);
    assert_eq!(bench.store.reap(now).await.unwrap(), std::slice::from_ref(&job.id));
    assert_eq!(bench.store.job(&job.id).await.unwrap().state, State::Queued);
}

#[tokio::test]
async fn a_job_whose_heartbeat_gets_no_answer_is_given_up_like_one_whose_heartbeats_fail() {
    let bench = Bench::new();
    bench.app.create_action(generalization(vec![bench.demonstration().await]), None).await.unwrap();
    bench.store.set_connection(Connection::Hanging);
    let Held { claimed, .. } = claim_with(&bench, Settings { lease: Duration::from_millis(100), ..settings() }).await;
    claimed.interrupt().raised().await;
    bench.store.set_connection(Connection::Open);
    assert!(matches!(claimed.advance(Advance::default()).await, Err(LeaseLost::Expired)));
    assert_eq!(bench.store.reap(bench.ports.clock.now()).await.unwrap(), [], "the lease had not ended");
}

#[tokio::test]
async fn a_renewal_makes_up_for_the_failed_ones_before_it() {
    let bench = Bench::new();
    let Held { claimed, job, .. } = started(&bench).await;
    for _ in 0..3 {
        bench.store.set_connection(Connection::Refused);
        bench.clock.advance(tolerated());
        two_failures(&bench).await;
        bench.store.set_connection(Connection::Open);
        // The request arrives by a heartbeat, which is a renewal.
        ask(&bench, &job.id, Event::Pause).await;
        claimed.interrupt().raised().await;
        ask(&bench, &job.id, Event::Resume).await;
        let state = claimed.advance(Advance::default()).await.unwrap();
        claimed.settle(state).await.unwrap();
        assert!(!claimed.is_interrupted());
    }
}
