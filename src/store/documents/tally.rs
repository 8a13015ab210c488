//! The number of fitness values by origin, in documents that may be older than some of its fields.

use super::{complete, document};
use crate::framework::method::per_goal::Tally as Counted;
use serde_json::{Value, json};

document! {
    /// The number of fitness values by origin.
    Tally keeps Counted {
        simulated: u64,
        real: u64,
        inherited: u64,
        granule: u64,
        penalised: u64,
        worsened: u64,
        rejected: u64,
        repaired: u64,
    }
}

/// Gives the document a whole `provenance`; what an older build did not count is 0.
pub(super) fn complete_tally(document: &mut Value) {
    complete(document, "provenance", json!({}));
    let Some(tally) = document.get_mut("provenance") else { return };
    for field in ["simulated", "real", "inherited", "granule", "penalised", "worsened", "rejected", "repaired"] {
        complete(tally, field, 0);
    }
}
