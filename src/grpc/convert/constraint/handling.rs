//! The handling of candidates that violate a constraint.

use crate::app::model::AppError;
use crate::framework::constraint::{HandlingSpec, PenaltyKind, PenaltySpec};
use crate::grpc::convert::enumeration::{Enumeration as _, or_default};
use crate::grpc::convert::{finite, required};
use crate::grpc::proto;
use proto::handling_spec::Strategy;
use proto::penalty_kind::Kind as Penalty;

/// The handling of candidates that violate a constraint; `at` is its JSON pointer.
pub fn handling(at: &str, message: proto::HandlingSpec) -> Result<HandlingSpec, AppError> {
    let proto::HandlingSpec { strategy } = message;
    let attempts = |attempts: Option<u32>| attempts.unwrap_or(HandlingSpec::MAX_ATTEMPTS);
    match required(&format!("{at}/strategy"), strategy)? {
        Strategy::Rejecting(proto::RejectingHandling { max_attempts }) => {
            Ok(HandlingSpec::Rejecting { max_attempts: attempts(max_attempts) })
        }
        Strategy::Repairing(proto::RepairingHandling { max_attempts }) => {
            Ok(HandlingSpec::Repairing { max_attempts: attempts(max_attempts) })
        }
        Strategy::Operators(proto::OperatorsHandling { max_attempts }) => {
            Ok(HandlingSpec::Operators { max_attempts: attempts(max_attempts) })
        }
        Strategy::Penalty(proto::PenaltyHandling { form, penalty }) => {
            let kind = penalty.and_then(|proto::PenaltyKind { kind }| kind);
            let place = format!("{at}/penalty");
            Ok(HandlingSpec::Penalty(PenaltySpec {
                form: or_default(&format!("{at}/form"), form)?,
                penalty: self::penalty(&place, required(&place, kind)?)?,
            }))
        }
    }
}

fn penalty(at: &str, kind: Penalty) -> Result<PenaltyKind, AppError> {
    let number = |field: &str, value: f64| finite(&format!("{at}/{field}"), value);
    let or = |field: &str, value: Option<f64>, default: f64| number(field, value.unwrap_or(default));
    match kind {
        Penalty::Death(proto::DeathPenalty { value }) => {
            Ok(PenaltyKind::Death { value: or("value", value, PenaltyKind::DEATH_VALUE)? })
        }
        Penalty::Static(proto::StaticPenalty { weight, exponent }) => Ok(PenaltyKind::Static {
            weight: number("weight", weight)?,
            exponent: or("exponent", exponent, PenaltyKind::EXPONENT)?,
        }),
        Penalty::Dynamic(proto::DynamicPenalty { weight, growth, exponent }) => Ok(PenaltyKind::Dynamic {
            weight: number("weight", weight)?,
            growth: or("growth", growth, PenaltyKind::EXPONENT)?,
            exponent: or("exponent", exponent, PenaltyKind::EXPONENT)?,
        }),
        Penalty::Adaptive(proto::AdaptivePenalty { weight, window, relax, tighten }) => Ok(PenaltyKind::Adaptive {
            weight: number("weight", weight)?,
            window: window.unwrap_or(PenaltyKind::WINDOW),
            relax: or("relax", relax, PenaltyKind::RELAX)?,
            tighten: or("tighten", tighten, PenaltyKind::TIGHTEN)?,
        }),
        Penalty::Annealing(proto::AnnealingPenalty { temperature, cooling, frozen }) => Ok(PenaltyKind::Annealing {
            temperature: number("temperature", temperature)?,
            cooling: or("cooling", cooling, PenaltyKind::COOLING)?,
            frozen: or("frozen", frozen, PenaltyKind::FROZEN)?,
        }),
    }
}

