//! A demonstration without its samples, and the findings of the reader.

use super::{document, unchanged, versions};
use crate::app::model::{DemonstrationId, DemonstrationReport, DemonstrationView, StreamView, Timestamp};
use crate::framework::Feature;
use crate::framework::demonstration::{Finding, FindingCode, Severity};

document! {
    /// A demonstration without its samples.
    Demonstration keeps DemonstrationView {
        id: DemonstrationId,
        name: String,
        revision: u64,
        excluded: Option<String>,
        duration_s: f64,
        sha256: String,
        findings: u32,
        created_at: Timestamp,
    }
    each { streams: Stream, }
}
versions! { Demonstration keeps DemonstrationView, "demonstration", [unchanged] }

document! {
    /// One stream without its samples.
    Stream keeps StreamView {
        name: String,
        features: Vec<Feature>,
        samples: u64,
        start_s: f64,
        duration_s: f64,
    }
}

document! {
    /// The reader's findings.
    Report keeps DemonstrationReport {
        demonstration: DemonstrationId,
    }
    each { findings: Found, }
}
versions! { Report keeps DemonstrationReport, "report", [unchanged] }

document! {
    /// One finding.
    Found keeps Finding {
        severity: Severity,
        code: FindingCode,
        stream: Option<String>,
        row: Option<u64>,
        column: Option<String>,
        time_s: Option<f64>,
        message: String,
        remedy: String,
    }
}
