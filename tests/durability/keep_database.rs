//! Makes a kept database for `tests/fixtures/databases/` with the build at hand, into `target/kept-database/`:
//!
//! ```sh
//! cargo test --locked --workspace --test durability -- --ignored --nocapture keep_a_database
//! ```
//!
//! It holds every kind of resource and of job, every method of the catalogue, and jobs in the states that a user or a
//! crash leaves behind: failed, cancelled, paused, and some that ran or waited when the server was killed.

use super::server::{Server, digests};
use flate2::Compression;
use flate2::write::GzEncoder;
use serde_json::{Map, Value, json};
use sqlx::{Connection as _, Executor as _, SqliteConnection};
use std::fs::{self, File};
use std::io::Write as _;
use std::path::Path;

/// Lists, and the parts that can be read of each of their items.
const READS: [(&str, &[&str]); 6] = [
    ("demonstrations", &["/report", "/samples?max_points=20"]),
    ("actions", &["/goals"]),
    ("robots", &["/urdf"]),
    ("worlds", &[]),
    ("runs", &["/goals", "/trials", "/convergence?max_points=20"]),
    ("experiments", &["/table", "/rows?page_size=100"]),
];

/// Runs whose whole trajectory is kept among the answers, which it would fill otherwise.
const TRAJECTORIES: usize = 2;

fn id(resource: &Value) -> String {
    resource["id"].as_str().unwrap().to_owned()
}

/// The server and the requests that an execution can start from.
struct Making {
    server: Server,
    /// The arm reaches for points in the air.
    reach: Value,
    /// The arm paints a wall.
    paint: Value,
}

impl Making {
    async fn start(data: &Path) -> Self {
        let server = Server::start(data);
        let reach = server.set_up().await;
        let csv = "time_s,painted [%]\n0,0\n1,25\n2,50\n".to_owned();
        let demonstration = server.upload("paint.csv", csv).await;
        let request = json!({"kind": "generalization", "name": "paint", "t_min_s": 0.75, "demonstrations": [demonstration["id"]]});
        let made = server.ended(&id(&server.post("/api/v1/jobs", &request).await)).await;
        let wall = json!({"kind": "coverage", "origin_m": [0.6, -0.4, 0.32], "column_step_m": [0.0, 0.2, 0.0],
            "row_step_m": [0.0, 0.0, 0.2], "columns": 2, "rows": 2, "radius_m": 0.13});
        let wall = server.post("/api/v1/worlds", &json!({"name": "wall", "spec": wall})).await;
        let mut paint = reach.clone();
        paint["action"] = made["result"]["action"].clone();
        paint["world"] = wall["id"].clone();
        Self { server, reach, paint }
    }

    /// Submits an execution that differs from `base` in what `changes` says.
    async fn submit(&self, base: &Value, name: &str, execution: Value, pace: Option<f64>) -> String {
        let mut request = base.clone();
        (request["name"], request["seed"], request["execution"]) = (json!(name), json!(7), execution);
        request["max_evaluations_per_s"] = json!(pace);
        id(&self.server.post("/api/v1/jobs", &request).await)
    }

    /// A job per method: reaching with a limit per goal, reaching with a plan for all goals, or painting, whichever the
    /// method accepts first.
    async fn every_method(&self) {
        for method in self.server.get("/api/v1/methods").await["items"].as_array().unwrap() {
            let name = &method["name"];
            let settings = [
                (&self.reach, json!({"method": name, "max_evaluations_per_goal": 30})),
                (&self.reach, json!({"method": name, "tolerance": 15})),
                (&self.paint, json!({"method": name})),
            ];
            let mut accepted = None;
            for (base, execution) in settings {
                let mut request = base.clone();
                request["execution"] = execution.clone();
                if self.server.post("/api/v1/jobs:validate", &request).await["valid"] == true {
                    accepted = Some((base, execution));
                    break;
                }
            }
            let (base, execution) = accepted.unwrap_or_else(|| panic!("no setting fits {name}: add one"));
            let job = self.submit(base, name.as_str().unwrap(), execution, None).await;
            let ended = self.server.ended(&job).await;
            assert_eq!(ended["state"], "SUCCEEDED", "{ended}");
        }
    }

    /// Jobs with constraints, with a robot that is not as described, of each end, and an experiment.
    async fn every_end(&self) {
        let sphere = |side: &str| {
            json!([{"kind": "region", "side": side, "geometry": {"shape": "sphere", "center_m": [9, 9, 9],
                "radius_m": 0.1}}, {"kind": "joint_step", "limit_rad": 3}])
        };
        let swarm = json!({"name": "pso", "swarm": {"population": 6, "stagnation": 1}});
        let kept = json!({"method": swarm, "max_evaluations_per_goal": 30, "constraints": sphere("outside"),
            "handling": {"strategy": "penalty", "penalty": {"kind": "static", "weight": 2.5}},
            "on_infeasible": "append"});
        let lost = json!({"method": {"name": "model", "noise": 1}, "tolerance": 15,
            "reality": {"link_share": 0.05, "sensor_noise": 1, "lost_share": 0.1, "seed": 3}});
        let impossible = json!({"method": swarm, "max_evaluations_per_goal": 30, "constraints": sphere("inside")});
        let jobs = [
            ("kept in bounds", kept, "SUCCEEDED"),
            ("noisy arm", lost, "SUCCEEDED"),
            ("impossible", impossible, "FAILED"),
        ];
        for (name, execution, end) in jobs {
            let ended = self.server.ended(&self.submit(&self.reach, name, execution, None).await).await;
            assert_eq!(ended["state"], end, "{ended}");
        }
        let cancelled = self.submit(&self.reach, "cancelled", json!({"method": "sst"}), Some(20.0)).await;
        self.server.evaluated(&cancelled, 1).await;
        self.server.post(&format!("/api/v1/jobs/{cancelled}:cancel"), &json!({})).await;
        self.server.ended(&cancelled).await;
        let cell = |setting: &str, most: u32| {
            json!({"action": "wax", "setting": setting, "preset": "wax",
                "overrides": {"execution": {"max_evaluations_per_goal": most}}})
        };
        let experiment = json!({"name": "few or more", "seed": 7, "repetitions": 2,
            "cells": [cell("few", 10), cell("more", 20)]});
        let ended = self.server.ended(&id(&self.server.post("/api/v1/experiments", &experiment).await)).await;
        assert_eq!(ended["state"], "SUCCEEDED", "{ended}");
    }

