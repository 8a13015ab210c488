//! Liveness, readiness and the API's description: the three addresses that need no token.

use super::extract::Json;
use super::problem::Problem;
use crate::app::App;
use crate::app::model::AppError;
use axum::extract::State;
use axum::http::header::CONTENT_TYPE;
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use utoipa::ToSchema;

/// Health of the service.
#[derive(Debug, Serialize, ToSchema)]
pub struct Health {
    /// `ok`.
    status: &'static str,
    /// Version of the service.
    version: &'static str,
}

const OK: Health = Health { status: "ok", version: env!("CARGO_PKG_VERSION") };

/// Whether the process answers.
#[utoipa::path(get, path = "/livez", operation_id = "livez", tag = "service", security(()),
    responses((status = 200, description = "The process answers.", body = Health)))]
pub async fn livez() -> Json<Health> {
    Json(OK)
}

/// Whether the service answers requests and works on jobs.
#[utoipa::path(get, path = "/readyz", operation_id = "readyz", tag = "service", security(()),
    responses((status = 200, description = "The service answers requests and works on jobs.", body = Health),
        (status = 503, description = "The service is starting or stopping.")))]
pub async fn readyz(State(app): State<App>) -> Result<Json<Health>, Problem> {
    if !app.is_ready() {
        return Err(AppError::unavailable("not_ready", "the service is starting or stopping").into());
    }
    Ok(Json(OK))
}

/// This document.
#[utoipa::path(get, path = "/openapi.json", operation_id = "getOpenapi", tag = "service", security(()),
    responses((status = 200, description = "The OpenAPI 3.1 document.", body = serde_json::Value)))]
pub async fn openapi() -> Response {
    ([(CONTENT_TYPE, "application/json")], super::document_json()).into_response()
}
