//! The methods a job can use, as the catalogue of the framework describes them.

use crate::framework::method::{MethodEntry, Needs, Parameter, Profile, Scope, Values};
use serde::Serialize;
use serde_json::Value;
use utoipa::ToSchema;

/// All methods.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct MethodList {
    /// Methods in the order of a menu.
    pub items: Vec<MethodView>,
}

/// A method.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct MethodView {
    /// Name, as written in requests.
    pub name: String,
    /// Display name.
    pub label: String,
    /// One sentence: purpose and use.
    pub purpose: String,
    /// Scope of a plan: one goal, or the whole run.
    pub scope: Scope,
    /// Whether it suits a real robot, where every evaluation takes time.
    pub few_evaluations: bool,
    /// Whether it begins with what earlier runs on the same robot taught.
    pub learns_from_earlier_runs: bool,
    /// Properties it needs of a problem.
    pub needs: Needs,
    /// Parameters in the order of a form.
    pub parameters: Vec<ParameterView>,
}

/// A parameter of a method.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct ParameterView {
    /// Name, as written in requests; `swarm.inertia` is the member `inertia` of the object `swarm`.
    pub name: String,
    /// One sentence for the person who sets it.
    pub purpose: String,
    /// Unit; `null` for a plain number, a choice or a flag.
    #[schema(required = true)]
    pub unit: Option<String>,
    /// Whether it may be `null`.
    pub optional: bool,
    /// Value unless the request names another.
    pub default: Value,
    /// Type of its values.
    #[serde(rename = "type")]
    pub kind: ParameterType,
    /// Smallest number allowed.
    #[schema(required = true)]
    pub minimum: Option<f64>,
    /// Number that every value must exceed.
    #[schema(required = true)]
    pub exclusive_minimum: Option<f64>,
    /// Largest number allowed.
    #[schema(required = true)]
    pub maximum: Option<f64>,
    /// Names to choose from, in the order of a menu; empty for other types.
    pub options: Vec<String>,
}

/// The type of a parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum ParameterType {
    /// A whole number.
    Integer,
    /// A finite number.
    Number,
    /// `true` or `false`.
    Flag,
    /// One of the options.
    Choice,
}

impl From<MethodEntry> for MethodView {
    fn from(entry: MethodEntry) -> Self {
        let MethodEntry { name, label, purpose, profile, parameters, schema: _ } = entry;
        let Profile { scope, few_evaluations, learns_from_earlier_runs, needs } = profile;
        Self {
            name: name.to_owned(),
            label: label.to_owned(),
            purpose,
            scope,
            few_evaluations,
            learns_from_earlier_runs,
            needs,
            parameters: parameters.into_iter().flat_map(|parameter| flat("", parameter)).collect(),
        }
    }
}

/// The parameter, or those inside of a group, below `path`.
fn flat(path: &str, parameter: Parameter) -> Vec<ParameterView> {
    let Parameter { name, purpose, unit, optional, default, values } = parameter;
    let plain = |kind| ParameterView {
        name: format!("{path}{name}"),
        purpose,
        unit: unit.map(str::to_owned),
        optional,
        default,
        kind,
        minimum: None,
        exclusive_minimum: None,
        maximum: None,
        options: Vec::new(),
    };
    let (kind, range) = match values {
        Values::Group { parameters } => {
            let path = format!("{path}{name}.");
            return parameters.into_iter().flat_map(|inside| flat(&path, inside)).collect();
        }
        Values::Choice { options } => {
            let options = options.iter().filter_map(Value::as_str).map(str::to_owned).collect();
            return vec![ParameterView { options, ..plain(ParameterType::Choice) }];
        }
        Values::Flag => return vec![plain(ParameterType::Flag)],
        Values::Integer { range } => (ParameterType::Integer, range),
        Values::Number { range } => (ParameterType::Number, range),
    };
    let (minimum, exclusive_minimum, maximum) = (range.minimum, range.exclusive_minimum, range.maximum);
    vec![ParameterView { minimum, exclusive_minimum, maximum, ..plain(kind) }]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::framework::method::catalogue;

    #[test]
    fn parameters_inside_groups_are_told_by_their_path() {
        let methods: Vec<MethodView> = catalogue().into_iter().map(MethodView::from).collect();
        let pso = methods.iter().find(|method| method.name == "pso").unwrap();
        let population = pso.parameters.iter().find(|parameter| parameter.name == "swarm.population").unwrap();
        assert_eq!((population.kind, population.minimum), (ParameterType::Integer, Some(2.0)));
        let model = methods.iter().find(|method| method.name == "model").unwrap();
        let prior = model.parameters.iter().find(|parameter| parameter.name == "prior").unwrap();
        assert_eq!((prior.kind, prior.options.contains(&"simulator".to_owned())), (ParameterType::Choice, true));
    }
}
