//! The catalogue of methods, out.

use super::enumeration::Enumeration as _;
use super::{all, json};
use crate::app::model::{MethodView, ParameterView};
use crate::framework::method::Needs;
use crate::grpc::proto;

impl From<MethodView> for proto::Method {
    fn from(view: MethodView) -> Self {
        let MethodView { name, label, purpose, scope, few_evaluations, learns_from_earlier_runs, needs, parameters } =
            view;
        Self {
            name,
            label,
            purpose,
            scope: scope.number(),
            few_evaluations,
            learns_from_earlier_runs,
            needs: Some(needs.into()),
            parameters: all(parameters),
        }
    }
}

impl From<Needs> for proto::MethodNeeds {
    fn from(needs: Needs) -> Self {
        let Needs { effects, reset, simulator } = needs;
        Self { effects: effects.number(), reset, simulator: simulator.number() }
    }
}

impl From<ParameterView> for proto::MethodParameter {
    fn from(view: ParameterView) -> Self {
        let ParameterView {
            name,
            purpose,
            unit,
            optional,
            default,
            kind,
            minimum,
            exclusive_minimum,
            maximum,
            options,
        } = view;
        Self {
            name,
            purpose,
            unit,
            optional,
            default: Some(json::message(default)),
            r#type: kind.number(),
            minimum,
            exclusive_minimum,
            maximum,
            options,
        }
    }
}
