//! Uploads of demonstrations.

use crate::framework::Feature;
use crate::framework::demonstration::{ClockPolicy, Format, ReadOptions};
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
