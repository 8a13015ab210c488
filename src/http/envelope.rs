//! The outermost layer: assigns the request id, catches panics, turns every error into a problem, logs one line.
//!
//! The query is never logged, because a browser's first request carries the token in it.

use super::error::of_status;
use super::problem::{CONTENT_TYPE_PROBLEM, Problem};
use crate::app::model::AppError;
use crate::app::ports::{Clock, Ids};
use axum::extract::{Request, State};
use axum::http::header::{ALLOW, CONTENT_TYPE, HeaderName, HeaderValue};
use axum::middleware::Next;
use axum::response::{IntoResponse as _, Response};
use std::any::Any;
use std::sync::Arc;

const REQUEST_ID: HeaderName = HeaderName::from_static("x-request-id");
const MAX_REQUEST_ID: usize = 64;

/// Ports of the envelope.
#[derive(Clone)]
pub struct Sources {
    /// Measures the duration of a request.
    pub clock: Arc<dyn Clock>,
    /// Source of ids for requests that come without a usable one.
    pub ids: Arc<dyn Ids>,
}

/// Middleware around every request.
pub async fn wrap(State(sources): State<Sources>, request: Request, next: Next) -> Response {
    let started = sources.clock.elapsed();
    let id = request_id(&request).unwrap_or_else(|| sources.ids.token());
    let (method, path) = (request.method().clone(), request.uri().path().to_owned());
    let grpc = request.headers().get(CONTENT_TYPE).is_some_and(|v| v.as_bytes().starts_with(b"application/grpc"));
    let answer = next.run(request).await;
    let mut response = as_problem(answer, &id, grpc);
    if let Ok(value) = HeaderValue::from_str(&id) {
        response.headers_mut().insert(REQUEST_ID, value);
    }
    response.headers_mut().entry("x-content-type-options").or_insert(HeaderValue::from_static("nosniff"));
    tracing::info!(
        request.id = %id,
        http.method = %method,
        http.path = %path,
        http.status = response.status().as_u16(),
        duration_ms = u64::try_from(sources.clock.elapsed().saturating_sub(started).as_millis()).unwrap_or(u64::MAX),
        "answered"
    );
    response
}

/// Turns a panic into an internal error; the panic hook has already logged its location.
pub fn panicked(_: Box<dyn Any + Send>) -> Response {
    Problem::from(AppError::internal("a handler panicked")).into_response()
}

/// The client's own id, if it is short and plain.
fn request_id(request: &Request) -> Option<String> {
    let plain = |text: &&str| {
        !text.is_empty()
            && text.len() <= MAX_REQUEST_ID
            && text.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'-' || b == b'_')
    };
    let given = request.headers().get(&REQUEST_ID).and_then(|value| value.to_str().ok()).filter(plain);
    given.map(str::to_owned)
}

fn as_problem(mut response: Response, id: &str, grpc: bool) -> Response {
    let status = response.status();
    let problem = match response.extensions_mut().remove::<Problem>() {
        Some(problem) => problem,
        None if (status.is_client_error() || status.is_server_error()) && !is_own(&response) => of_status(status),
        None => return response,
    };
    if let Some(source) = &problem.error.source {
        tracing::error!(request.id = %id, error = %source, error.code = problem.error.code, "failed");
    }
    if grpc {
        return super::grpc_status("13");
    }
    let mut rendered = problem.render(id);
    if let Some(allow) = response.headers_mut().remove(ALLOW) {
        rendered.headers_mut().insert(ALLOW, allow);
    }
    rendered
}

/// Whether an error response already has the form its reader expects: gRPC's own, a problem, or a page for people.
fn is_own(response: &Response) -> bool {
    let content_type = response.headers().get(CONTENT_TYPE).and_then(|value| value.to_str().ok()).unwrap_or("");
    ["application/grpc", CONTENT_TYPE_PROBLEM, "text/html"].iter().any(|own| content_type.starts_with(own))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::model::Timestamp;
    use axum::Router;
    use axum::body::Body;
    use axum::http::StatusCode;
    use axum::routing::get;
    use std::time::Duration;
    use tower::ServiceExt as _;
    use tower_http::catch_panic::CatchPanicLayer;

    /// Ports that return constants.
    struct Stopped;

    impl Clock for Stopped {
        fn now(&self) -> Timestamp {
            Timestamp(0)
        }

        fn elapsed(&self) -> Duration {
            Duration::ZERO
        }
    }

    impl Ids for Stopped {
        fn uuid(&self) -> uuid::Uuid {
            uuid::Uuid::nil()
        }

        fn seed(&self) -> u64 {
            0
        }

        fn token(&self) -> String {
            "drawn".to_owned()
        }
    }

    async fn ask(router: Router, method: &str, path: &str, id: &str) -> (StatusCode, String, serde_json::Value) {
        let request = Request::builder().method(method).uri(path).header(REQUEST_ID, id).body(Body::empty()).unwrap();
        let response = router.oneshot(request).await.unwrap();
        let status = response.status();
        let id = response.headers()[&REQUEST_ID].to_str().unwrap().to_owned();
        let body = axum::body::to_bytes(response.into_body(), 1 << 16).await.unwrap();
        (status, id, serde_json::from_slice(&body).unwrap_or_default())
    }

    fn router() -> Router {
        async fn broken() -> Response {
            panic!("on purpose")
        }
        let sources = Sources { clock: Arc::new(Stopped), ids: Arc::new(Stopped) };
        Router::new()
            .route("/", get(broken))
            .layer(CatchPanicLayer::custom(panicked))
            .layer(axum::middleware::from_fn_with_state(sources, wrap))
    }

    #[tokio::test]
    async fn a_panic_a_wrong_method_and_a_wrong_address_are_problems_with_the_callers_request_id() {
        for (method, path, status, code) in [
            ("GET", "/", 500, "internal"),
            ("PUT", "/", 405, "method_not_allowed"),
            ("GET", "/nowhere", 404, "no_such_route"),
        ] {
            let (got, id, body) = ask(router(), method, path, "abc-1").await;
            assert_eq!((got.as_u16(), id.as_str()), (status, "abc-1"));
            assert_eq!((body["code"].as_str(), body["request_id"].as_str()), (Some(code), Some("abc-1")), "{path}");
            assert_eq!(body["status"], status);
        }
    }

    #[tokio::test]
    async fn a_request_id_that_could_forge_a_log_line_is_replaced() {
        let (_, id, _) = ask(router(), "GET", "/nowhere", "two words").await;
        assert_eq!(id, "drawn");
    }
}
