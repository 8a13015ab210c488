//! Server-sent events: order, durable ids, resumption, end of stream.

use super::clients::{Http, send};
use super::server::Server;
use super::work::{finished, job, prepare};
use futures_util::StreamExt as _;
use reqwest::Method;
use serde_json::Value;

/// One event of a stream.
#[derive(Debug, Clone, PartialEq)]
pub struct Event {
    pub id: u64,
    pub kind: String,
    pub data: Value,
}

/// Reads a job's events until the server ends the stream.
pub async fn read_events(http: &Http, job: &str, last_event_id: Option<u64>) -> Vec<Event> {
    let mut request = http.request(Method::GET, &format!("/jobs/{job}/events"));
    if let Some(id) = last_event_id {
        request = request.header("last-event-id", id);
    }
    let response = request.send().await.unwrap();
    assert_eq!(response.status(), 200);
    assert_eq!(response.headers()["content-type"], "text/event-stream");
    let mut stream = response.bytes_stream();
    let mut text = String::new();
    while let Some(chunk) = stream.next().await {
        text += std::str::from_utf8(&chunk.unwrap()).unwrap();
    }
    text.split("\n\n").filter(|block| block.contains("data:")).map(parse).collect()
}

fn parse(block: &str) -> Event {
    let field = |name: &str| block.lines().find_map(|line| line.strip_prefix(name)).unwrap_or("").trim().to_owned();
    let data = serde_json::from_str(&field("data:")).unwrap();
    Event { id: field("id:").parse().unwrap(), kind: field("event:"), data }
}

#[tokio::test]
async fn events_have_gapless_ids_and_go_on_after_the_last_one_seen() {
    let server = Server::start();
    let http = Http::new(&server);
    let made = prepare(&http).await;
    let id = http.post("/jobs", &job(&made, 3, 1)).await.expect(202).text("/id").to_owned();
    let live = read_events(&http, &id, None).await;
    let ids: Vec<u64> = live.iter().map(|event| event.id).collect();
    assert_eq!(ids, (1..=ids.len() as u64).collect::<Vec<_>>());
    assert!(live.iter().all(|event| event.data["seq"] == event.id && event.data["type"] == event.kind.as_str()));
    assert_eq!((live[0].kind.as_str(), live[0].data["state"].as_str()), ("state", Some("QUEUED")));
    let goals = live.iter().filter(|event| event.kind == "goal").count();
    assert_eq!(goals, 9);

    let last = ids.len() as u64;
    finished(&http, &id).await;
    assert_eq!(read_events(&http, &id, None).await, live);
    assert_eq!(read_events(&http, &id, Some(last - 2)).await, live[ids.len() - 2..]);
    let over = http.request(Method::GET, &format!("/jobs/{id}/events?after_seq={last}"));
    send(over).await.expect(204);
    let wrong = http.request(Method::GET, &format!("/jobs/{id}/events")).header("last-event-id", "x");
    send(wrong).await.expect_problem(400, "invalid_last_event_id");
}
