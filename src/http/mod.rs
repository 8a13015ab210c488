//! REST: the router is the URL table; one file per resource.
//!
//! # Architecture Invariants
//! - A handler extracts, makes one `app` call and converts; every decision is made in `app`.
//! - Every error response is a problem (`problem.rs`), including those of axum and of panics (`envelope.rs`).
//! - Only health and the API's description need no credentials (`auth.rs`).
//! - Streams and gRPC, which shares the port, have neither time-outs nor compression.

mod actions;
mod answer;
pub mod assets;
pub mod auth;
mod body;
mod demonstrations;
mod envelope;
pub mod error;
mod events;
mod experiments;
mod extract;
mod health;
mod jobs;
mod methods;
pub mod openapi;
pub mod problem;
mod recognitions;
mod robots;
mod runs;
mod trajectories;
mod uploads;
mod verbs;
mod worlds;

use crate::app::{Access, App};
use axum::Router;
use axum::extract::{DefaultBodyLimit, FromRef, Request};
use axum::http::StatusCode;
use axum::http::header::{CONTENT_TYPE, HeaderName, HeaderValue};
use axum::middleware::from_fn_with_state;
use axum::response::{IntoResponse as _, Response};
use openapi::Table as _;
use std::sync::Arc;
use std::time::Duration;
use tower::ServiceExt as _;
use tower_http::catch_panic::CatchPanicLayer;
use tower_http::compression::CompressionLayer;
use tower_http::timeout::TimeoutLayer;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

/// Path of the API.
pub const API: &str = "/api/v1";

/// Settings of this edge.
#[derive(Debug, Clone)]
pub struct Settings {
    /// Maximum size of a body that is not an upload, bytes.
    pub body_limit_bytes: usize,
    /// Maximum time until the head of a response; uploads and gRPC are exempt.
    pub timeout: Duration,
    /// Host names of this server besides its numeric addresses and `localhost`.
    pub hosts: Vec<String>,
}

/// State that handlers share.
#[derive(Clone)]
pub struct Api {
    app: App,
    settings: Arc<Settings>,
}

impl FromRef<Api> for App {
    fn from_ref(api: &Api) -> Self {
        api.app.clone()
    }
}

impl FromRef<Api> for Arc<Settings> {
    fn from_ref(api: &Api) -> Self {
        Arc::clone(&api.settings)
    }
}

/// The URL table of `/api/v1`.
fn resources() -> OpenApiRouter<Api> {
    OpenApiRouter::new()
        .at(routes!(demonstrations::list))
        .at(routes!(demonstrations::get, demonstrations::patch, demonstrations::delete))
        .at(routes!(demonstrations::samples))
        .at(routes!(demonstrations::report))
        .at(routes!(demonstrations::export))
        .at(routes!(actions::list, actions::create))
        .at(routes!(actions::get))
        .at(routes!(actions::goals))
        .at(routes!(actions::interpolate))
        .at(routes!(actions::export))
        .at(routes!(recognitions::create))
        .at(routes!(robots::list, robots::create))
        .at(routes!(robots::get, robots::delete))
        .at(routes!(robots::urdf))
        .at(routes!(worlds::list, worlds::create))
        .at(routes!(worlds::get, worlds::delete))
        .at(routes!(methods::list))
        .at(routes!(jobs::list, jobs::create))
        .at(routes!(jobs::validate))
        .at(routes!(jobs::get))
        .at(routes!(jobs::pause))
        .at(routes!(jobs::resume))
        .at(routes!(jobs::cancel))
        .at(routes!(jobs::clone))
        .at(routes!(experiments::list, experiments::create))
        .at(routes!(experiments::get))
        .at(routes!(experiments::table))
        .at(routes!(experiments::rows))
        .at(routes!(experiments::compare))
        .at(routes!(experiments::export))
        .at(routes!(runs::list))
        .at(routes!(runs::get))
        .at(routes!(runs::goals))
        .at(routes!(runs::trials))
        .at(routes!(runs::convergence))
        .at(routes!(runs::trajectory))
        .at(routes!(trajectories::get))
        .at(routes!(trajectories::export))
}

/// The rest of the table: uploads and streams, without time-out and without compression.
fn streams() -> OpenApiRouter<Api> {
    OpenApiRouter::new().at(routes!(uploads::create)).at(routes!(events::watch))
}

fn service() -> OpenApiRouter<Api> {
    openapi::start().at(routes!(health::livez)).at(routes!(health::readyz)).at(routes!(health::openapi))
}

/// The OpenAPI document.
#[must_use]
pub fn document() -> serde_json::Value {
    openapi::finish(&service().nest(API, resources().merge(streams())).into_openapi())
}

/// The OpenAPI document as text, as it is served, printed and kept: JSON indented by two spaces, with a final newline.
#[must_use]
pub fn document_json() -> String {
    format!("{:#}\n", document())
}

/// Router of the whole port; `grpc` holds the routes of gRPC and must not have a fallback of its own.
pub fn router(app: App, access: Access, settings: Settings, grpc: Router) -> Router {
    let guard = auth::Guard { access, hosts: settings.hosts.clone().into() };
    let timeout = TimeoutLayer::with_status_code(StatusCode::REQUEST_TIMEOUT, settings.timeout);
    let ports = app.ports();
    let sources = envelope::Sources { clock: Arc::clone(&ports.clock), ids: Arc::clone(&ports.ids) };
    let api = Api { app, settings: Arc::new(settings) };

    let resources = resources()
        .layer(DefaultBodyLimit::max(api.settings.body_limit_bytes))
        .layer(timeout)
        .layer(CompressionLayer::new());
    let streams = streams().layer(DefaultBodyLimit::disable());
    let (rest, _) = service().nest(API, resources.merge(streams)).split_for_parts();
    let rest = rest
        .with_state(api)
        .fallback(fallback)
        .method_not_allowed_fallback(|| async { StatusCode::METHOD_NOT_ALLOWED })
        .layer(from_fn_with_state(guard, auth::require));

    let all = rest
        .merge(grpc)
        .layer(CatchPanicLayer::custom(envelope::panicked))
        .layer(from_fn_with_state(sources, envelope::wrap));
    Router::new().fallback_service(all.map_request(verbs::rewrite))
}

/// Response to a request that no route takes: a file of the dashboard, gRPC's "unimplemented", or 404.
async fn fallback(request: Request) -> Response {
    let content_type = request.headers().get(CONTENT_TYPE).map_or(&b""[..], HeaderValue::as_bytes);
    if content_type.starts_with(b"application/grpc") {
        return grpc_status("12");
    }
    let page = assets::respond(request.method(), request.uri().path(), request.headers());
    page.unwrap_or_else(|| StatusCode::NOT_FOUND.into_response())
}

/// A gRPC response without a message; its headers hold the status (12 unimplemented, 16 unauthenticated).
fn grpc_status(code: &'static str) -> Response {
    let status = HeaderValue::from_static(code);
    let headers = [
        (CONTENT_TYPE, HeaderValue::from_static("application/grpc")),
        (HeaderName::from_static("grpc-status"), status),
    ];
    headers.into_response()
}
