//! RFC 9457 problem details: the form of every error response over HTTP.
//!
//! # Architecture Invariants
//! - A handler or extractor returns a [`Problem`]; the envelope (`envelope.rs`) adds the request id and writes the
//!   body.
//! - The underlying error (`source`) is logged there, once, and never shown.

use crate::app::model::{AppError, FieldError};
use axum::http::StatusCode;
use axum::http::header::{CONTENT_TYPE, HeaderValue, RETRY_AFTER, WWW_AUTHENTICATE};
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Media type of a problem.
pub const CONTENT_TYPE_PROBLEM: &str = "application/problem+json";

/// An error response (RFC 9457).
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct ProblemDetails {
    /// `urn:cgda:problem:` followed by the code.
    #[serde(rename = "type")]
    pub kind: String,
    /// Reason phrase of the status.
    pub title: String,
    /// HTTP status, repeated.
    pub status: u16,
    /// Stable machine-readable code, `snake_case`.
    pub code: String,
    /// Description and remedy, with the numbers.
    pub detail: String,
    /// Identifies this request in the service's log.
    pub request_id: String,
    /// Invalid places in the request; empty if the request is not at fault.
    pub errors: Vec<FieldError>,
}

/// A status and its error, on their way to the envelope.
#[derive(Debug, Clone)]
pub struct Problem {
    /// HTTP status.
    pub status: StatusCode,
    /// The error with its code, message, places and cause.
    pub error: AppError,
}

impl Problem {
    /// The details as sent to the client.
    #[must_use]
    pub fn details(&self, request_id: &str) -> ProblemDetails {
        ProblemDetails {
            kind: format!("urn:cgda:problem:{}", self.error.code),
            title: self.status.canonical_reason().unwrap_or("Error").to_owned(),
            status: self.status.as_u16(),
            code: self.error.code.to_owned(),
            detail: self.error.message.clone(),
            request_id: request_id.to_owned(),
            errors: self.error.details.clone(),
        }
    }

    /// Renders the complete response.
    #[must_use]
    pub fn render(&self, request_id: &str) -> Response {
        let body = serde_json::to_vec(&self.details(request_id)).unwrap_or_default();
        let mut response = (self.status, body).into_response();
        let headers = response.headers_mut();
        headers.insert(CONTENT_TYPE, HeaderValue::from_static(CONTENT_TYPE_PROBLEM));
        if let Some(seconds) = self.error.retry_after_s {
            headers.insert(RETRY_AFTER, HeaderValue::from(seconds));
        }
        if self.status == StatusCode::UNAUTHORIZED {
            headers.insert(WWW_AUTHENTICATE, HeaderValue::from_static("Bearer realm=\"cgda\""));
        }
        response
    }
}

impl IntoResponse for Problem {
    fn into_response(self) -> Response {
        let mut response = self.status.into_response();
        response.extensions_mut().insert(self);
        response
    }
}
