//! Engines behind the Store port; each passes the conformance suite in `suite/`.

mod documents;
pub mod sqlite;
#[cfg(test)]
mod suite;
