//! Experiment jobs on their own: rows of every run, once each, whatever interrupts the job.

use super::{Held, ask, claim, until};
use crate::app::bench::Bench;
use crate::app::model::{ExperimentId, ExperimentView, JobId, JobView, RowFilter, Work};
use crate::app::ports::{Advance, Experiments as _, Jobs as _, NewExperiment, NewJob, Product, Usage};
use crate::framework::experiment::{self, Plan, RunId, RunRow};
use crate::framework::job::{Event, State};
use crate::jobs::experiment::run;
use crate::jobs::lease::Stop;
use rstest::rstest;
use serde_json::{Value, json};

const SEED: u64 = 7;

/// A cell of the wax preset whose runs end after a few evaluations.
fn short(setting: &str, evaluations: u32) -> Value {
    json!({"action": "wax", "setting": setting, "preset": "wax", "overrides": {"execution":
        {"method": {"name": "sst", "population": 10}, "max_evaluations_per_goal": evaluations}}})
}

/// A cell of the wax preset whose runs end long after every test.
fn endless() -> Value {
    json!({"action": "wax", "setting": "endless", "preset": "wax", "overrides": {"execution":
        {"method": {"name": "sst", "population": 10, "stagnation": 1_000_000_000},
            "tolerance": null, "target_discrepancy": null, "max_evaluations_per_goal": 100_000_000}}})
}

/// A claimed experiment of two repetitions per cell.
async fn claimed(bench: &Bench, cells: &[Value]) -> (Held, ExperimentId) {
    let request = json!({"name": "sizes", "seed": SEED, "repetitions": 2, "cells": cells});
    bench.app.create_experiment(serde_json::from_value(request).unwrap(), None).await.unwrap();
    held(bench).await
}

async fn held(bench: &Bench) -> (Held, ExperimentId) {
    let held = claim(bench).await;
    let Work::Experiment { experiment } = held.work.clone() else { panic!("another kind: {:?}", held.work) };
    (held, experiment)
}

async fn rows(bench: &Bench, id: &ExperimentId) -> Vec<RunRow> {
    bench.store.experiment_rows(id, &RowFilter::default()).await.unwrap()
}

/// The row that the core computes for a run.
fn computed(plan: &Plan, cell: u32, repetition: u32) -> RunRow {
    experiment::run(plan, RunId { cell, repetition }).unwrap()
}

fn stored(row: RunRow) -> Advance {
    Advance { products: vec![Product::Rows(vec![row])], ..Advance::default() }
}

fn failure(ended: Result<(), Stop>) -> (&'static str, String) {
    match ended {
        Err(Stop::Failed { code, message }) => (code, message),
        other => panic!("{other:?}"),
    }
}

#[tokio::test]
async fn every_run_without_a_row_is_executed_and_one_with_a_row_is_not() {
    let bench = Bench::new();
    let (Held { claimed, job, .. }, id) = claimed(&bench, &[short("a", 20), short("b", 30)]).await;
    let plan = bench.store.experiment_plan(&id).await.unwrap();
    let kept = RunRow { digest: "of an earlier attempt".to_owned(), ..computed(&plan, 1, 0) };
    claimed.advance(stored(kept.clone())).await.unwrap();

    run(&claimed, &job, id.clone()).await.unwrap();
    let expected = [computed(&plan, 0, 0), computed(&plan, 0, 1), kept, computed(&plan, 1, 1)];
    assert_eq!(rows(&bench, &id).await, expected);
    let job = bench.store.job(&job.id).await.unwrap();
    let evaluations: u64 = expected.iter().map(|row| row.evaluations).sum();
    assert_eq!((job.state, job.progress.fraction), (State::Succeeded, 1.0));
    assert_eq!(job.progress.total_evaluations, evaluations);
}

/// The endless cell makes certain that the request meets a run under way.
#[rstest]
#[case(Some(Event::Pause), State::Paused)]
#[case(Some(Event::Cancel), State::Cancelled)]
#[case(None, State::Queued)]
#[tokio::test]
async fn an_interrupted_experiment_keeps_finished_rows_and_abandons_runs_under_way(
    #[case] asked: Option<Event>,
    #[case] expected: State,
) {
    let bench = Bench::new();
    let (Held { claimed, job, stop, .. }, id) = claimed(&bench, &[short("a", 20), endless()]).await;
    let interruption = async {
        until(&bench, &job.id, |job| job.progress.fraction > 0.0).await;
        match asked {
            Some(event) => ask(&bench, &job.id, event).await,
            None => stop.cancel(),
        }
    };
    let (ended, ()) = tokio::join!(run(&claimed, &job, id.clone()), interruption);
    assert!(matches!(ended, Err(Stop::Released)), "{ended:?}");
    assert_eq!(bench.store.job(&job.id).await.unwrap().state, expected);
    let plan = bench.store.experiment_plan(&id).await.unwrap();
    let found = rows(&bench, &id).await;
    assert!(!found.is_empty());
    for row in found {
        assert_eq!(row, computed(&plan, 0, row.id.repetition));
    }
}

#[tokio::test]
async fn a_row_that_contradicts_the_plan_fails_the_job() {
    let bench = Bench::new();
    let (Held { claimed, job, .. }, id) = claimed(&bench, &[short("a", 20)]).await;
    let plan = bench.store.experiment_plan(&id).await.unwrap();
    let wrong = RunRow { seed: 99, ..computed(&plan, 0, 0) };
    claimed.advance(stored(wrong)).await.unwrap();
    let (code, message) = failure(run(&claimed, &job, id.clone()).await);
    assert_eq!(code, "corrupt_input");
    assert!(message.contains(id.as_str()) && message.contains("ran seed 99, the plan says 7"), "{message}");
}

/// Submits the experiment of `job` again with another plan, in place of it.
async fn replan(bench: &Bench, job: &JobView, change: impl FnOnce(&mut Plan)) {
    let from = job.result.experiment.clone().unwrap();
    let mut plan = bench.store.experiment_plan(&from).await.unwrap();
    change(&mut plan);
    let id = ExperimentId::from_uuid(bench.ports.ids.uuid());
    let view = JobView { id: JobId::from_uuid(bench.ports.ids.uuid()), ..job.clone() };
    let of_job =
        ExperimentView { id: id.clone(), job: view.id.clone(), ..bench.store.experiment(&from).await.unwrap() };
    let experiment = Some(NewExperiment { view: of_job, plan });
    let new = NewJob { view, work: Work::Experiment { experiment: id }, uses: Usage::default(), experiment };
    bench.store.submit(new, None).await.unwrap();
    ask(bench, &job.id, Event::Cancel).await;
}

#[tokio::test]
async fn a_run_that_cannot_be_executed_fails_the_job_with_its_cell_seed_and_cause() {
    let bench = Bench::new();
    let request = json!({"name": "sizes", "seed": SEED, "cells": [short("a", 20)]});
    let job = bench.app.create_experiment(serde_json::from_value(request).unwrap(), None).await.unwrap();
    replan(&bench, &job, |plan| "nonsense".clone_into(&mut plan.cells[0].problem.urdf)).await;
    let (Held { claimed, job, .. }, id) = held(&bench).await;
    let (code, message) = failure(run(&claimed, &job, id).await);
    assert_eq!(code, "problem");
    assert!(message.starts_with("wax, a with seed 7: robot: "), "{message}");
}
