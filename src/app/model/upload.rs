//! Uploads of demonstrations.

use crate::framework::Feature;
use crate::framework::demonstration::{ClockPolicy, Format, Limits, ReadOptions};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// One uploaded file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UploadFile {
    /// File name from the client; it names the stream and is never used as a path.
    pub file_name: String,
    /// Raw content of the file.
    pub bytes: Vec<u8>,
}

/// An upload: one file, or several that were recorded together.
#[derive(Debug, Clone, PartialEq)]
pub struct UploadDemonstration {
    /// Display name; if absent, the name in the data or else that of the first file.
    pub name: Option<String>,
    /// One or more files.
    pub files: Vec<UploadFile>,
    /// Options for reading them.
    pub options: UploadOptions,
}

/// Options for reading uploaded files; all are optional.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct UploadOptions {
    /// Format of the files; detected from their content if absent.
    pub format: Option<Format>,
    /// Treatment of clocks that disagree.
    pub clock_policy: ClockPolicy,
    /// Header of the time column; if absent, `time`, `time_s`, `t` and `timestamp` are recognized.
    pub time_column: Option<String>,
    /// Features of files without a header, in the order of the columns after id and time.
    pub features: Vec<Feature>,
    /// Like `features`, by stream name.
    pub stream_features: BTreeMap<String, Vec<Feature>>,
    /// Units by feature name; they override those of the header.
    pub units: BTreeMap<String, String>,
}

impl UploadOptions {
    /// Converts to the reader's options, with at most `limit_bytes` of all files together.
    #[must_use]
    pub fn read_options(self, name: Option<String>, limit_bytes: usize) -> ReadOptions {
        ReadOptions {
            name,
            format: self.format,
            clock_policy: self.clock_policy,
            time_column: self.time_column,
            features: self.features,
            stream_features: self.stream_features,
            units: self.units,
            limits: Limits { bytes: limit_bytes as u64, ..Limits::default() },
            ..ReadOptions::default()
        }
    }
}
