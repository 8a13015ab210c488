//! What every population remembers of a candidate between asking and telling.

use serde::{Deserialize, Serialize};

/// A candidate that has no fitness yet: the id it was handed out under, and its row in the population.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Waiting {
    pub id: u64,
    pub slot: usize,
}
