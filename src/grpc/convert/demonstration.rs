//! Demonstrations.

use super::{all, text};
use crate::app::demonstrations::pointer;
use crate::app::model::{AppError, DemonstrationReport, DemonstrationView, StreamView, UploadOptions};
use crate::framework::Feature;
use crate::framework::demonstration::Finding;
use crate::grpc::proto;
use serde::de::DeserializeOwned;

/// Display name and options of an upload.
///
/// # Errors
/// `Invalid` for a format or clock policy that there is not.
pub fn header(header: proto::UploadHeader) -> Result<(Option<String>, UploadOptions), AppError> {
    let options = UploadOptions {
        format: choice("/format", header.format)?,
        clock_policy: choice("/clock_policy", header.clock_policy)?.unwrap_or_default(),
        time_column: text(header.time_column),
        features: header.features.into_iter().map(|name| Feature::new(name, "")).collect(),
        units: header.units,
        ..UploadOptions::default()
    };
    Ok((text(header.name), options))
}

/// One of the names that the type has in JSON; none when empty.
fn choice<T: DeserializeOwned>(pointer: &str, name: String) -> Result<Option<T>, AppError> {
    let value = text(name).map(|name| serde_json::from_value(serde_json::Value::from(name))).transpose();
    value.map_err(|error| AppError::field(pointer, "invalid_value", error.to_string()))
}

impl From<Finding> for proto::Finding {
    fn from(finding: Finding) -> Self {
        Self {
            pointer: pointer(&finding),
            code: finding.code.to_string(),
            detail: format!("{}; {}", finding.message, finding.remedy),
        }
    }
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