    /// A paused job, and as many running ones as there are workers, with one that waits.
    async fn unfinished(&self) -> (String, Vec<String>) {
        let searched = |method: &str| json!({"method": method, "max_evaluations_per_goal": 400});
        let paused = self.submit(&self.reach, "paused on the way", searched("sst"), Some(300.0)).await;
        self.server.evaluated(&paused, 450).await;
        self.server.post(&format!("/api/v1/jobs/{paused}:pause"), &json!({})).await;
        self.server.until(&paused, |job| job["state"] == "PAUSED").await;
        let mut live = Vec::new();
        for (base, method, pace, execution) in [
            (&self.reach, "sst", 200.0, searched("sst")),
            (&self.reach, "de", 200.0, searched("de")),
            (&self.reach, "model", 2.0, json!({"method": "model"})),
            (&self.paint, "search", 2.0, json!({"method": "search"})),
            (&self.reach, "pso", 200.0, searched("pso")),
        ] {
            live.push(self.submit(base, &format!("killed on the way, {method}"), execution, Some(pace)).await);
        }
        for (job, evaluations) in live.iter().zip([250, 250, 2, 2]) {
            self.server.evaluated(job, evaluations).await;
        }
        (paused, live)
    }

    /// The answer of every read but those of jobs that are still to change, by path.
    async fn answers(&self, live: &[String]) -> Map<String, Value> {
        let mut answers = Map::new();
        for (list, parts) in READS {
            let path = format!("/{list}?page_size=100");
            let page = self.server.get(&format!("/api/v1{path}")).await;
            for (index, item) in page["items"].as_array().unwrap().iter().enumerate() {
                let item_path = format!("/{list}/{}", id(item));
                let has_trajectory = index < TRAJECTORIES && item["trajectory"].is_string();
                let parts = parts.iter().chain(has_trajectory.then_some(&"/trajectory"));
                for path in std::iter::once(item_path.clone()).chain(parts.map(|part| format!("{item_path}{part}"))) {
                    let text = self.server.text(&format!("/api/v1{path}")).await;
                    answers.insert(path, serde_json::from_str(&text).unwrap_or(Value::String(text)));
                }
            }
            answers.insert(path, page);
        }
        for job in self.server.get("/api/v1/jobs?page_size=100").await["items"].as_array().unwrap() {
            if !live.contains(&id(job)) {
                answers.insert(format!("/jobs/{}", id(job)), job.clone());
            }
        }
        answers
    }
}

/// Moves the write-ahead log of a database whose server was killed into its file.
async fn complete(database: &Path) {
    let mut connection = SqliteConnection::connect(&format!("sqlite://{}", database.display())).await.unwrap();
    connection.execute("PRAGMA wal_checkpoint(TRUNCATE)").await.unwrap();
    connection.close().await.unwrap();
}

fn pack(path: &Path, content: &[u8]) -> usize {
    let mut packed = GzEncoder::new(File::create(path).unwrap(), Compression::best());
    packed.write_all(content).unwrap();
    packed.finish().unwrap();
    usize::try_from(fs::metadata(path).unwrap().len()).unwrap()
}

#[tokio::test]
#[ignore = "makes a fixture, which only a changed schema or document needs"]
async fn keep_a_database() {
    let data = tempfile::tempdir().unwrap();
    let mut making = Making::start(data.path()).await;
    making.every_method().await;
    making.every_end().await;
    let (paused, live) = making.unfinished().await;
    let answers = making.answers(&live).await;
    making.server.kill();
    let database = data.path().join("cgda.db");
    complete(&database).await;
    let kept = fs::read(&database).unwrap();

    let server = Server::start(data.path());
    server.post(&format!("/api/v1/jobs/{paused}:resume"), &json!({})).await;
    let mut resumed = Map::new();
    for job in live.iter().chain([&paused]) {
        let ended = server.ended(job).await;
        let digest = &digests(&server, &ended).await[0];
        resumed.insert(job.clone(), json!({"name": ended["name"], "state": ended["state"], "digest": digest}));
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/kept-database");
    fs::create_dir_all(&folder).unwrap();
    let answers = json!({"answers": answers, "paused": paused, "resumed": resumed});
    let bytes =
        pack(&folder.join("cgda.db.gz"), &kept) + pack(&folder.join("answers.json.gz"), answers.to_string().as_bytes());
    println!("{}: {} kB", folder.display(), bytes / 1000);
    assert!(bytes < 500_000, "{bytes} bytes are too many to keep in the repository");
}
