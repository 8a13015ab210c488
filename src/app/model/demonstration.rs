//! Demonstrations, as shown and changed.

use super::id::DemonstrationId;
use super::time::Timestamp;
use crate::framework::Feature;
use crate::framework::demonstration::Finding;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// A demonstration without its samples.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct DemonstrationView {
    /// Id of the demonstration.
    pub id: DemonstrationId,
    /// Display name.
    pub name: String,
    /// Revision: 1 at first, then one more with each change; `If-Match` names it.
    pub revision: u64,
    /// Reason for leaving it out of new actions; absent if it is not left out.
    #[schema(required = true)]
    pub excluded: Option<String>,
    /// Streams that were recorded together.
    pub streams: Vec<StreamView>,
    /// Time from the first to the last sample of all streams, seconds.
    pub duration_s: f64,
    /// SHA-256 over the streams' samples, hexadecimal.
    pub sha256: String,
    /// Number of findings of the reader.
    pub findings: u32,
    /// Time of upload.
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

/// Findings of the reader.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct DemonstrationReport {
    /// Id of the demonstration.
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
    /// Reason for leaving it out of new actions; an empty text includes it again.
    #[serde(default)]
    pub excluded: Option<String>,
}

impl DemonstrationView {
    /// The demonstration after a change, one revision later. An empty reason for exclusion includes it again.
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
