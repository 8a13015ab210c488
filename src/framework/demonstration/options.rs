//! How a file is to be read: everything is optional and found from the content where absent.

use crate::Feature;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use utoipa::ToSchema;

/// The form of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema, clap::ValueEnum)]
#[serde(rename_all = "snake_case")]
#[clap(rename_all = "snake_case")]
pub enum Format {
    /// Comma, semicolon or tab separated with a header line.
    Csv,
    /// Space separated without header: id, time (s), values. YARP logs at full rate and the reduced files.
    Yarp,
    /// Canonical JSON: `{name, streams: [{name, features: [{name, unit}], time_s: [..], values: [[..], ..]}]}`.
    Json,
}

/// What happens to the clocks of the streams of one demonstration.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize, ToSchema, clap::ValueEnum)]
#[serde(rename_all = "snake_case")]
#[clap(rename_all = "snake_case")]
pub enum ClockPolicy {
    /// Times stay as they were recorded.
    #[default]
    AsRecorded,
    /// Every stream starts at 0 s: for recorders whose clocks disagree.
    AlignByStart,
}

/// How to read a file or bundle.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ReadOptions {
    /// Name of the demonstration; JSON's own name wins where this is absent, then the stream's.
    pub name: Option<String>,
    /// Stream name of a single file without one of its own; `stream` when absent.
    pub stream: Option<String>,
    /// The form of the file; found from its content when absent.
    pub format: Option<Format>,
    /// Header of the time column; `time`, `time_s`, `t` or `timestamp` when absent.
    pub time_column: Option<String>,
    /// Units by feature name; they win over those of the header.
    pub units: BTreeMap<String, String>,
    /// Features of files without header, in column order after id and time; by known stream names, else `value_1`, ..
    /// when absent.
    pub features: Vec<Feature>,
    /// As `features`, for the streams of a bundle by stream name.
    pub stream_features: BTreeMap<String, Vec<Feature>>,
    /// What to do about clocks that disagree.
    pub clock_policy: ClockPolicy,
    /// What is refused.
    pub limits: Limits,
}

/// What is refused as too large, too long or absurd.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Limits {
    /// Bytes of all files of a demonstration together.
    pub bytes: u64,
    /// Bytes of one line.
    pub line_bytes: usize,
    /// Samples of all streams of a demonstration together.
    pub samples: u64,
    /// Features of all streams of a demonstration together.
    pub features: usize,
    /// Streams of a demonstration.
    pub streams: usize,
    /// Shortest time from first to last sample, seconds.
    pub min_duration_s: f64,
    /// Longest time from first to last sample, seconds.
    pub max_duration_s: f64,
    /// Largest magnitude of a value, in its unit.
    pub max_magnitude: f64,
    /// Findings after which reading stops.
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

/// Features of the authors' streams by stream name, for files without header.
///
/// A name that contains `painted-percentage`: painted (%); `wrist-force`: forces (N) and torques (N m) of the wrist sensor; `hand-pose`:
/// position (m), unit axis and angle (deg). `None` for other names or another number of columns.
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
