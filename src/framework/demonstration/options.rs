//! Options for reading a file; all are optional and derived from the content by default.

use crate::Feature;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Format of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "schema", schema(as = UploadFormat))]
pub enum Format {
    /// Separated by comma, semicolon or tab, with a header line.
    Csv,
    /// Separated by spaces, without a header: id, time (s), values. YARP logs at full rate and the authors' reduced
    /// files.
    Yarp,
    /// Canonical JSON: `{name, streams: [{name, features: [{name, unit}], time_s: [..], values: [[..], ..]}]}`.
    Json,
}

/// Treatment of the clocks of a demonstration's streams.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum ClockPolicy {
    /// Times stay as they were recorded.
    #[default]
    AsRecorded,
    /// Every stream is shifted to start at 0 s; for recorders whose clocks disagree.
    AlignByStart,
}

/// Options for reading a file or bundle.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ReadOptions {
    /// Name of the demonstration. If absent, the name in the JSON or else that of the stream is used.
    pub name: Option<String>,
    /// Stream name for a single file that has none of its own; `stream` if absent.
    pub stream: Option<String>,
    /// Format of the file; detected from its content if absent.
    pub format: Option<Format>,
    /// Header of the time column; if absent, `time`, `time_s`, `t` and `timestamp` are recognized.
    pub time_column: Option<String>,
    /// Units by feature name; they override those of the header.
    pub units: BTreeMap<String, String>,
    /// Features of files without a header, in the order of the columns after id and time. If empty, those known for the
    /// stream's name or else `value_1`, ...
    pub features: Vec<Feature>,
    /// Like `features`, per stream name of a bundle.
    pub stream_features: BTreeMap<String, Vec<Feature>>,
    /// Treatment of clocks that disagree.
    pub clock_policy: ClockPolicy,
    /// Upper and lower bounds; a file outside them is rejected.
    pub limits: Limits,
}

/// Bounds beyond which a file is rejected as too large, too long or implausible.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Limits {
    /// Bytes of all files of a demonstration in total.
    pub bytes: u64,
    /// Bytes of one line.
    pub line_bytes: usize,
    /// Samples of all streams of a demonstration in total.
    pub samples: u64,
    /// Features of all streams of a demonstration in total.
    pub features: usize,
    /// Number of streams of a demonstration.
    pub streams: usize,
    /// Shortest time from first to last sample, seconds.
    pub min_duration_s: f64,
    /// Longest time from first to last sample, seconds.
    pub max_duration_s: f64,
    /// Largest magnitude of a value, in the feature's unit.
    pub max_magnitude: f64,
    /// Number of findings after which reading stops.
    pub findings: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            bytes: 256 << 20,
            line_bytes: 64 << 10,
            samples: 5_000_000,
            features: 64,
            streams: 32,
            min_duration_s: 0.01,
            max_duration_s: 3600.0,
            max_magnitude: 1e9,
            findings: 100,
        }
    }
}

/// Features of the authors' streams by stream name, for files without a header.
///
/// A name that contains `painted-percentage` has painted (%); `wrist-force`: forces (N) and torques (N m) of the wrist
/// sensor; `hand-pose`: position (m), unit axis and angle (deg). `None` for other names or another number of columns.
#[must_use]
pub fn known_features(stream: &str, columns: usize) -> Option<Vec<Feature>> {
    let table: &[(&str, &str)] = match stream {
        _ if stream.contains("painted-percentage") => &[("painted", "%")],
        _ if stream.contains("wrist-force") => {
            &[("Fx", "N"), ("Fy", "N"), ("Fz", "N"), ("Tx", "N m"), ("Ty", "N m"), ("Tz", "N m")]
        }
        _ if stream.contains("hand-pose") => {
            &[("x", "m"), ("y", "m"), ("z", "m"), ("axis_x", ""), ("axis_y", ""), ("axis_z", ""), ("angle", "deg")]
        }
        _ => return None,
    };
    (table.len() == columns).then(|| table.iter().map(|&(name, unit)| Feature::new(name, unit)).collect())
}
