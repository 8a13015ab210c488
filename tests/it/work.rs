//! Building blocks of the main job: the shipped wax demonstrations, the shipped arm, a tool-position world.

use super::clients::{Answer, Http, send};
use reqwest::Method;
use serde_json::{Value, json};
use std::time::{Duration, Instant};

/// The shipped demonstrations of waxing, in order.
pub fn demonstrations() -> Vec<(String, Vec<u8>)> {
    let name = |i: i32| format!("wax-{i}.csv");
    (1..=4).map(|i| (name(i), example(&format!("demonstrations/wax/demo-{i}.csv")))).collect()
}

/// Content of a file of `examples/`.
pub fn example(path: &str) -> Vec<u8> {
    std::fs::read(format!("{}/examples/{path}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

/// The shipped arm, its three free joints as in the paper.
pub fn robot() -> Value {
    let urdf = String::from_utf8(example("robots/teo_right_arm.urdf")).unwrap();
    let spec = json!({
        "fixed": {"shoulder_yaw": 0.0, "wrist_yaw": -std::f64::consts::FRAC_PI_4, "wrist_pitch": 0.0},
        "acceleration": {"shoulder_pitch": 2.0, "shoulder_roll": 2.0, "elbow_pitch": 2.0},
    });
    json!({"name": "right arm", "urdf": urdf, "spec": spec})
}

/// World that observes the tool's position, mm.
pub fn world() -> Value {
    json!({"name": "tool", "spec": {"kind": "tool_position", "unit": "mm"}})
}

/// A short search that finds something, yet is quick in a debug build.
pub fn execution() -> Value {
    json!({"method": {"name": "sst", "population": 10, "stagnation": 2}, "metric": "multivariate"})
}

/// Ids of an execution's inputs, created over HTTP.
pub struct Made {
    pub demonstrations: Vec<String>,
    pub action: String,
    pub robot: String,
    pub world: String,
}

/// Uploads, generalizes, and creates robot and world.
pub async fn prepare(http: &Http) -> Made {
    let mut ids = Vec::new();
    for (name, bytes) in demonstrations() {
        ids.push(upload(http, &name, bytes).await.expect(201).text("/id").to_owned());
    }
    let request = json!({"name": "wax", "demonstrations": ids, "t_min_s": 1.0, "weighting": "per_demonstration"});
    let job = http.post("/actions", &request).await.expect(202);
    let job = finished(http, job.text("/id")).await;
    let action = job.text("/result/action").to_owned();
    let robot = http.post("/robots", &robot()).await.expect(201).text("/id").to_owned();
    let world = http.post("/worlds", &world()).await.expect(201).text("/id").to_owned();
    Made { demonstrations: ids, action, robot, world }
}

/// An execution of the prepared inputs.
pub fn job(made: &Made, seed: u64, repetitions: u32) -> Value {
    json!({"kind": "execution", "action": made.action, "robot": made.robot, "world": made.world,
        "execution": execution(), "seed": seed, "repetitions": repetitions})
}

/// Uploads one file as the raw body.
pub async fn upload(http: &Http, name: &str, bytes: Vec<u8>) -> Answer {
    let path = format!("/demonstrations?name={name}&file_name={name}");
    send(http.request(Method::POST, &path).header("content-type", "text/csv").body(bytes)).await
}

/// Waits until the job is final and asserts that it succeeded.
pub async fn finished(http: &Http, id: &str) -> Answer {
    let job = ended(http, id).await;
    assert_eq!(job.text("/state"), "SUCCEEDED", "{}", job.text);
    job
}

/// Waits until the job is final.
pub async fn ended(http: &Http, id: &str) -> Answer {
    until(http, id, |job| ["SUCCEEDED", "FAILED", "CANCELLED"].contains(&job.text("/state"))).await
}

/// The job once it has made an evaluation.
pub async fn begun(http: &Http, id: &str) -> Answer {
    until(http, id, |job| job.json["progress"]["total_evaluations"].as_u64().unwrap() > 0).await
}

/// The job once `condition` holds; an idle machine needs seconds, the limit is for the busiest.
pub async fn until(http: &Http, id: &str, condition: impl Fn(&Answer) -> bool) -> Answer {
    let started = Instant::now();
    loop {
        let job = http.get(&format!("/jobs/{id}")).await.expect(200);
        if condition(&job) {
            return job;
        }
        assert!(started.elapsed() < Duration::from_mins(5), "it does not get there: {}", job.text);
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
}

/// Digests of a job's runs, by repetition.
pub async fn digests(http: &Http, job: &str) -> Vec<String> {
    let runs = http.get(&format!("/runs?job={job}")).await.expect(200);
    let mut runs: Vec<Value> = runs.json["items"].as_array().unwrap().clone();
    runs.sort_by_key(|run| run["repetition"].as_u64());
    runs.iter().map(|run| run["digest"].as_str().unwrap().to_owned()).collect()
}
