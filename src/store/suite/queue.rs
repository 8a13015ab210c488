//! Jobs as workers hold them.

use super::fixtures::{AT, LEASE, checkpoint, claimed, claimed_for, job, made, run, states, submitted, transition};
use crate::app::ports::{Advance, Store, StoreError};
use crate::framework::job::Event;
use crate::framework::job::State;
use std::time::Duration;

pub(crate) async fn gives_the_oldest_job_to_one_worker(store: &dyn Store) {
    let (first, second) = (submitted(store, 1).await, submitted(store, 2).await);
    let given = claimed(store).await.unwrap();
    assert_eq!((given.job.id.clone(), given.job.state, given.job.attempt), (first.clone(), State::Preparing, 1));
    assert_eq!(given.work, job(1).work);
    assert_eq!(claimed(store).await.unwrap().job.id, second);
    assert!(claimed(store).await.is_none());
    assert_eq!(states(store, &first).await, [State::Queued, State::Preparing]);
}

pub(crate) async fn writes_nothing_for_a_lost_claim(store: &dyn Store) {
    store.begin_epoch(AT).await.unwrap();
    let id = submitted(store, 1).await;
    let stale = claimed(store).await.unwrap().claim;
    store.advance(&stale, transition(Event::Start), AT).await.unwrap();
    assert_eq!(store.begin_epoch(AT).await.unwrap(), std::slice::from_ref(&id));
    let before = store.job(&id).await.unwrap();
    assert_eq!(before.state, State::Queued);
    let step =
        Advance { products: vec![made(run(1, &id, 0))], checkpoint: Some(vec![9]), ..transition(Event::Succeed) };
    assert!(matches!(store.advance(&stale, step.clone(), AT).await, Err(StoreError::LeaseLost { .. })));
    assert!(matches!(store.heartbeat(&stale, LEASE).await, Err(StoreError::LeaseLost { .. })));
    assert_eq!(store.job(&id).await.unwrap(), before);
    let fresh = claimed(store).await.unwrap();
    assert_eq!((fresh.job.attempt, fresh.checkpoint), (2, None));
    assert!(matches!(store.advance(&stale, step, AT).await, Err(StoreError::LeaseLost { .. })));
    let expected =
        [State::Queued, State::Preparing, State::Running, State::Interrupted, State::Queued, State::Preparing];
    assert_eq!(states(store, &id).await, expected);
}

pub(crate) async fn gives_back_the_last_checkpoint(store: &dyn Store) {
    store.begin_epoch(AT).await.unwrap();
    submitted(store, 1).await;
    let claim = claimed(store).await.unwrap().claim;
    store.advance(&claim, transition(Event::Start), AT).await.unwrap();
    store.advance(&claim, checkpoint(b"one"), AT).await.unwrap();
    store.advance(&claim, checkpoint(b"two"), AT).await.unwrap();
    store.begin_epoch(AT).await.unwrap();
    assert_eq!(claimed(store).await.unwrap().checkpoint.as_deref(), Some(&b"two"[..]));
}

pub(crate) async fn quarantines_only_jobs_that_crash_without_progress(store: &dyn Store) {
    let id = submitted(store, 1).await;
    for attempt in 1..=10 {
        let given = claimed(store).await.unwrap();
        assert_eq!(given.job.attempt, attempt);
        store.advance(&given.claim, transition(Event::Start), AT).await.unwrap();
        store.advance(&given.claim, checkpoint(b"on"), AT).await.unwrap();
        store.begin_epoch(AT).await.unwrap();
    }
    for _ in 0..3 {
        claimed(store).await.unwrap();
        store.begin_epoch(AT).await.unwrap();
    }
    assert!(claimed(store).await.is_none());
    let failed = store.job(&id).await.unwrap();
    assert_eq!((failed.state, failed.failure.unwrap().code.as_str()), (State::Failed, "quarantined"));
}

pub(crate) async fn takes_back_jobs_whose_lease_ran_out(store: &dyn Store) {
    store.begin_epoch(AT).await.unwrap();
    let (slow, dead) = (submitted(store, 1).await, submitted(store, 2).await);
    let alive = claimed_for(store, Duration::from_millis(1)).await.unwrap();
    let gone = claimed_for(store, Duration::from_millis(1)).await.unwrap();
    assert_eq!((&alive.job.id, &gone.job.id), (&slow, &dead));
    store.heartbeat(&alive.claim, LEASE).await.unwrap();
    tokio::time::sleep(Duration::from_millis(30)).await;
    assert_eq!(store.reap(AT).await.unwrap(), [dead]);
    assert!(matches!(store.heartbeat(&gone.claim, LEASE).await, Err(StoreError::LeaseLost { .. })));
    assert!(store.reap(AT).await.unwrap().is_empty());
}
