//! Jobs: idempotency, dry run, pause, resume, cancel.

use super::clients::{Http, send};
use super::server::Server;
use super::work::{begun, digests, ended, finished, job, prepare, until};
use reqwest::Method;
use serde_json::{Value, json};

#[tokio::test]
async fn one_key_is_one_job_and_one_body() {
    let server = Server::start();
    let http = Http::new(&server);
    let made = prepare(&http).await;
    let submit = |body: Value| send(http.request(Method::POST, "/jobs").header("idempotency-key", "k-1").json(&body));
    let first = submit(job(&made, 1, 1)).await.expect(202);
    let again = submit(job(&made, 1, 1)).await.expect(202);
    assert_eq!(first.text("/id"), again.text("/id"));
    let other = submit(job(&made, 2, 1)).await;
    assert!([409, 422].contains(&other.status), "{}", other.text);
    let long = http.request(Method::POST, "/jobs").header("idempotency-key", "k".repeat(129)).json(&job(&made, 1, 1));
    send(long).await.expect_problem(400, "invalid_idempotency_key");
    let many = (0..20)
        .map(|_| send(http.request(Method::POST, "/jobs").header("idempotency-key", "k-2").json(&job(&made, 5, 1))));
    let answers = futures_util::future::join_all(many).await;
    let mut ids: Vec<String> = answers.iter().filter(|a| a.status == 202).map(|a| a.text("/id").to_owned()).collect();
    assert!(answers.iter().all(|answer| [202, 409].contains(&answer.status)));
    ids.dedup();
    assert_eq!(ids.len(), 1);
}

#[tokio::test]
async fn a_dry_run_tells_errors_and_cost_and_creates_nothing() {
    let server = Server::start();
    let http = Http::new(&server);
    let made = prepare(&http).await;
    let before = http.get("/jobs").await.expect(200).json["items"].as_array().unwrap().len();
    let good = http.post("/jobs:validate", &job(&made, 1, 1)).await.expect(200);
    assert_eq!(good.json["valid"], true, "{}", good.text);
    assert!(good.json["estimate"]["evaluations"].as_u64().unwrap() > 0);
    let mut wrong = job(&made, 1, 1);
    wrong["repetitions"] = json!(0);
    let bad = http.post("/jobs:validate", &wrong).await.expect(200);
    assert_eq!((&bad.json["valid"], bad.text("/errors/0/pointer")), (&json!(false), "/repetitions"), "{}", bad.text);
    assert_eq!(http.get("/jobs").await.expect(200).json["items"].as_array().unwrap().len(), before);
    http.post("/jobs", &wrong).await.expect(422);
}

#[tokio::test]
async fn a_paused_job_rests_goes_on_and_ends_with_the_same_digest() {
    let server = Server::start();
    let http = Http::new(&server);
    let made = prepare(&http).await;
    let plain = http.post("/jobs", &job(&made, 4, 1)).await.expect(202).text("/id").to_owned();
    finished(&http, &plain).await;
    let mut slow = job(&made, 4, 1);
    slow["max_evaluations_per_s"] = json!(200.0);
    let id = http.post("/jobs", &slow).await.expect(202).text("/id").to_owned();
    begun(&http, &id).await;
    http.post(&format!("/jobs/{id}:pause"), &Value::Null).await.expect(200);
    until(&http, &id, |job| job.text("/state") == "PAUSED").await;
    http.post(&format!("/jobs/{id}:pause"), &Value::Null).await.expect(409);
    http.post(&format!("/jobs/{id}:resume"), &Value::Null).await.expect(200);
    finished(&http, &id).await;
    assert_eq!(digests(&http, &id).await, digests(&http, &plain).await);
}

#[tokio::test]
async fn a_cancelled_job_ends_once() {
    let server = Server::start();
    let http = Http::new(&server);
    let made = prepare(&http).await;
    let mut slow = job(&made, 1, 1);
    slow["max_evaluations_per_s"] = json!(20.0);
    let id = http.post("/jobs", &slow).await.expect(202).text("/id").to_owned();
    http.post(&format!("/jobs/{id}:cancel"), &Value::Null).await.expect(200);
    assert_eq!(ended(&http, &id).await.text("/state"), "CANCELLED");
    http.post(&format!("/jobs/{id}:cancel"), &Value::Null).await.expect(409);
    let listed = http.get("/jobs?state=CANCELLED&kind=execution").await.expect(200);
    assert_eq!(listed.json["items"].as_array().unwrap().len(), 1);
    http.get("/jobs?state=DANCING").await.expect_problem(400, "invalid_query");
}
