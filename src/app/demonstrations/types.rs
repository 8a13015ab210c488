//! Requests for demonstrations, and what is shown of them.

use crate::app::Timestamp;
use crate::app::id::DemonstrationId;
use crate::framework::Feature;
use crate::framework::demonstration::{ClockPolicy, Finding, Format, ReadOptions};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use utoipa::ToSchema;

/// One uploaded file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UploadFile {
    /// File name as the client gave it; it names the stream, never a path.
    pub file_name: String,
    /// Content.
    pub bytes: Vec<u8>,
}

/// An upload: one file, or several that were recorded together.
#[derive(Debug, Clone, PartialEq)]
pub struct UploadDemonstration {
    /// Display name; the data's own name or the first file's when absent.
    pub name: Option<String>,
    /// At least one file.
    pub files: Vec<UploadFile>,
    /// How to read them.
    pub options: UploadOptions,
}

/// How uploaded files are read; every field is optional.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields, default)]
pub struct UploadOptions {
    /// The form of the files; found from their content when absent.
    pub format: Option<Format>,
    /// What to do about clocks that disagree.
    pub clock_policy: ClockPolicy,
    /// Header of the time column; `time`, `time_s`, `t` or `timestamp` when absent.
    pub time_column: Option<String>,
    /// Features of files without header, in column order after id and time.
    pub features: Vec<Feature>,
    /// As `features`, by stream name.
    pub stream_features: BTreeMap<String, Vec<Feature>>,
    /// Units by feature name; they win over those of the header.
    pub units: BTreeMap<String, String>,
}

impl UploadOptions {
    /// With the service's limits.
    #[must_use]
    pub fn read_options(self, name: Option<String>) -> ReadOptions {
        ReadOptions {
            name,
            format: self.format,
            clock_policy: self.clock_policy,
            time_column: self.time_column,
            features: self.features,
            stream_features: self.stream_features,
            units: self.units,
            ..ReadOptions::default()
        }
    }
}

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

/// Which samples.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SamplesQuery {
    /// Features by name; all when empty.
    pub features: Vec<String>,
    /// From this time on, seconds after the first sample of the demonstration.
    pub from_s: Option<f64>,
    /// Up to this time, seconds after the first sample of the demonstration.
    pub to_s: Option<f64>,
    /// At most so many points a feature (4 to 20000; 1000 when absent), by minimum and maximum of each bin.
    pub max_points: Option<u32>,
}

/// Samples of a demonstration, one series a feature.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct SamplesView {
    /// The demonstration.
    pub demonstration: DemonstrationId,
    /// One series a feature.
    pub series: Vec<Series>,
}

/// One feature's samples.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Series {
    /// Stream name.
    pub stream: String,
    /// Feature.
    pub feature: Feature,
    /// Times, seconds after the first sample of the demonstration.
    pub t_s: Vec<f64>,
    /// Values, in the feature's unit.
    pub values: Vec<f64>,
    /// Whether some samples were left out.
    pub decimated: bool,
}

/// A file to send.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Export {
    /// Media type.
    pub content_type: &'static str,
    /// Suggested name, safe for every file system.
    pub file_name: String,
    /// Content.
    pub bytes: Vec<u8>,
}

impl Export {
    /// A file named after `name`, of which only letters, digits, `-` and `_` are kept.
    #[must_use]
    pub fn new(content_type: &'static str, name: &str, extension: &str, bytes: Vec<u8>) -> Self {
        let safe: String = name
            .chars()
            .map(|c| if c.is_ascii_alphanumeric() || "-_".contains(c) { c } else { '_' })
            .take(80)
            .collect();
        Self { content_type, file_name: format!("{safe}.{extension}"), bytes }
    }
}
