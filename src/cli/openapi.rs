//! `cgda openapi`: prints the OpenAPI 3.1 document of the REST API.

use std::io::Write as _;

/// Prints the document.
///
/// # Errors
/// If stdout cannot be written.
pub fn run() -> anyhow::Result<()> {
    std::io::stdout().write_all(crate::http::document_json().as_bytes())?;
    Ok(())
}
