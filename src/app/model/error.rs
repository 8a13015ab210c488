//! The service's one error vocabulary: a small kind that each edge maps exhaustively to its own status, a stable code,
//! and the invalid places in the request.

use serde::{Deserialize, Serialize};
use std::sync::Arc;
use utoipa::ToSchema;

/// Kind of an error, by what a caller can do about it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ErrorKind {
    /// The request cannot be parsed, for example a token, a header or an id in the wrong form.
    Malformed,
    /// The request can be parsed but is invalid; the details say where.
    Invalid,
    /// No such resource.
    NotFound,
    /// Not allowed in the resource's current state.
    Conflict,
    /// `If-Match` does not name the current revision.
    Precondition,
    /// More bytes, samples or rows than allowed.
    TooLarge,
    /// No valid credentials.
    Unauthenticated,
    /// Valid credentials without the required permission.
    Forbidden,
    /// A quota or rate is exhausted: retry later.
    Exhausted,
    /// The disk of the data directory is full: reads still work, writes do not until space is freed.
    StorageFull,
    /// Temporarily unavailable: retry later.
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

    /// Whether the same request may succeed later, unchanged.
    #[must_use]
    pub fn may_pass(self) -> bool {
        matches!(self, Self::Exhausted | Self::StorageFull | Self::Unavailable)
    }
}

/// One invalid place in a request.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct FieldError {
    /// JSON pointer into the request's body, or into the uploaded data: `/streams/NAME/rows/ROW/COLUMN`.
    pub pointer: String,
    /// Stable code.
    pub code: String,
    /// Description and remedy, with the numbers.
    pub detail: String,
}

impl FieldError {
    /// Creates a detail for one place.
    pub fn new(pointer: impl Into<String>, code: impl Into<String>, detail: impl Into<String>) -> Self {
        Self { pointer: pointer.into(), code: code.into(), detail: detail.into() }
    }
}

/// The reason why a use case failed.
#[derive(Debug, Clone, thiserror::Error)]
#[error("{message}")]
pub struct AppError {
    /// Kind, by what the caller can do about it.
    pub kind: ErrorKind,
    /// Stable machine-readable code, `snake_case`.
    pub code: &'static str,
    /// One sentence, lowercase, with the numbers.
    pub message: String,
    /// Invalid places in the request; empty if it is not at fault.
    pub details: Vec<FieldError>,
    /// Delay before a retry, seconds; only for kinds that [may pass](ErrorKind::may_pass).
    pub retry_after_s: Option<u32>,
    /// Underlying error; logged once at the edge, never shown to the caller.
    #[source]
    pub source: Option<Arc<dyn std::error::Error + Send + Sync>>,
}

impl AppError {
    /// An error without details.
    pub fn new(kind: ErrorKind, code: &'static str, message: impl Into<String>) -> Self {
        Self { kind, code, message: message.into(), details: Vec::new(), retry_after_s: None, source: None }
    }

    /// The request's body is invalid at these places.
    #[must_use]
    pub fn invalid(details: Vec<FieldError>) -> Self {
        let message = match details.as_slice() {
            // The empty pointer denotes the whole body.
            [only] if only.pointer.is_empty() => only.detail.clone(),
            [only] => format!("{}: {}", only.pointer, only.detail),
            many => format!("{} places in the request are invalid", many.len()),
        };
        Self { details, ..Self::new(ErrorKind::Invalid, "invalid_request", message) }
    }

    /// The request's body is invalid at one place.
    pub fn field(pointer: impl Into<String>, code: &'static str, detail: impl Into<String>) -> Self {
        Self::invalid(vec![FieldError::new(pointer, code, detail)])
    }

    /// There is no such resource.
    pub fn not_found(kind: &str, id: impl std::fmt::Display) -> Self {
        Self::new(ErrorKind::NotFound, "not_found", format!("there is no {kind} {id}"))
    }

    /// The service is at fault; `source` goes to the log only.
    pub fn internal(source: impl Into<Box<dyn std::error::Error + Send + Sync>>) -> Self {
        let source: Box<dyn std::error::Error + Send + Sync> = source.into();
        Self {
            source: Some(Arc::from(source)),
            ..Self::new(ErrorKind::Internal, "internal", "the service failed; its log has the cause")
        }
    }

    /// The service is temporarily unavailable.
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
