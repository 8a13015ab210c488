//! References of a request; a missing resource is an invalid place of the request.

use crate::app::model::{AppError, FieldError};
use crate::app::ports::StoreError;

/// The resource found; a missing reference is recorded in `errors`.
pub(super) fn look_up<T>(
    errors: &mut Vec<FieldError>,
    pointer: &str,
    found: Result<T, StoreError>,
) -> Result<Option<T>, AppError> {
    match found {
        Ok(value) => Ok(Some(value)),
        Err(error) => {
            errors.push(missing(pointer, error)?);
            Ok(None)
        }
    }
}

/// Turns a missing reference into an invalid place of the request; passes every other error on.
pub(super) fn missing(pointer: impl Into<String>, error: StoreError) -> Result<FieldError, AppError> {
    match error {
        StoreError::NotFound { .. } => Ok(FieldError::new(pointer, "not_found", error.to_string())),
        error => Err(error.into()),
    }
}
