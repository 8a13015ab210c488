//! Engines behind the Store port; `suite.rs` is what each of them must pass.

mod documents;
pub mod sqlite;
#[cfg(test)]
mod suite;
