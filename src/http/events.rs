//! `/jobs/{id}/events`: the events of a job as server-sent events, stored ones first, then live ones.
//!
//! # Architecture Invariants
//! - The id of an event is its durable sequence number: `Last-Event-ID` (or `?after_seq=`) resumes without a gap.
//! - The stream ends after the event of a final state; a request to continue after it gets 204, which tells a browser's
//!   `EventSource` not to reconnect.
//! - A reader that takes nothing for [`EVICT_AFTER`] loses its connection rather than fill the service's memory.

use super::error::status;
use super::extract::{AsCaller, Path, Query};
use super::problem::Problem;
use crate::app::model::{AppError, ErrorKind, EventData, JobEvent, JobId};
use axum::http::{HeaderMap, StatusCode};
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{IntoResponse as _, Response};
use futures_util::StreamExt as _;
use futures_util::stream::BoxStream;
use serde::Deserialize;
use std::convert::Infallible;
use std::time::Duration;
use tokio::sync::mpsc;
use tokio_stream::wrappers::ReceiverStream;
use utoipa::IntoParams;

const PING_EVERY: Duration = Duration::from_secs(15);
const EVICT_AFTER: Duration = Duration::from_secs(30);
const QUEUE: usize = 64;

/// Start position of the stream.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct EventsParameters {
    /// Only events with a greater sequence number; `Last-Event-ID` takes precedence. 0 or absent: all.
    after_seq: Option<u64>,
}

/// Streams every event of a job as server-sent events: `id` is `seq`, `event` is `type`, `data` the event as JSON.
#[utoipa::path(get, path = "/jobs/{id}/events", operation_id = "watchJob", tag = "jobs",
    params(("id" = JobId, Path), EventsParameters,
        ("Last-Event-ID" = Option<u64>, Header, description = "Like `after_seq`; browsers send it automatically.")),
    responses(
        (status = 200, description = "The stream; a ping every 15 s.", body = JobEvent, content_type = "text/event-stream"),
        (status = 204, description = "The job is final and there is no later event: do not reconnect.")))]
pub async fn watch(
    AsCaller(app): AsCaller,
    Path(id): Path<JobId>,
    Query(wanted): Query<EventsParameters>,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let after_seq = last_event_id(&headers)?.or(wanted.after_seq).unwrap_or(0);
    let job = app.get_job(&id).await?;
    if job.state.is_final() && after_seq >= job.last_seq {
        return Ok(StatusCode::NO_CONTENT.into_response());
    }
    let events = app.watch_job(&id, after_seq).await?;
    let stream = ReceiverStream::new(pump(events, EVICT_AFTER));
    let alive = KeepAlive::new().interval(PING_EVERY).text("ping");
    Ok(([("x-accel-buffering", "no")], Sse::new(stream).keep_alive(alive)).into_response())
}

fn last_event_id(headers: &HeaderMap) -> Result<Option<u64>, AppError> {
    let Some(value) = headers.get("last-event-id") else { return Ok(None) };
    let seq = value.to_str().ok().and_then(|text| text.parse().ok());
    let message = "Last-Event-ID must be the id of an event of this stream";
    seq.map(Some).ok_or_else(|| AppError::new(ErrorKind::Malformed, "invalid_last_event_id", message))
}

/// Moves events into a bounded queue until the source ends or the reader stalls for too long.
fn pump(
    mut events: BoxStream<'static, Result<JobEvent, AppError>>,
    patience: Duration,
) -> mpsc::Receiver<Result<Event, Infallible>> {
    let (sender, receiver) = mpsc::channel(QUEUE);
    tokio::spawn(async move {
        loop {
            let next = tokio::select! {
                next = events.next() => next,
                () = sender.closed() => return,
            };
            let Some(event) = next else { return };
            let sent = sender.send_timeout(Ok(encode(&event)), patience).await;
            if sent.is_err() || event.is_err() {
                return;
            }
        }
    });
    receiver
}

fn encode(event: &Result<JobEvent, AppError>) -> Event {
    let encoded = match event {
        Ok(event) => Event::default().id(event.seq.to_string()).event(name(&event.data)).json_data(event),
        Err(error) => {
            let problem = Problem { status: status(error.kind), error: error.clone() };
            Event::default().event("error").json_data(problem.details(""))
        }
    };
    encoded.unwrap_or_else(|_| Event::default().event("error").data("the event cannot be written as JSON"))
}

fn name(data: &EventData) -> &'static str {
    match data {
        EventData::State { .. } => "state",
        EventData::Progress { .. } => "progress",
        EventData::Goal { .. } => "goal",
        EventData::Trial { .. } => "trial",
        EventData::Run { .. } => "run",
        EventData::Resync => "resync",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::model::Timestamp;
    use crate::framework::job::State as JobState;
    use futures_util::stream;

    fn event(seq: u64) -> JobEvent {
        let job = JobId::from_uuid(uuid::Uuid::from_u128(1));
        let data = EventData::State { state: JobState::Running, reason: None, attempt: 1 };
        JobEvent { seq, job, at: Timestamp(0), data }
    }

    #[tokio::test]
    async fn events_arrive_in_order_and_an_error_ends_the_stream() {
        let error = AppError::unavailable("gone", "the store is away");
        let source = stream::iter([Ok(event(1)), Ok(event(2)), Err(error), Ok(event(3))]).boxed();
        let response = Sse::new(ReceiverStream::new(pump(source, EVICT_AFTER))).into_response();
        let body = axum::body::to_bytes(response.into_body(), 1 << 16).await.unwrap();
        let text = String::from_utf8(body.to_vec()).unwrap();
        let lines: Vec<&str> = text.lines().filter(|l| !l.is_empty() && !l.starts_with("data:")).collect();
        assert_eq!(lines, ["id: 1", "event: state", "id: 2", "event: state", "event: error"]);
        assert!(text.contains("\"code\":\"gone\"") && text.contains("\"type\":\"state\""));
    }

    #[tokio::test]
    async fn a_reader_that_takes_nothing_is_evicted() {
        let receiver = pump(stream::iter((1..).map(|seq| Ok(event(seq)))).boxed(), Duration::from_millis(10));
        tokio::time::sleep(Duration::from_millis(200)).await;
        let left = ReceiverStream::new(receiver).count().await;
        assert_eq!(left, QUEUE);
    }

    #[test]
    fn last_event_id_is_a_number() {
        let with = |value: &str| HeaderMap::from_iter([("last-event-id".parse().unwrap(), value.parse().unwrap())]);
        assert_eq!(last_event_id(&with("17")).unwrap(), Some(17));
        assert_eq!(last_event_id(&HeaderMap::new()).unwrap(), None);
        assert_eq!(last_event_id(&with("x")).unwrap_err().kind, ErrorKind::Malformed);
    }
}
