//! Whole-run methods killed midway: the same bits as on an undisturbed server.

use super::server::{Server, digests, events, pace};
use serde_json::{Value, json};

/// Creates an action of seven steps of the painted percentage, and a wall; returns the fields an execution needs.
async fn paint(server: &Server, wax: &Value) -> Value {
    let rows: String = (0..7).map(|step| format!("{step},{}\n", 6.25 * f64::from(step))).collect();
    let demonstration = server.upload("paint.csv", format!("time_s,painted [%]\n{rows}")).await;
    let request = json!({"kind": "generalization", "name": "paint", "t_min_s": 0.75,
        "demonstrations": [demonstration["id"]]});
    let job = server.post("/api/v1/jobs", &request).await;
    let made = server.ended(job["id"].as_str().unwrap()).await;
    let wall = json!({"kind": "coverage", "origin_m": [0.6, -0.8, 0.32], "column_step_m": [0.0, 0.2, 0.0],
        "row_step_m": [0.0, 0.0, 0.2], "columns": 4, "rows": 4, "radius_m": 0.13});
    let world = server.post("/api/v1/worlds", &json!({"name": "wall", "spec": wall})).await;
    json!({"kind": "execution", "action": made["result"]["action"], "robot": wax["robot"], "world": world["id"]})
}

async fn submit(server: &Server, named: &Value, execution: &Value, rate: Option<f64>) -> String {
    let mut request = named.clone();
    request["execution"] = execution.clone();
    request["seed"] = json!(7);
    request["earlier_runs"] = json!([]);
    request["max_evaluations_per_s"] = json!(rate);
    let job = server.post("/api/v1/jobs", &request).await;
    job["id"].as_str().unwrap().to_owned()
}

#[tokio::test]
async fn a_kill_in_the_middle_changes_no_bit_of_a_method_that_owns_the_run() {
    let data = tempfile::tempdir().unwrap();
    let mut server = Server::start(data.path());
    let wax = server.set_up().await;
    let wall = paint(&server, &wax).await;
    let noisy = json!({"link_share": 0.05, "sensor_noise": 2.0, "joint_noise_deg": 0.1, "lost_share": 0.1});
    let runs = [
        (&wax, json!({"method": {"name": "model", "noise": 2.0}, "tolerance": 20.0, "reality": noisy})),
        (&wall, json!({"method": "particle"})),
        (&wall, json!({"method": "search"})),
    ];
    for (named, execution) in &runs {
        let reference = submit(&server, named, execution, None).await;
        let ended = server.ended(&reference).await;
        assert_eq!(ended["state"], "SUCCEEDED", "{ended}");
        let expected = digests(&server, &ended).await;
        let evaluations = ended["progress"]["evaluations"].as_u64().unwrap();
        assert!(evaluations >= 6, "{evaluations} evaluations have no middle");

        let killed = submit(&server, named, execution, Some(pace(&ended, 5.0))).await;
        server.evaluated(&killed, 3).await;
        server.kill();
        server = Server::start(data.path());
        let ended = server.ended(&killed).await;
        assert_eq!((&ended["state"], &ended["attempt"]), (&json!("SUCCEEDED"), &json!(2)), "{execution}");
        assert_eq!(digests(&server, &ended).await, expected, "{execution}");
        let told = events(&server, &killed).await.iter().filter(|event| event["type"] == "trial").count();
        assert_eq!(told as u64, evaluations, "each trial is told once");
    }
}
