//! Use-cases of experiments on test doubles: plan, table, pages of rows, comparison, export.

use crate::app::bench::Bench;
use crate::app::model::{ErrorKind, ExperimentId, ExperimentRequest, PageQuery};
use crate::framework::experiment::Quantity;
use serde_json::{Value, json};

fn request(cells: &Value) -> ExperimentRequest {
    serde_json::from_value(json!({"seed": 7, "repetitions": 3, "cells": cells})).unwrap()
}

fn cell(setting: &str) -> Value {
    json!({"action": "wax", "setting": setting, "preset": "wax"})
}

/// An experiment of two cells whose runs are finished, those of the last repetition excepted.
async fn experiment(bench: &Bench) -> ExperimentId {
    let request = request(&json!([cell("fast"), cell("careful")]));
    let job = bench.app.create_experiment(request, None).await.unwrap();
    let id = bench.rows(2, 2).await;
    assert_eq!(job.result.experiment, Some(id.clone()));
    id
}

#[tokio::test]
async fn an_experiment_counts_its_runs_and_its_table_covers_the_finished_ones() {
    let bench = Bench::new();
    let id = experiment(&bench).await;
    let view = bench.app.get_experiment(&id).await.unwrap();
    assert_eq!((view.cells, view.runs, view.finished_runs, view.seed), (2, 6, 4, 7));
    assert_eq!(bench.app.list_experiments(PageQuery::default()).await.unwrap().items, [view]);
    let table = bench.app.experiment_table(&id).await.unwrap();
    let means: Vec<f64> = table.cells.iter().map(|cell| cell.evaluations.unwrap().mean).collect();
    assert_eq!((table.runs, table.finished_runs, means), (6, 4, vec![107.5, 207.5]));
}

#[tokio::test]
async fn rows_come_in_pages_by_cell_and_repetition() {
    let bench = Bench::new();
    let id = experiment(&bench).await;
    let places = async |cell, token: &str| {
        let page = PageQuery { page_size: Some(3), page_token: Some(token.to_owned()) };
        let page = bench.app.experiment_rows(&id, cell, page).await.unwrap();
        let places: Vec<_> = page.items.iter().map(|row| (row.id.cell, row.id.repetition)).collect();
        (places, page.next_page_token)
    };
    let (first, token) = places(None, "").await;
    assert_eq!(first, [(0, 0), (0, 1), (1, 0)]);
    assert_eq!(places(None, &token).await, (vec![(1, 1)], String::new()));
    assert_eq!(places(Some(1), "").await.0, [(1, 0), (1, 1)]);
}

#[tokio::test]
async fn cells_are_compared_seed_by_seed() {
    let bench = Bench::new();
    let id = experiment(&bench).await;
    let compare = async |second, quantity| bench.app.compare_experiment(&id, 0, second, quantity).await;
    let found = compare(1, Quantity::Evaluations).await.unwrap();
    assert_eq!((found.comparison.pairs, found.comparison.mean_difference), (2, 100.0));
    assert!(found.sentence.contains("wax, careful"), "{}", found.sentence);
    assert_eq!(compare(2, Quantity::Evaluations).await.unwrap_err().kind, ErrorKind::Malformed);
    let unpainted = compare(1, Quantity::Painted).await.unwrap_err();
    assert_eq!((unpainted.kind, unpainted.code), (ErrorKind::Conflict, "no_pairs"));
}

#[tokio::test]
async fn an_export_has_a_line_per_cell() {
    let bench = Bench::new();
    let id = experiment(&bench).await;
    for (format, file) in [("csv", "experiment.csv"), ("full_csv", "experiment.csv"), ("markdown", "experiment.md")] {
        let export = bench.app.export_experiment(&id, format).await.unwrap();
        let text = String::from_utf8(export.bytes).unwrap();
        assert_eq!(export.file_name, file);
        assert!(text.contains("fast") && text.contains("careful"), "{format}: {text}");
    }
    assert_eq!(bench.app.export_experiment(&id, "xlsx").await.unwrap_err().code, "unknown_format");
}

#[tokio::test]
async fn a_cell_that_cannot_run_is_refused_by_its_place() {
    let bench = Bench::new();
    let wrong = json!({"action": "wax", "setting": "wrong", "preset": "wax",
        "overrides": {"execution": {"method": {"name": "sst", "population": 0}}}});
    let error = bench.app.create_experiment(request(&json!([cell("fast"), wrong])), None).await.unwrap_err();
    assert_eq!((error.kind, error.details[0].pointer.as_str()), (ErrorKind::Invalid, "/cells/1"));
    let empty = bench.app.create_experiment(request(&json!([])), None).await.unwrap_err();
    assert_eq!((empty.details[0].pointer.as_str(), empty.details[0].code.as_str()), ("/cells", "required"));
}
