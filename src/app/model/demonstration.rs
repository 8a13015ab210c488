//! Demonstrations, as they are shown and changed.

use super::id::DemonstrationId;
use super::time::Timestamp;
use crate::framework::Feature;
use crate::framework::demonstration::Finding;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// A demonstration without its samples.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct DemonstrationView {
    /// Its id.
    pub id: DemonstrationId,
    /// Display name.
    pub name: String,
    /// Number of times it was changed; `If-Match` compares it.
    pub revision: u64,
    /// Why it is left out of new actions, if it is.
    #[schema(required = true)]
    pub excluded: Option<String>,
    /// Streams.
    pub streams: Vec<StreamView>,
    /// From the first to the last sample of all streams, seconds.
    pub duration_s: f64,
    /// SHA-256 over the streams' samples, hexadecimal.
    pub sha256: String,
    /// Number of findings of the reader.
    pub findings: u32,
    /// When it was uploaded.
    pub created_at: Timestamp,
}

/// One stream without its samples.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct StreamView {
    /// Stream name.
    pub name: String,
    /// Features in column order.
    pub features: Vec<Feature>,
    /// Number of samples.
    pub samples: u64,
    /// Time of the first sample, the recorder's seconds.
    pub start_s: f64,
    /// Duration, seconds.
    pub duration_s: f64,
}

/// What the reader found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct DemonstrationReport {
    /// The demonstration.
    pub demonstration: DemonstrationId,
    /// Findings in the order of the data.
    pub findings: Vec<Finding>,
}

/// A change of a demonstration; absent fields stay.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct PatchDemonstration {
    /// New display name.
    #[serde(default)]
    pub name: Option<String>,
    /// A reason leaves it out of new actions; the empty text takes it in again.
    #[serde(default)]
    pub excluded: Option<String>,
}

impl DemonstrationView {
    /// The demonstration after a change, one revision later. An empty reason for exclusion takes it in again.
    #[must_use]
    pub fn patched(self, patch: PatchDemonstration) -> Self {
        let PatchDemonstration { name, excluded } = patch;
        let excluded = match excluded {
            Some(reason) => Some(reason).filter(|reason| !reason.is_empty()),
            None => self.excluded,
        };
        Self { name: name.unwrap_or(self.name), excluded, revision: self.revision + 1, ..self }
    }
}
