//! Conversion of recognition requests and results.

use super::enumeration::{Enumeration as _, or_default};
use super::{all, finite_or_none, references, required};
use crate::app::model::{
    AppError, IncomparableCandidate, Observed, RecognitionCandidate, RecognitionView, RecognizeRequest,
};
use crate::framework::recognition::FeatureDiscrepancy;
use crate::grpc::proto;
use proto::recognize_request::Observed as Message;

/// The question of a request.
///
/// # Errors
/// As [`question`], and `Invalid` without an observation.
pub fn request(request: proto::RecognizeRequest) -> Result<RecognizeRequest, AppError> {
    let proto::RecognizeRequest { question, observed } = request;
    let observed = match required("/observed", observed)? {
        Message::Demonstration(id) => {
            Observed::Demonstration { demonstration: super::reference("/observed/demonstration", &id)? }
        }
        Message::Rows(proto::ObservedRows { features, rows }) => {
            Observed::Rows { features: all(features), rows: super::rows("/observed/rows", rows)? }
        }
    };
    self::question(question.unwrap_or_default(), observed)
}

/// A question about an observation.
///
/// # Errors
/// `Invalid` at the JSON pointer that the field has over HTTP.
pub fn question(question: proto::RecognitionQuestion, observed: Observed) -> Result<RecognizeRequest, AppError> {
    let proto::RecognitionQuestion { candidates, metric, threshold } = question;
    Ok(RecognizeRequest {
        observed,
        candidates: references("/candidates", &candidates)?,
        metric: or_default("/metric", metric)?,
        threshold: finite_or_none("/threshold", threshold)?,
    })
}

impl From<RecognitionView> for proto::Recognition {
    fn from(view: RecognitionView) -> Self {
        let RecognitionView { recognized, metric, threshold, candidates, incomparable } = view;
        Self {
            recognized: recognized.map(Into::into),
            metric: metric.number(),
            threshold: Some(threshold),
            candidates: all(candidates),
            incomparable: all(incomparable),
        }
    }
}

impl From<IncomparableCandidate> for proto::IncomparableCandidate {
    fn from(candidate: IncomparableCandidate) -> Self {
        let IncomparableCandidate { action, name, feature, observed_unit } = candidate;
        Self { action: action.into(), name, feature: Some(feature.into()), observed_unit }
    }
}

impl From<RecognitionCandidate> for proto::RecognitionCandidate {
    fn from(candidate: RecognitionCandidate) -> Self {
        let RecognitionCandidate {
            action,
            name,
            discrepancy,
            relative_discrepancy,
            within_threshold,
            per_feature,
            path,
        } = candidate;
        Self {
            action: action.into(),
            name,
            discrepancy,
            relative_discrepancy,
            within_threshold,
            per_feature: all(per_feature),
            path: all(path),
        }
    }
}

impl From<FeatureDiscrepancy> for proto::FeatureDiscrepancy {
    fn from(part: FeatureDiscrepancy) -> Self {
        let FeatureDiscrepancy { feature, discrepancy, path } = part;
        Self { feature: Some(feature.into()), discrepancy, path: all(path) }
    }
}

impl From<[u32; 2]> for proto::PathStep {
    fn from([sample, goal]: [u32; 2]) -> Self {
        Self { sample, goal }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::model::ActionId;
    use crate::framework::Feature;
    use crate::framework::recognition::Metric;
    use uuid::Uuid;

    #[test]
    fn a_question_is_read_with_its_observation() {
        let id = ActionId::from_uuid(Uuid::from_u128(1));
        let features = vec![proto::Feature { name: "x".to_owned(), unit: "m".to_owned() }];
        let observed = Some(Message::Rows(proto::ObservedRows { features, rows: vec![vec![1.0].into()] }));
        let question = proto::RecognitionQuestion {
            candidates: vec![id.to_string()],
            metric: proto::Metric::Aquila as i32,
            threshold: Some(0.5),
        };
        let read = request(proto::RecognizeRequest { question: Some(question), observed }).unwrap();
        let rows = Observed::Rows { features: vec![Feature::new("x", "m")], rows: vec![vec![1.0]] };
        let expected =
            RecognizeRequest { observed: rows, candidates: vec![id], metric: Metric::Aquila, threshold: Some(0.5) };
        assert_eq!(read, expected);
    }

    #[test]
    fn what_is_missing_or_wrong_is_named() {
        let pointer = |message| request(message).unwrap_err().details[0].pointer.clone();
        assert_eq!(pointer(proto::RecognizeRequest::default()), "/observed");
        let observed = Some(Message::Demonstration("nobody".to_owned()));
        assert_eq!(pointer(proto::RecognizeRequest { question: None, observed }), "/observed/demonstration");
    }

    #[test]
    fn an_answer_keeps_each_warping_path() {
        let action = ActionId::from_uuid(Uuid::from_u128(1));
        let part = FeatureDiscrepancy { feature: Feature::new("x", "m"), discrepancy: 0.5, path: vec![[0, 0], [1, 0]] };
        let candidate = RecognitionCandidate {
            action: action.clone(),
            name: "wax".to_owned(),
            discrepancy: 1.5,
            relative_discrepancy: 0.25,
            within_threshold: true,
            per_feature: vec![part],
            path: vec![[0, 0], [1, 2]],
        };
        let view = RecognitionView {
            recognized: Some(action.clone()),
            metric: Metric::SumOfFeatures,
            threshold: 0.3,
            candidates: vec![candidate],
            incomparable: vec![IncomparableCandidate {
                action,
                name: "paint".to_owned(),
                feature: Feature::new("painted", "%"),
                observed_unit: None,
            }],
        };
        let message = proto::Recognition::from(view);
        let candidate = &message.candidates[0];
        assert_eq!((candidate.path[1].sample, candidate.path[1].goal), (1, 2));
        assert_eq!(candidate.per_feature[0].path[1].sample, 1);
        assert!(candidate.within_threshold && message.incomparable[0].observed_unit.is_none());
        assert_eq!((message.metric(), message.threshold), (proto::Metric::SumOfFeatures, Some(0.3)));
    }
}
