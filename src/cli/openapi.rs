//! `cgda openapi`: prints the OpenAPI 3.1 document of the REST interface.

use std::io::Write as _;

/// Prints it.
///
/// # Errors
/// When stdout cannot be written.
pub fn run() -> anyhow::Result<()> {
    std::io::stdout().write_all(crate::http::document_json().as_bytes())?;
    Ok(())
}
