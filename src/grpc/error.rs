//! gRPC code of each error kind, in one exhaustive match, with the error details of google.rpc.

use crate::app::model::{AppError, ErrorKind};
use std::collections::HashMap;
use std::time::Duration;
use tonic::{Code, Status};
use tonic_types::{ErrorDetails, FieldViolation, StatusExt as _};

/// `domain` of every ErrorInfo.
pub const DOMAIN: &str = "cgda";

/// gRPC code of an error kind.
#[must_use]
pub fn code(kind: ErrorKind) -> Code {
    match kind {
        ErrorKind::Malformed | ErrorKind::Invalid => Code::InvalidArgument,
        ErrorKind::NotFound => Code::NotFound,
        ErrorKind::Conflict => Code::FailedPrecondition,
        ErrorKind::Precondition => Code::Aborted,
        ErrorKind::TooLarge | ErrorKind::Exhausted | ErrorKind::StorageFull => Code::ResourceExhausted,
        ErrorKind::Unauthenticated => Code::Unauthenticated,
        ErrorKind::Forbidden => Code::PermissionDenied,
        ErrorKind::Unavailable => Code::Unavailable,
        ErrorKind::Internal => Code::Internal,
    }
}

/// Status with ErrorInfo (`reason` is the error's code), BadRequest (`field` is the JSON pointer) and RetryInfo. The
/// underlying error is logged here, once.
pub fn status(error: AppError) -> Status {
    if let Some(source) = &error.source {
        tracing::error!(error = %source, error.code = error.code, "failed");
    }
    let mut details = ErrorDetails::with_error_info(error.code, DOMAIN, HashMap::<String, String>::new());
    if !error.details.is_empty() {
        let violations: Vec<FieldViolation> = error.details.iter().map(violation).collect();
        details.set_bad_request(violations);
    }
    if error.kind.may_pass() {
        let seconds = error.retry_after_s.unwrap_or(1);
        details.set_retry_info(Some(Duration::from_secs(u64::from(seconds))));
    }
    Status::with_error_details(code(error.kind), error.message, details)
}

fn violation(field: &crate::app::model::FieldError) -> FieldViolation {
    let mut violation = FieldViolation::new(&field.pointer, &field.detail);
    violation.reason.clone_from(&field.code);
    violation
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::model::FieldError;

    #[test]
    fn the_code_the_places_and_the_delay_are_in_the_details() {
        let mut error = AppError::invalid(vec![FieldError::new("/rows/3/x", "non_finite", "x is nan")]);
        error.code = "bad_data";
        let details = status(error).get_error_details();
        assert_eq!(details.error_info().unwrap().reason, "bad_data");
        assert_eq!(details.bad_request().unwrap().field_violations[0].field, "/rows/3/x");
        assert!(details.retry_info().is_none());
        let retry = status(AppError::unavailable("busy", "busy")).get_error_details();
        assert_eq!(retry.retry_info().unwrap().retry_delay, Some(Duration::from_secs(1)));
    }

    #[test]
    fn the_cause_stays_inside() {
        let status = status(AppError::internal("a password"));
        let sent = [status.message().as_bytes(), status.details()].concat();
        assert!(!sent.windows(8).any(|bytes| bytes == b"password"));
    }
}
