//! Experiments and their rows.

use super::fixtures::{AT, claimed, experiment, page, row, submitted, transition, uuid};
use crate::app::model::{ExperimentId, RowFilter};
use crate::app::ports::{Advance, Product, Store, StoreError};
use crate::framework::experiment::RunId as Which;
use crate::framework::experiment::RunRow;
use crate::framework::job::Event;
use crate::framework::job::State;

pub(crate) async fn keeps_an_experiment_with_its_job_and_its_rows_with_the_claim(store: &dyn Store) {
    store.begin_epoch(AT).await.unwrap();
    let new = experiment(1);
    let kept = new.experiment.clone().unwrap();
    let id = kept.view.id.clone();
    store.submit(new.clone(), None).await.unwrap();
    assert_eq!(store.experiment(&id).await.unwrap(), kept.view);
    assert_eq!(store.experiment_plan(&id).await.unwrap(), kept.plan);
    assert_eq!(store.job(&new.view.id).await.unwrap().result.experiment.as_ref(), Some(&id));

    let claim = claimed(store).await.unwrap().claim;
    store.advance(&claim, transition(Event::Start), AT).await.unwrap();
    let rows = |rows: &[RunRow]| Advance { products: vec![Product::Rows(rows.to_vec())], ..Advance::default() };
    store.advance(&claim, rows(&[row(1, 0), row(0, 1)]), AT).await.unwrap();
    store.advance(&claim, rows(&[row(0, 0)]), AT).await.unwrap();
    // A run that is there already takes the whole step back, its new rows and its count.
    assert!(store.advance(&claim, rows(&[row(1, 1), row(0, 0)]), AT).await.is_err());
    let found = store.experiment(&id).await.unwrap();
    assert_eq!((found.state, found.finished_runs), (State::Running, 3));
    let all = store.experiment_rows(&id, &RowFilter::default()).await.unwrap();
    assert_eq!(all, [row(0, 0), row(0, 1), row(1, 0)]);
    let second = RowFilter { cell: None, after: Some(Which { cell: 0, repetition: 0 }), limit: Some(1) };
    assert_eq!(store.experiment_rows(&id, &second).await.unwrap(), [row(0, 1)]);
    let of_cell = RowFilter { cell: Some(1), ..RowFilter::default() };
    assert_eq!(store.experiment_rows(&id, &of_cell).await.unwrap(), [row(1, 0)]);

    // A lost claim writes no row; a job without an experiment has no place for one.
    store.begin_epoch(AT).await.unwrap();
    let late = store.advance(&claim, rows(&[row(1, 1)]), AT).await;
    assert!(matches!(late, Err(StoreError::LeaseLost { .. })));
    submitted(store, 2).await;
    claimed(store).await.unwrap();
    let plain = claimed(store).await.unwrap().claim;
    assert!(matches!(store.advance(&plain, rows(&[row(0, 0)]), AT).await, Err(StoreError::NotFound { .. })));
    store.submit(experiment(3), None).await.unwrap();
    let names: Vec<_> = store.experiments(&page(9, "")).await.unwrap().into_iter().map(|view| view.name).collect();
    assert_eq!(names, ["experiment 3", "experiment 1"]);
    let missing = ExperimentId::from_uuid(uuid(9));
    assert!(matches!(store.experiment_plan(&missing).await, Err(StoreError::NotFound { .. })));
}
