//! Callers: on whose behalf a use-case runs.

use std::fmt;

/// Whoever an edge has admitted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Caller {
    /// The holder of the server's token, and the server itself when it makes its demo.
    LocalOperator,
}

impl fmt::Display for Caller {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::LocalOperator => f.write_str("local operator"),
        }
    }
}
