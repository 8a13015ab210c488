//! 20 jobs run while the server is killed 10 times: every job ends exactly once, with the bits of an undisturbed
//! server.

use super::server::{PATIENCE, Server, digests, events};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::time::{Duration, Instant};

const JOBS: u64 = 20;
const KILLS: u32 = 10;
/// Workers of the server.
const WORKERS: u64 = 4;
/// Time the jobs would take altogether if nobody killed the server, s: several times that of all kills.
const SECONDS: f64 = 20.0;

async fn submit(server: &Server, named: &Value, evaluations_per_s: Option<f64>) -> Vec<String> {
    let mut jobs = Vec::new();
    for number in 0..JOBS {
        let mut request = named.clone();
        request["seed"] = json!(1000 + 10 * number);
        request["repetitions"] = json!(2);
        request["max_evaluations_per_s"] = json!(evaluations_per_s);
        let job = server.post("/api/v1/jobs", &request).await;
        jobs.push(job["id"].as_str().unwrap().to_owned());
    }
    jobs
}

/// Digests of each job on an undisturbed server, and the number of evaluations of all jobs.
async fn reference() -> (Vec<Vec<String>>, u64) {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let named = server.set_up().await;
    let (mut found, mut evaluations) = (Vec::new(), 0);
    for job in submit(&server, &named, None).await {
        let ended = server.ended(&job).await;
        assert_eq!(ended["state"], "SUCCEEDED", "{ended}");
        found.push(digests(&server, &ended).await);
        evaluations += ended["progress"]["total_evaluations"].as_u64().unwrap();
    }
    (found, evaluations)
}

/// Evaluations of each running job by its id.
async fn running(server: &Server) -> BTreeMap<String, u64> {
    let list = server.get("/api/v1/jobs?page_size=100").await;
    let running = list["items"].as_array().unwrap().iter().filter(|job| job["state"] == "RUNNING");
    let counted =
        running.map(|job| (job["id"].as_str().unwrap(), job["progress"]["total_evaluations"].as_u64().unwrap()));
    counted.map(|(id, evaluations)| (id.to_owned(), evaluations)).collect()
}

/// Waits until jobs run and each of them has reached a checkpoint: a kill then meets some, and none is killed again and
/// again before its first checkpoint, after which it would count as the reason of the crashes.
async fn checkpointed(server: &Server) {
    let started = Instant::now();
    let mut before = running(server).await;
    loop {
        tokio::time::sleep(Duration::from_millis(10)).await;
        let now = running(server).await;
        for (id, evaluations) in &now {
            // A job that started in the meantime has to make progress, too.
            before.entry(id.clone()).or_insert(*evaluations);
        }
        if !now.is_empty() && now.iter().all(|(id, evaluations)| *evaluations > before[id]) {
            return;
        }
        assert!(started.elapsed() < PATIENCE, "no checkpoint of every running job: {before:?}, {now:?}");
    }
}

#[tokio::test]
async fn ten_kills_lose_no_job_double_none_and_change_no_bit() {
    let (expected, evaluations) = reference().await;
    let rate = evaluations as f64 / (SECONDS * WORKERS as f64);
    let data = tempfile::tempdir().unwrap();
    let mut server = Server::start(data.path());
    let named = server.set_up().await;
    let jobs = submit(&server, &named, Some(rate)).await;
    let started = Instant::now();
    for kill in 0..KILLS {
        checkpointed(&server).await;
        // At varying points of the jobs' cycle of slices and checkpoints.
        tokio::time::sleep(Duration::from_millis(u64::from(kill * 97 % 230))).await;
        server.kill();
        server = Server::start(data.path());
    }
    let killing = started.elapsed();
    let (mut attempts, mut interrupted) = (0, 0);
    for (job, expected) in jobs.iter().zip(&expected) {
        let ended = server.ended(job).await;
        assert_eq!(ended["state"], "SUCCEEDED", "{ended}");
        assert_eq!(&digests(&server, &ended).await, expected, "{job}");
        attempts += ended["attempt"].as_u64().unwrap();
        let events = events(&server, job).await;
        assert!(events.iter().enumerate().all(|(index, event)| event["seq"] == index as u64 + 1), "{job}");
        let count = |key: &str, value: &str| events.iter().filter(|event| event[key] == value).count();
        assert_eq!((count("state", "SUCCEEDED"), count("type", "run")), (1, 2), "{job}");
        interrupted += count("state", "INTERRUPTED");
        assert_eq!(events.last().unwrap()["state"], "SUCCEEDED");
    }
    eprintln!("{KILLS} kills in {killing:?}: {attempts} attempts for {JOBS} jobs, {interrupted} times interrupted");
    assert!(interrupted >= KILLS as usize, "the kills met only {interrupted} running jobs: the test shows nothing");
}
