//! Orderly stops and pauses: checkpoints are written, and results are the same as without them.

use super::server::{Server, digests, pace};
use serde_json::json;
use std::time::Duration;

#[tokio::test]
async fn a_terminated_server_exits_soon_and_its_job_goes_on_with_the_same_bits() {
    let data = tempfile::tempdir().unwrap();
    let mut server = Server::start(data.path());
    let mut request = server.set_up().await;
    request["seed"] = json!(5);
    let alone = server.post("/api/v1/jobs", &request).await;
    let alone = server.ended(alone["id"].as_str().unwrap()).await;
    let expected = digests(&server, &alone).await;

    request["max_evaluations_per_s"] = json!(pace(&alone, 5.0));
    let job = server.post("/api/v1/jobs", &request).await["id"].as_str().unwrap().to_owned();
    server.evaluated(&job, 1).await;
    let (took, well) = server.terminate();
    assert!(well && took < Duration::from_secs(10), "{took:?}");

    let server = Server::start(data.path());
    let ended = server.ended(&job).await;
    assert_eq!((ended["state"].as_str(), ended["attempt"].as_u64()), (Some("SUCCEEDED"), Some(2)), "{ended}");
    assert_eq!(digests(&server, &ended).await, expected);
}

#[tokio::test]
async fn a_paused_job_rests_and_goes_on_with_the_same_bits_and_a_cancelled_one_ends() {
    let data = tempfile::tempdir().unwrap();
    let server = Server::start(data.path());
    let mut request = server.set_up().await;
    request["seed"] = json!(6);
    let alone = server.post("/api/v1/jobs", &request).await;
    let alone = server.ended(alone["id"].as_str().unwrap()).await;
    let expected = digests(&server, &alone).await;

    request["max_evaluations_per_s"] = json!(pace(&alone, 5.0));
    let job = server.post("/api/v1/jobs", &request).await["id"].as_str().unwrap().to_owned();
    let at = format!("/api/v1/jobs/{job}");
    server.evaluated(&job, 1).await;
    server.post(&format!("{at}:pause"), &json!({})).await;
    let resting = server.until(&job, |view| view["state"] == "PAUSED").await;
    server.work_on_something_else().await;
    let later = server.get(&at).await;
    assert_eq!(later["progress"], resting["progress"]);
    assert!(later["progress"]["evaluations"].as_u64().unwrap() > 0);
    server.post(&format!("{at}:resume"), &json!({})).await;
    let ended = server.ended(&job).await;
    assert_eq!(ended["state"], "SUCCEEDED");
    assert_eq!(digests(&server, &ended).await, expected);

    request["max_evaluations_per_s"] = json!(pace(&alone, 60.0));
    let job = server.post("/api/v1/jobs", &request).await["id"].as_str().unwrap().to_owned();
    server.evaluated(&job, 1).await;
    server.post(&format!("/api/v1/jobs/{job}:cancel"), &json!({})).await;
    assert_eq!(server.ended(&job).await["state"], "CANCELLED");
}