impl From<HandlingSpec> for proto::HandlingSpec {
    fn from(spec: HandlingSpec) -> Self {
        let strategy = match spec {
            HandlingSpec::Rejecting { max_attempts } => {
                Strategy::Rejecting(proto::RejectingHandling { max_attempts: Some(max_attempts) })
            }
            HandlingSpec::Repairing { max_attempts } => {
                Strategy::Repairing(proto::RepairingHandling { max_attempts: Some(max_attempts) })
            }
            HandlingSpec::Operators { max_attempts } => {
                Strategy::Operators(proto::OperatorsHandling { max_attempts: Some(max_attempts) })
            }
            HandlingSpec::Penalty(PenaltySpec { form, penalty }) => {
                Strategy::Penalty(proto::PenaltyHandling { form: form.number(), penalty: Some(penalty.into()) })
            }
        };
        Self { strategy: Some(strategy) }
    }
}

impl From<PenaltyKind> for proto::PenaltyKind {
    fn from(kind: PenaltyKind) -> Self {
        let kind = match kind {
            PenaltyKind::Death { value } => Penalty::Death(proto::DeathPenalty { value: Some(value) }),
            PenaltyKind::Static { weight, exponent } => {
                Penalty::Static(proto::StaticPenalty { weight, exponent: Some(exponent) })
            }
            PenaltyKind::Dynamic { weight, growth, exponent } => {
                Penalty::Dynamic(proto::DynamicPenalty { weight, growth: Some(growth), exponent: Some(exponent) })
            }
            PenaltyKind::Adaptive { weight, window, relax, tighten } => Penalty::Adaptive(proto::AdaptivePenalty {
                weight,
                window: Some(window),
                relax: Some(relax),
                tighten: Some(tighten),
            }),
            PenaltyKind::Annealing { temperature, cooling, frozen } => Penalty::Annealing(proto::AnnealingPenalty {
                temperature,
                cooling: Some(cooling),
                frozen: Some(frozen),
            }),
        };
        Self { kind: Some(kind) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn every_handling_survives_the_wire() {
        for spec in [
            json!({"strategy": "rejecting", "max_attempts": 7}),
            json!({"strategy": "repairing", "max_attempts": 8}),
            json!({"strategy": "operators", "max_attempts": 9}),
            json!({"strategy": "penalty", "penalty": {"kind": "death", "value": 5.0}}),
            json!({"strategy": "penalty", "form": "multiplicative", "penalty": {"kind": "static", "weight": 2.0,
                "exponent": 3.0}}),
            json!({"strategy": "penalty", "penalty": {"kind": "dynamic", "weight": 2.0, "growth": 3.0, "exponent": 4.0}}),
            json!({"strategy": "penalty", "penalty": {"kind": "adaptive", "weight": 2.0, "window": 4, "relax": 1.5,
                "tighten": 2.5}}),
            json!({"strategy": "penalty", "penalty": {"kind": "annealing", "temperature": 2.0, "cooling": 0.5,
                "frozen": 0.1}}),
        ] {
            let before: HandlingSpec = serde_json::from_value(spec).unwrap();
            assert_eq!(handling("", before.clone().into()).unwrap(), before);
        }
    }

    #[test]
    fn absent_fields_have_the_same_defaults_as_in_json() {
        let adaptive = proto::AdaptivePenalty { weight: 1.0, ..Default::default() };
        let annealing = proto::AnnealingPenalty { temperature: 1.0, ..Default::default() };
        for (message, json) in [
            (Penalty::Death(proto::DeathPenalty::default()), json!({"kind": "death"})),
            (
                Penalty::Static(proto::StaticPenalty { weight: 1.0, exponent: None }),
                json!({"kind": "static", "weight": 1.0}),
            ),
            (
                Penalty::Dynamic(proto::DynamicPenalty { weight: 1.0, growth: None, exponent: None }),
                json!({"kind": "dynamic", "weight": 1.0}),
            ),
            (Penalty::Adaptive(adaptive), json!({"kind": "adaptive", "weight": 1.0})),
            (Penalty::Annealing(annealing), json!({"kind": "annealing", "temperature": 1.0})),
        ] {
            assert_eq!(penalty("", message).unwrap(), serde_json::from_value(json).unwrap());
        }
        let message = proto::HandlingSpec { strategy: Some(Strategy::Repairing(proto::RepairingHandling::default())) };
        assert_eq!(handling("", message).unwrap(), serde_json::from_value(json!({"strategy": "repairing"})).unwrap());
    }
}
