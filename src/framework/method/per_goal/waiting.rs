//! Record of a candidate between asking and telling, shared by all population methods.

use serde::{Deserialize, Serialize};

/// A candidate without a fitness: the id under which it was handed out, and its row in the population.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Waiting {
    pub id: u64,
    pub slot: usize,
}
