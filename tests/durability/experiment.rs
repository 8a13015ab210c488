//! The paper's Table 1 as an experiment over REST, killed twice on the way: the result equals the command line's table
//! to the last digit.

use super::server::{PATIENCE, Server, events};
use serde_json::{Value, json};
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

const REPETITIONS: u32 = 12;
const SEED: u32 = 21;
/// Evaluations per goal of a long run.
const LONG_EVALUATIONS: u32 = 20_000;

/// Output of the command line.
fn reproduced() -> String {
    let [repetitions, seed] = [REPETITIONS, SEED].map(|number| number.to_string());
    let arguments = ["reproduce", "--table", "1", "--repetitions", &repetitions, "--seed", &seed, "--csv"];
    let output = Command::new(env!("CARGO_BIN_EXE_cgda")).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// Waits until the given number of runs is stored.
async fn reached(server: &Server, at: &str, runs: u64) -> u64 {
    let started = Instant::now();
    loop {
        let finished = server.get(at).await["finished_runs"].as_u64().unwrap();
        if finished >= runs {
            return finished;
        }
        assert!(started.elapsed() < PATIENCE, "{finished} of {runs} runs");
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
}

/// The paper's cells, and after them one whose runs take many times as long. As long as runs are executed in order, such
/// a run is the last of each repetition: whoever sees half of the runs stored has the other half's long ones before the
/// end, on any machine.
fn request(repetitions: u32) -> Value {
    let long = json!({"action": "wax", "setting": "long", "preset": "paper-wax", "overrides": {"execution":
        {"method": {"name": "sst", "stagnation": 1_000_000}, "max_evaluations_per_goal": LONG_EVALUATIONS}}});
    json!({"paper_table": 1, "repetitions": repetitions, "seed": SEED, "cells": [long]})
}

#[tokio::test]
async fn table_1_killed_twice_equals_the_command_line_to_the_last_digit() {
    let data = tempfile::tempdir().unwrap();
    let mut server = Server::start_in_order(data.path());
    let job = server.post("/api/v1/experiments", &request(REPETITIONS)).await;
    let at = format!("/api/v1/experiments/{}", job["result"]["experiment"].as_str().unwrap());
    let runs = server.get(&at).await["runs"].as_u64().unwrap();
    assert_eq!(runs, 5 * u64::from(REPETITIONS));
    let mut stored = Vec::new();
    let restarts: [fn(&Path) -> Server; 2] = [Server::start_in_order, Server::start];
    for (share, restart) in [4, 2].into_iter().zip(restarts) {
        stored.push(reached(&server, &at, runs / share).await);
        server.kill();
        server = restart(data.path());
        // Everything stored is still there, and the table is available before the end.
        let table = server.get(&format!("{at}/table")).await;
        assert!(table["finished_runs"].as_u64().unwrap() >= *stored.last().unwrap());
    }
    assert!(stored[1] < runs, "the second kill came after the end: the test shows nothing");
    let job = job["id"].as_str().unwrap();
    let ended = server.ended(job).await;
    assert_eq!((ended["state"].as_str(), ended["attempt"].as_u64()), (Some("SUCCEEDED"), Some(3)), "{ended}");
    assert_eq!(ended["progress"]["fraction"], 1.0);
    let interrupted = events(&server, job).await.iter().filter(|event| event["state"] == "INTERRUPTED").count();
    assert_eq!(interrupted, 2);

    let csv = server.text(&format!("{at}:export?format=csv")).await;
    eprintln!("killed with {} and {} of {runs} runs stored:\n{csv}", stored[0], stored[1]);
    let of_paper: String = csv.split_inclusive('\n').filter(|line| !line.contains(",long,")).collect();
    assert_eq!(of_paper, reproduced());
}

#[tokio::test]
async fn a_paused_experiment_rests_goes_on_and_shows_rows_comparisons_and_files() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start_in_order(data.path());
    let job = server.post("/api/v1/experiments", &request(6)).await;
    let (id, name) = (job["id"].as_str().unwrap(), job["result"]["experiment"].as_str().unwrap());
    let at = format!("/api/v1/experiments/{name}");
    reached(&server, &at, 1).await;
    server.post(&format!("/api/v1/jobs/{id}:pause"), &json!({})).await;
    server.until(id, |view| view["state"] == "PAUSED").await;
    let resting = server.get(&at).await;
    server.work_on_something_else().await;
    assert_eq!(server.get(&at).await, resting);
    assert!(resting["finished_runs"].as_u64().unwrap() < 30, "{resting}");
    server.post(&format!("/api/v1/jobs/{id}:resume"), &json!({})).await;
    assert_eq!(server.ended(id).await["state"], "SUCCEEDED");

    let mut rows = Vec::new();
    let mut token = String::new();
    loop {
        let page = server.get(&format!("{at}/rows?page_size=10&page_token={token}")).await;
        rows.extend(page["items"].as_array().unwrap().clone());
        page["next_page_token"].as_str().unwrap().clone_into(&mut token);
        if token.is_empty() {
            break;
        }
    }
    let places: Vec<_> =
        rows.iter().map(|row| (row["cell"].as_u64().unwrap(), row["repetition"].as_u64().unwrap())).collect();
    let planned: Vec<_> = (0..5).flat_map(|cell| (0..6).map(move |repetition| (cell, repetition))).collect();
    assert_eq!(places, planned);
    for row in &rows {
        assert_eq!(row["provenance"]["simulated"], row["evaluations"], "{row}");
    }
    let compared = server.get(&format!("{at}:compare?first=0&second=1&quantity=evaluations")).await;
    assert_eq!(compared["comparison"]["pairs"], 6);
    let markdown = server.text(&format!("{at}:export?format=markdown")).await;
    assert_eq!(markdown.lines().count(), 2 + 5, "{markdown}");
    let list = server.get("/api/v1/experiments").await;
    assert_eq!(list["items"][0]["id"], name);
}
