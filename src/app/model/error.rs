//! The one error vocabulary of the service: a small kind that each edge maps exhaustively to its own status, a stable
//! code, and the places in the request that are wrong.

use serde::{Deserialize, Serialize};
use std::sync::Arc;
use utoipa::ToSchema;

/// What went wrong, as far as a caller can act on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ErrorKind {
    /// The request cannot be read: a token, a header or an id that is none.
    Malformed,
    /// The request can be read and is wrong; the details say where.
    Invalid,
    /// No such resource.
    NotFound,
    /// The resource's present state does not allow it.
    Conflict,
    /// `If-Match` does not name the present revision.
    Precondition,
    /// More bytes, samples or rows than the limit.
    TooLarge,
    /// No valid credentials.
    Unauthenticated,
    /// Valid credentials that do not allow it.
    Forbidden,
    /// A quota or rate is used up: retry later.
    Exhausted,
    /// The disk of the data directory is full: reading goes on, nothing is written until space is freed.
    StorageFull,
    /// The service cannot answer now: retry later.
    Unavailable,
    /// The service is at fault.
    Internal,
}

impl ErrorKind {
    /// All kinds, for the edges' table tests.
    pub const ALL: [Self; 12] = [
        Self::Malformed,
        Self::Invalid,
        Self::NotFound,
        Self::Conflict,
        Self::Precondition,
        Self::TooLarge,
        Self::Unauthenticated,
        Self::Forbidden,
        Self::Exhausted,
        Self::StorageFull,
        Self::Unavailable,
        Self::Internal,
    ];

    /// Whether the same request may do later, without a change by its sender.
    #[must_use]
    pub fn may_pass(self) -> bool {
        matches!(self, Self::Exhausted | Self::StorageFull | Self::Unavailable)
    }
}

/// One wrong place in a request.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct FieldError {
    /// JSON pointer into the request's body, or into the uploaded data: `/streams/NAME/rows/ROW/COLUMN`.
    pub pointer: String,
    /// Stable code.
    pub code: String,
    /// What is wrong and what to do, with the numbers.
    pub detail: String,
}

impl FieldError {
    /// A wrong place.
    pub fn new(pointer: impl Into<String>, code: impl Into<String>, detail: impl Into<String>) -> Self {
        Self { pointer: pointer.into(), code: code.into(), detail: detail.into() }
    }
}

/// Why a use-case did not do what was asked.
#[derive(Debug, Clone, thiserror::Error)]
#[error("{message}")]
pub struct AppError {
    /// What a caller can do about it.
    pub kind: ErrorKind,
    /// Stable machine-readable code, `snake_case`.
    pub code: &'static str,
    /// One sentence, lowercase, with the numbers.
    pub message: String,
    /// The wrong places, if the request is at fault.
    pub details: Vec<FieldError>,
    /// When to try again, where the kind [may pass](ErrorKind::may_pass).
    pub retry_after_s: Option<u32>,
    /// What failed underneath; logged once at the edge, never shown to the caller.
    #[source]
    pub source: Option<Arc<dyn std::error::Error + Send + Sync>>,
}

impl AppError {
    /// An error without details.
    pub fn new(kind: ErrorKind, code: &'static str, message: impl Into<String>) -> Self {
        Self { kind, code, message: message.into(), details: Vec::new(), retry_after_s: None, source: None }
    }

    /// The request's body is wrong at these places.
    #[must_use]
    pub fn invalid(details: Vec<FieldError>) -> Self {
        let message = match details.as_slice() {
            // The empty pointer is the whole body.
            [only] if only.pointer.is_empty() => only.detail.clone(),
            [only] => format!("{}: {}", only.pointer, only.detail),
            many => format!("{} places of the request are wrong", many.len()),
        };
        Self { details, ..Self::new(ErrorKind::Invalid, "invalid_request", message) }
    }

    /// The request's body is wrong at one place.
    pub fn field(pointer: impl Into<String>, code: &'static str, detail: impl Into<String>) -> Self {
        Self::invalid(vec![FieldError::new(pointer, code, detail)])
    }

    /// There is no such resource.
    pub fn not_found(kind: &str, id: impl std::fmt::Display) -> Self {
        Self::new(ErrorKind::NotFound, "not_found", format!("there is no {kind} {id}"))
    }

    /// The service is at fault; `source` is for the log.
    pub fn internal(source: impl Into<Box<dyn std::error::Error + Send + Sync>>) -> Self {
        let source: Box<dyn std::error::Error + Send + Sync> = source.into();
        Self {
            source: Some(Arc::from(source)),
            ..Self::new(ErrorKind::Internal, "internal", "the service failed to answer; its log has the cause")
        }
    }

    /// The service cannot answer for now.
    pub fn unavailable(code: &'static str, message: impl Into<String>) -> Self {
        Self { retry_after_s: Some(1), ..Self::new(ErrorKind::Unavailable, code, message) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_place_is_told_before_the_detail_and_the_whole_body_has_none() {
        assert_eq!(AppError::field("/a", "wrong", "a is 1").message, "/a: a is 1");
        assert_eq!(AppError::field("", "wrong", "the body is a list").message, "the body is a list");
    }
}
