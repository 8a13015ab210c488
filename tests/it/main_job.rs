//! The main job over HTTP: demonstrations in, joint trajectory out.

use super::clients::Http;
use super::events::read_events;
use super::server::Server;
use super::work::{begun, digests, ended, finished, job, prepare};
use serde_json::{Value, json};

#[tokio::test]
async fn demonstrations_become_a_checked_trajectory() {
    let server = Server::start();
    let http = Http::new(&server);
    let made = prepare(&http).await;

    let goals = http.get(&format!("/actions/{}/goals", made.action)).await.expect(200);
    assert_eq!(goals.json["features"][0], json!({"name": "x", "unit": "mm"}));
    assert_eq!(goals.json["goals"].as_array().unwrap().len(), 9);

    let submitted = http.post("/jobs", &job(&made, 7, 2)).await.expect(202);
    let id = submitted.text("/id").to_owned();
    assert_eq!(submitted.headers["location"], format!("/api/v1/jobs/{id}"));
    let events = read_events(&http, &id, None).await;
    assert_eq!(events.last().unwrap().data["state"], "SUCCEEDED");

    let done = finished(&http, &id).await;
    let runs = done.json["result"]["runs"].as_array().unwrap().clone();
    assert_eq!(runs.len(), 2);
    let told: Vec<&str> = events.iter().filter_map(|event| event.data["digest"].as_str()).collect();
    let kept = digests(&http, &id).await;
    assert_eq!(told, kept);
    assert_ne!(kept[0], kept[1]);

    let run = http.get(&format!("/runs/{}", runs[0].as_str().unwrap())).await.expect(200);
    let goals = http.get(&format!("/runs/{}/goals", run.text("/id"))).await.expect(200);
    let sum: u64 = goals.json["goals"].as_array().unwrap().iter().filter_map(|goal| goal["evaluations"].as_u64()).sum();
    assert_eq!(run.json["evaluations"], sum);

    let trajectory = http.get(&format!("/trajectories/{}", run.text("/trajectory"))).await.expect(200);
    check_trajectory(&trajectory.json);
    for (format, start) in [("csv", "time_s,"), ("json", "{"), ("ros2", "")] {
        let path = format!("/trajectories/{}:export?format={format}", trajectory.text("/id"));
        let file = http.get(&path).await.expect(200);
        assert!(file.text.starts_with(start) && file.text.contains("shoulder_pitch"), "{format}: {}", file.text);
        assert!(file.headers["content-disposition"].to_str().unwrap().starts_with("attachment"));
    }
}

fn check_trajectory(trajectory: &Value) {
    let points = trajectory["points"].as_array().unwrap();
    let times: Vec<f64> = points.iter().filter_map(|point| point["t_s"].as_f64()).collect();
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]));
    assert!((times[0], trajectory["duration_s"].as_f64()) == (0.0, times.last().copied()));
    let still =
        |point: &Value| point["velocities"].as_array().unwrap().iter().all(|v| v.as_f64().unwrap().abs() < 1e-9);
    assert!(still(&points[0]) && still(&points[points.len() - 1]));
    assert_eq!(points[0]["positions"].as_array().unwrap().len(), trajectory["joint_names"].as_array().unwrap().len());
}

#[tokio::test]
async fn a_job_killed_with_its_server_ends_with_the_same_digests() {
    let server = Server::start();
    let http = Http::new(&server);
    let made = prepare(&http).await;
    let plain = http.post("/jobs", &job(&made, 11, 2)).await.expect(202).text("/id").to_owned();
    finished(&http, &plain).await;
    let expected = digests(&http, &plain).await;

    let mut slow = job(&made, 11, 2);
    slow["max_evaluations_per_s"] = json!(200.0);
    let slow = http.post("/jobs", &slow).await.expect(202).text("/id").to_owned();
    begun(&http, &slow).await;
    let server = server.kill_and_restart();
    let http = Http::new(&server);
    let job = ended(&http, &slow).await;
    assert_eq!(job.text("/state"), "SUCCEEDED", "{}", job.text);
    assert!(job.json["attempt"].as_u64().unwrap() >= 2, "{}", job.text);
    assert_eq!(digests(&http, &slow).await, expected);
}
