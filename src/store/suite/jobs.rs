//! Jobs as users see and steer them.

use super::fixtures::{AT, LEASE, checkpoint, claimed, job, page, submitted, transition, uuid};
use crate::app::model::{EventData, JobFilter, JobId, JobKind, JobProgress};
use crate::app::ports::{Advance, IdempotencyKey, Store, StoreError, Submitted, Transition};
use crate::framework::job::Event;
use crate::framework::job::State;

pub(crate) async fn submits_once_a_key(store: &dyn Store) {
    let key = |body: &str| Some(IdempotencyKey { key: "k".to_owned(), body_sha256: body.to_owned() });
    let all = (1..=50).map(|number| store.submit(job(number), key("same")));
    let answers = futures_util::future::join_all(all).await;
    let created = answers.iter().filter(|answer| matches!(answer, Ok(Submitted::Created(_)))).count();
    let ids: std::collections::BTreeSet<_> = answers
        .into_iter()
        .map(|answer| match answer.unwrap() {
            Submitted::Created(job) | Submitted::Existing(job) => job.id,
        })
        .collect();
    assert_eq!((created, ids.len()), (1, 1));
    assert_eq!(store.jobs(&JobFilter::default(), &page(200, "")).await.unwrap().len(), 1);
    assert!(matches!(store.submit(job(99), key("other")).await, Err(StoreError::KeyReused { .. })));
    let again = IdempotencyKey { key: "k".to_owned(), body_sha256: "same".to_owned() };
    assert_eq!(store.submitted(&again).await.unwrap().map(|job| job.id), ids.first().cloned());
}

pub(crate) async fn lists_jobs_by_state_and_kind(store: &dyn Store) {
    submitted(store, 1).await;
    submitted(store, 2).await;
    claimed(store).await.unwrap();
    let count = async |states: &[State], kind| {
        let filter = JobFilter { states: states.to_vec(), kind };
        store.jobs(&filter, &page(200, "")).await.unwrap().len()
    };
    assert_eq!(count(&[], None).await, 2);
    assert_eq!(count(&[State::Queued], None).await, 1);
    assert_eq!(count(&[State::Queued, State::Preparing], Some(JobKind::Generalization)).await, 2);
    assert_eq!(count(&[], Some(JobKind::Execution)).await, 0);
}

pub(crate) async fn numbers_events_and_tells_unknown_positions(store: &dyn Store) {
    let id = submitted(store, 1).await;
    let claim = claimed(store).await.unwrap().claim;
    let events = vec![EventData::Progress { progress: JobProgress::default() }; 3];
    store.advance(&claim, Advance { events, ..transition(Event::Start) }, AT).await.unwrap();
    let page = store.events(&id, 2, 2).await.unwrap();
    assert_eq!(page.events.iter().map(|event| event.seq).collect::<Vec<_>>(), [3, 4]);
    assert_eq!((page.last_seq, page.resync, page.end), (6, false, false));
    assert!(store.events(&id, 7, 2).await.unwrap().resync);
    store.advance(&claim, transition(Event::Fail), AT).await.unwrap();
    assert!(!store.events(&id, 0, 6).await.unwrap().end);
    assert!(store.events(&id, 6, 6).await.unwrap().end && store.events(&id, 7, 6).await.unwrap().end);
}

pub(crate) async fn steers_jobs_as_the_machine_allows(store: &dyn Store) {
    let id = submitted(store, 1).await;
    let ask = async |event| store.apply_event(&id, Transition::plain(event), AT).await.map(|job| job.state);
    assert_eq!(ask(Event::Pause).await.unwrap(), State::Paused);
    assert!(claimed(store).await.is_none());
    assert_eq!(ask(Event::Resume).await.unwrap(), State::Queued);
    let claim = claimed(store).await.unwrap().claim;
    store.advance(&claim, transition(Event::Start), AT).await.unwrap();
    assert_eq!(ask(Event::Pause).await.unwrap(), State::Pausing);
    assert_eq!(store.advance(&claim, checkpoint(b"x"), AT).await.unwrap(), State::Pausing);
    assert_eq!(store.advance(&claim, transition(Event::Rest), AT).await.unwrap(), State::Paused);
    assert!(matches!(store.heartbeat(&claim, LEASE).await, Err(StoreError::LeaseLost { .. })));
    assert_eq!(ask(Event::Cancel).await.unwrap(), State::Cancelled);
    let missing = JobId::from_uuid(uuid(77));
    let asked = store.apply_event(&missing, Transition::plain(Event::Cancel), AT).await;
    assert!(matches!(asked, Err(StoreError::NotFound { .. })));
}
