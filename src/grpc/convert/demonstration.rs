//! Demonstrations.

use super::{all, text};
use crate::app::demonstrations::{DemonstrationReport, DemonstrationView, StreamView, UploadOptions};
use crate::grpc::proto;

/// Display name and options of an upload.
pub fn header(header: proto::UploadHeader) -> (Option<String>, UploadOptions) {
    let options = UploadOptions {
        format: text(header.format),
        clock_policy: text(header.clock_policy),
        time_column: text(header.time_column),
        features: super::list(header.features),
        units: header.units,
    };
    (text(header.name), options)
}

impl From<DemonstrationView> for proto::Demonstration {
    fn from(view: DemonstrationView) -> Self {
        Self {
            id: view.id.into(),
            name: view.name,
            revision: view.revision,
            excluded: view.excluded,
            streams: all(view.streams),
            duration_s: view.duration_s,
            sha256: view.sha256,
            findings: view.findings,
            created_at_ms: view.created_at.0,
        }
    }
}

impl From<StreamView> for proto::DemonstrationStream {
    fn from(view: StreamView) -> Self {
        Self {
            name: view.name,
            features: all(view.features),
            samples: view.samples,
            start_s: view.start_s,
            duration_s: view.duration_s,
        }
    }
}

impl From<DemonstrationReport> for proto::DemonstrationReport {
    fn from(report: DemonstrationReport) -> Self {
        Self { demonstration: report.demonstration.into(), findings: all(report.findings) }
    }
}
