//! Recognition.

use super::{all, finite_or_none, metric, reference, references, required, rows};
use crate::app::model::{
    AppError, IncomparableCandidate, Observed, RecognitionCandidate, RecognitionView, RecognizeRequest,
};
use crate::framework::recognition::FeatureDiscrepancy;
use crate::grpc::proto;
use proto::recognize_request::Observed as Message;

/// The question of a request.
pub fn request(request: proto::RecognizeRequest) -> Result<RecognizeRequest, AppError> {
    let observed = match required("/observed", request.observed)? {
        Message::Demonstration(id) => {
            Observed::Demonstration { demonstration: reference("/observed/demonstration", &id)? }
        }
        Message::Rows(message) => {
            Observed::Rows { features: all(message.features), rows: rows("/observed/rows", message.rows)? }
        }
    };
    question(&request.question.unwrap_or_default(), observed)
}

/// A question about what was observed.
pub fn question(question: &proto::RecognitionQuestion, observed: Observed) -> Result<RecognizeRequest, AppError> {
    Ok(RecognizeRequest {
        observed,
        candidates: references("/candidates", &question.candidates)?,
        metric: metric("/metric", question.metric)?,
        threshold: finite_or_none("/threshold", question.threshold)?,
    })
}

impl From<RecognitionView> for proto::Recognition {
    fn from(view: RecognitionView) -> Self {
        Self {
            recognized: view.recognized.map(Into::into),
            metric: proto::Metric::from(view.metric) as i32,
            threshold: Some(view.threshold),
            candidates: all(view.candidates),
            incomparable: all(view.incomparable),
        }
    }
}

impl From<IncomparableCandidate> for proto::IncomparableCandidate {
    fn from(candidate: IncomparableCandidate) -> Self {
        Self {
            action: candidate.action.into(),
            name: candidate.name,
            feature: Some(candidate.feature.into()),
            observed_unit: candidate.observed_unit,
        }
    }
}

impl From<RecognitionCandidate> for proto::RecognitionCandidate {
    fn from(candidate: RecognitionCandidate) -> Self {
        Self {
            action: candidate.action.into(),
            name: candidate.name,
            discrepancy: candidate.discrepancy,
            relative_discrepancy: candidate.relative_discrepancy,
            within_threshold: candidate.within_threshold,
            per_feature: all(candidate.per_feature),
            path: candidate.path.into_iter().map(|[sample, goal]| proto::PathStep { sample, goal }).collect(),
        }
    }
}

impl From<FeatureDiscrepancy> for proto::FeatureDiscrepancy {
    fn from(part: FeatureDiscrepancy) -> Self {
        Self { feature: Some(part.feature.into()), discrepancy: part.discrepancy }
    }
}
