//! HTTP status of each error kind, in one exhaustive match.

use super::problem::Problem;
use crate::app::model::{AppError, ErrorKind};
use axum::http::StatusCode;

/// HTTP status of an error kind.
#[must_use]
pub fn status(kind: ErrorKind) -> StatusCode {
    match kind {
        ErrorKind::Malformed => StatusCode::BAD_REQUEST,
        ErrorKind::Invalid => StatusCode::UNPROCESSABLE_ENTITY,
        ErrorKind::NotFound => StatusCode::NOT_FOUND,
        ErrorKind::Conflict => StatusCode::CONFLICT,
        ErrorKind::Precondition => StatusCode::PRECONDITION_FAILED,
        ErrorKind::TooLarge => StatusCode::PAYLOAD_TOO_LARGE,
        ErrorKind::Unauthenticated => StatusCode::UNAUTHORIZED,
        ErrorKind::Forbidden => StatusCode::FORBIDDEN,
        ErrorKind::Exhausted => StatusCode::TOO_MANY_REQUESTS,
        ErrorKind::StorageFull => StatusCode::INSUFFICIENT_STORAGE,
        ErrorKind::Unavailable => StatusCode::SERVICE_UNAVAILABLE,
        ErrorKind::Internal => StatusCode::INTERNAL_SERVER_ERROR,
    }
}

impl From<AppError> for Problem {
    fn from(mut error: AppError) -> Self {
        error.retry_after_s = if error.kind.may_pass() { error.retry_after_s.or(Some(1)) } else { None };
        Self { status: status(error.kind), error }
    }
}

/// Problem for a status that HTTP itself produces rather than a use case: routing, content negotiation, timeouts.
#[must_use]
pub fn of_status(code: StatusCode) -> Problem {
    let (kind, name, message) = match code {
        StatusCode::NOT_FOUND => (ErrorKind::NotFound, "no_such_route", "there is nothing at this address"),
        StatusCode::METHOD_NOT_ALLOWED => (
            ErrorKind::Malformed,
            "method_not_allowed",
            "this address does not support that method: the Allow header lists those it supports",
        ),
        StatusCode::PAYLOAD_TOO_LARGE => (ErrorKind::TooLarge, "body_too_large", "the body is larger than the limit"),
        StatusCode::UNSUPPORTED_MEDIA_TYPE => {
            (ErrorKind::Malformed, "unsupported_media_type", "this address does not accept that content type")
        }
        StatusCode::REQUEST_TIMEOUT => {
            (ErrorKind::Unavailable, "request_timeout", "the request took longer than the limit")
        }
        status if status.is_server_error() => {
            (ErrorKind::Internal, "internal", "the service failed; its log has the cause")
        }
        _ => (ErrorKind::Malformed, "bad_request", "the request cannot be read"),
    };
    Problem { status: code, error: AppError::new(kind, name, message) }
}
