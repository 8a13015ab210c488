//! Steps of a worker, and the runs they write.

use super::fixtures::{AT, claimed, made, page, run, states, submitted, transition};
use crate::app::model::{EventData, RunFilter};
use crate::app::ports::{Advance, KeptTrials, Store, StoreError, Transition};
use crate::framework::job::Event;
use crate::framework::job::State;
use crate::framework::method::whole_run::Trial;

pub(crate) async fn writes_a_step_whole_or_not_at_all(store: &dyn Store) {
    let id = submitted(store, 1).await;
    let claim = claimed(store).await.unwrap().claim;
    store.advance(&claim, transition(Event::Start), AT).await.unwrap();
    let before = store.job(&id).await.unwrap();
    // A running job cannot rest without having been asked to.
    let step = Advance { products: vec![made(run(1, &id, 0))], checkpoint: Some(vec![9]), ..transition(Event::Rest) };
    assert!(matches!(store.advance(&claim, step, AT).await, Err(StoreError::Transition(_))));
    assert_eq!(store.job(&id).await.unwrap(), before);
    assert!(store.runs(&RunFilter::default(), &page(9, "")).await.unwrap().is_empty());
    // A repetition that is there already takes the whole step back.
    let step = || Advance { products: vec![made(run(1, &id, 0))], ..Advance::default() };
    store.advance(&claim, step(), AT).await.unwrap();
    let twice = Advance { products: vec![made(run(2, &id, 0))], events: vec![EventData::Resync], ..Advance::default() };
    assert!(store.advance(&claim, twice, AT).await.is_err());
    assert_eq!(store.job(&id).await.unwrap().last_seq, before.last_seq);
}

pub(crate) async fn ends_a_job_once_with_its_results(store: &dyn Store) {
    let id = submitted(store, 1).await;
    let claim = claimed(store).await.unwrap().claim;
    store.advance(&claim, transition(Event::Start), AT).await.unwrap();
    let mut runs = [run(5, &id, 0), run(4, &id, 1)];
    let trial = Trial { joints: vec![0.1 + 0.2], observation: None, cells: None, goal: 2 };
    runs[0].trials = KeptTrials { setup_key: Some("arm".to_owned()), trials: vec![trial] };
    let step = Advance { products: runs.iter().cloned().map(made).collect(), ..transition(Event::Succeed) };
    assert_eq!(store.advance(&claim, step.clone(), AT).await.unwrap(), State::Succeeded);
    assert!(matches!(store.advance(&claim, step, AT).await, Err(StoreError::LeaseLost { .. })));
    let asked = store.apply_event(&id, Transition::plain(Event::Cancel), AT).await;
    assert!(matches!(asked, Err(StoreError::Transition(_))));
    let ended = store.job(&id).await.unwrap();
    assert_eq!(ended.result.runs, [runs[0].view.id.clone(), runs[1].view.id.clone()]);
    assert_eq!((ended.state, ended.finished_at), (State::Succeeded, Some(AT)));
    assert_eq!(store.run(&runs[0].view.id).await.unwrap(), runs[0].view);
    let of_job = RunFilter { job: Some(id.clone()) };
    assert_eq!(store.runs(&of_job, &page(9, "")).await.unwrap().len(), 2);
    assert_eq!(store.run_trials(&runs[0].view.id).await.unwrap(), runs[0].trials);
    assert_eq!(store.run_trials(&runs[1].view.id).await.unwrap(), KeptTrials::default());
    let kept = (runs[0].view.clone(), runs[0].trials.trials.clone());
    assert_eq!(store.runs_on("arm", 9).await.unwrap(), [kept]);
    assert!(store.runs_on("leg", 9).await.unwrap().is_empty());
    assert!(claimed(store).await.is_none());
    assert_eq!(states(store, &id).await.iter().filter(|state| state.is_final()).count(), 1);
}
