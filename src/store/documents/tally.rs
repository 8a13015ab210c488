//! The count of where fitness values come from, in documents that may be older than some of its fields.

use super::complete;
use serde_json::{Value, json};

/// Gives the document a whole `provenance`; what an older build did not count is 0.
pub(super) fn complete_tally(document: &mut Value) {
    complete(document, "provenance", json!({}));
    let Some(tally) = document.get_mut("provenance") else { return };
    for field in ["simulated", "real", "inherited", "granule", "penalised", "worsened", "rejected", "repaired"] {
        complete(tally, field, 0);
    }
}
