//! Conversion of demonstrations.

use super::enumeration::{Enumeration as _, or_default};
use super::{all, finite_or_none, text, time};
use crate::app::model::{
    AppError, DemonstrationReport, DemonstrationView, PatchDemonstration, SamplesQuery, SamplesView, Series,
    StreamView, UploadOptions,
};
use crate::framework::Feature;
use crate::framework::demonstration::{Finding, Format};
use crate::grpc::proto;
use std::collections::BTreeMap;

/// Display name and options of an upload.
///
/// # Errors
/// `Invalid` for a number that is not a format or a clock policy.
pub fn header(header: proto::UploadHeader) -> Result<(Option<String>, UploadOptions), AppError> {
    let proto::UploadHeader { name, format, clock_policy, time_column, features, units } = header;
    let options = UploadOptions {
        format: Format::read("/format", format)?,
        clock_policy: or_default("/clock_policy", clock_policy)?,
        time_column: text(time_column),
        features: features.into_iter().map(|name| Feature::new(name, "")).collect(),
        // Each stream of an upload over gRPC has the same features, as over HTTP.
        stream_features: BTreeMap::new(),
        units,
    };
    Ok((text(name), options))
}

/// Id of the demonstration and the samples asked for.
///
/// # Errors
/// `Invalid` for a time that is not finite.
pub fn samples(request: proto::GetDemonstrationSamplesRequest) -> Result<(String, SamplesQuery), AppError> {
    let proto::GetDemonstrationSamplesRequest { id, features, from_s, to_s, max_points } = request;
    let (from_s, to_s) = (finite_or_none("/from", from_s)?, finite_or_none("/to", to_s)?);
    Ok((id, SamplesQuery { features, from_s, to_s, max_points }))
}

/// Id of the demonstration, its change and the revision to change.
pub fn patch(request: proto::PatchDemonstrationRequest) -> (String, PatchDemonstration, Option<u64>) {
    let proto::PatchDemonstrationRequest { id, name, excluded, revision } = request;
    (id, PatchDemonstration { name, excluded }, revision)
}

impl From<Finding> for proto::Finding {
    fn from(finding: Finding) -> Self {
        let Finding { severity, code, stream, row, column, time_s, message, remedy } = finding;
        Self { severity: severity.number(), code: code.to_string(), stream, row, column, time_s, message, remedy }
    }
}

impl From<DemonstrationView> for proto::Demonstration {
    fn from(view: DemonstrationView) -> Self {
        let DemonstrationView { id, name, revision, excluded, streams, duration_s, sha256, findings, created_at } =
            view;
        Self {
            id: id.into(),
            name,
            revision,
            excluded,
            streams: all(streams),
            duration_s,
            sha256,
            findings,
            created_at: Some(time(created_at)),
        }
    }
}

impl From<StreamView> for proto::DemonstrationStream {
    fn from(view: StreamView) -> Self {
        let StreamView { name, features, samples, start_s, duration_s } = view;
        Self { name, features: all(features), samples, start_s, duration_s }
    }
}

impl From<DemonstrationReport> for proto::DemonstrationReport {
    fn from(report: DemonstrationReport) -> Self {
        let DemonstrationReport { demonstration, findings } = report;
        Self { demonstration: demonstration.into(), findings: all(findings) }
    }
}

impl From<SamplesView> for proto::DemonstrationSamples {
    fn from(view: SamplesView) -> Self {
        let SamplesView { demonstration, series } = view;
        Self { demonstration: demonstration.into(), series: all(series) }
    }
}

impl From<Series> for proto::Series {
    fn from(series: Series) -> Self {
        let Series { stream, feature, t_s, values, decimated } = series;
        Self { stream, feature: Some(feature.into()), t_s, values, decimated }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::framework::demonstration::{ClockPolicy, FindingCode};

    #[test]
    fn a_header_is_read_and_unknown_numbers_are_refused() {
        let read = proto::UploadHeader {
            name: "wax".to_owned(),
            format: proto::UploadFormat::Yarp as i32,
            clock_policy: proto::ClockPolicy::AlignByStart as i32,
            time_column: "t".to_owned(),
            features: vec!["x".to_owned()],
            units: [("x".to_owned(), "m".to_owned())].into(),
        };
        let (name, options) = header(read.clone()).unwrap();
        assert_eq!((name.as_deref(), options.time_column.as_deref()), (Some("wax"), Some("t")));
        assert_eq!((options.format, options.clock_policy), (Some(Format::Yarp), ClockPolicy::AlignByStart));
        assert_eq!((options.features[0].name.as_str(), options.units["x"].as_str()), ("x", "m"));
        assert_eq!(header(proto::UploadHeader::default()).unwrap(), (None, UploadOptions::default()));
        let wrong = proto::UploadHeader { clock_policy: 9, ..read };
        assert_eq!(header(wrong).unwrap_err().details[0].pointer, "/clock_policy");
    }

    #[test]
    fn a_finding_keeps_its_severity_and_its_place() {
        let finding = Finding {
            severity: crate::framework::demonstration::Severity::Warning,
            code: FindingCode::ClockOffset,
            stream: Some("hand".to_owned()),
            row: Some(3),
            column: None,
            time_s: Some(0.5),
            message: "late".to_owned(),
            remedy: "align".to_owned(),
        };
        let message = proto::Finding::from(finding);
        assert_eq!((message.severity(), message.code.as_str()), (proto::Severity::Warning, "clock_offset"));
        assert_eq!((message.stream.as_deref(), message.row, message.time_s), (Some("hand"), Some(3), Some(0.5)));
        assert_eq!((message.message.as_str(), message.remedy.as_str()), ("late", "align"));
    }

    #[test]
    fn a_change_names_only_its_fields_and_samples_need_finite_times() {
        let request = proto::PatchDemonstrationRequest {
            id: "dem".to_owned(),
            name: None,
            excluded: Some(String::new()),
            revision: Some(4),
        };
        let change = PatchDemonstration { name: None, excluded: Some(String::new()) };
        assert_eq!(patch(request), ("dem".to_owned(), change, Some(4)));
        let wrong = proto::GetDemonstrationSamplesRequest { to_s: Some(f64::NAN), ..Default::default() };
        assert_eq!(samples(wrong).unwrap_err().details[0].pointer, "/to");
    }
}
