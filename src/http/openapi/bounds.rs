//! Bounds of requests in the document, from the constants against which the use cases check.

use super::schemas::Schemas;
use crate::app::model::limits;
use crate::framework::method::{Parameter, Values, catalogue};
use crate::framework::range::Range;
use crate::framework::trajectory::PlanSpec;
use serde_json::{Map, Value, json};
use std::ops::RangeInclusive;

/// Keywords for a property of a component.
type Row = (&'static str, &'static str, Value);

/// The components' bounded properties.
fn properties() -> Vec<Row> {
    let name = lengths(&limits::NAME_CHARS);
    let seed = numbers(&limits::FIRST_SEED);
    let demonstrations = json!({"minItems": limits::DEMONSTRATIONS.start(), "maxItems": limits::DEMONSTRATIONS.end(),
        "uniqueItems": true});
    vec![
        ("CreateRobot", "name", name.clone()),
        ("CreateWorld", "name", name.clone()),
        ("PatchDemonstration", "name", name.clone()),
        ("PatchDemonstration", "excluded", json!({"maxLength": limits::NAME_CHARS.end()})),
        ("GeneralizationRequest", "name", name.clone()),
        ("GeneralizationRequest", "demonstrations", demonstrations),
        ("GeneralizationRequest", "t_min_s", json!({"exclusiveMinimum": 0})),
        ("ExecutionRequest", "name", name.clone()),
        ("ExecutionRequest", "repetitions", numbers(&limits::REPETITIONS)),
        ("ExecutionRequest", "seed", seed.clone()),
        ("ExecutionRequest", "max_evaluations_per_s", json!({"minimum": limits::MIN_EVALUATIONS_PER_S})),
        ("PlanSpec", "speed", range_keywords(&PlanSpec::SHARE)),
        ("PlanSpec", "acceleration", range_keywords(&PlanSpec::SHARE)),
        ("PlanSpec", "dwell_s", range_keywords(&PlanSpec::DWELL_S)),
        ("PlanSpec", "sample_s", range_keywords(&PlanSpec::SAMPLE_S)),
        ("ExperimentRequest", "name", name),
        ("ExperimentRequest", "repetitions", numbers(&(1..=limits::MAX_EXPERIMENT_RUNS))),
    ]
}

/// The bounded parameters by operation; an empty operation stands for every operation with that parameter.
fn parameters() -> Vec<Row> {
    vec![
        ("", "page_size", with_default(numbers(&limits::PAGE_SIZE), limits::DEFAULT_PAGE_SIZE)),
        ("", "Idempotency-Key", lengths(&limits::IDEMPOTENCY_KEY_CHARS)),
        ("uploadDemonstration", "name", lengths(&limits::NAME_CHARS)),
        (
            "getDemonstrationSamples",
            "max_points",
            with_default(numbers(&limits::SAMPLE_POINTS), limits::DEFAULT_POINTS),
        ),
        ("getRunConvergence", "max_points", with_default(numbers(&limits::CONVERGENCE_POINTS), limits::DEFAULT_POINTS)),
        ("interpolateAction", "n", numbers(&limits::INTERPOLATION_POINTS)),
        ("validateJob", "robot_trial_s", json!({"exclusiveMinimum": 0, "maximum": limits::MAX_TRIAL_S})),
    ]
}

/// Adds the ranges of a method's parameters to their component, and those of a group's to the group's.
fn add_ranges(schemas: &mut Schemas, component: &str, parameters: &[Parameter]) {
    for Parameter { name, values, .. } in parameters {
        let Some(schema) = schemas.get_mut(component) else { continue };
        let schema = &mut schema["properties"][name];
        match values {
            Values::Integer { range } | Values::Number { range } => extend(schema, &range_keywords(range)),
            Values::Group { parameters } => {
                let group = schema["$ref"].as_str().and_then(|reference| reference.rsplit('/').next());
                if let Some(group) = group.map(str::to_owned) {
                    add_ranges(schemas, &group, parameters);
                }
            }
            Values::Flag | Values::Choice { .. } => {}
        }
    }
}

fn range_keywords(range: &Range) -> Value {
    let limits =
        [("minimum", range.minimum), ("exclusiveMinimum", range.exclusive_minimum), ("maximum", range.maximum)];
    limits.into_iter().filter_map(|(keyword, limit)| Some((keyword.to_owned(), json!(limit?)))).collect()
}

/// Adds the bounds to the components; must run before unions copy their properties.
pub fn add_to_schemas(schemas: &mut Schemas) {
    for method in catalogue() {
        add_ranges(schemas, method.schema, &method.parameters);
    }
    for (component, property, keywords) in properties() {
        if let Some(schema) = schemas.get_mut(component) {
            extend(&mut schema["properties"][property], &keywords);
        }
    }
}

/// Adds the bounds to the parameters.
pub fn add_to_parameters(document: &mut Value) {
    let rows = parameters();
    let items = document["paths"].as_object_mut().into_iter().flat_map(Map::values_mut);
    for operation in items.filter_map(Value::as_object_mut).flat_map(Map::values_mut) {
        let id = operation["operationId"].clone();
        for parameter in operation["parameters"].as_array_mut().into_iter().flatten() {
            let fits = |row: &&Row| (row.0.is_empty() || id == row.0) && parameter["name"] == row.1;
            if let Some((_, _, keywords)) = rows.iter().find(fits) {
                extend(&mut parameter["schema"], keywords);
            }
        }
    }
}

fn extend(schema: &mut Value, keywords: &Value) {
    if let (Some(schema), Some(keywords)) = (schema.as_object_mut(), keywords.as_object()) {
        schema.extend(keywords.clone());
    }
}

fn numbers<T: serde::Serialize>(bounds: &RangeInclusive<T>) -> Value {
    json!({"minimum": bounds.start(), "maximum": bounds.end()})
}

fn lengths(bounds: &RangeInclusive<u32>) -> Value {
    json!({"minLength": bounds.start(), "maxLength": bounds.end()})
}

fn with_default(mut keywords: Value, default: u32) -> Value {
    keywords["default"] = Value::from(default);
    keywords
}

#[cfg(test)]
mod tests {
    use super::*;

    fn has(schema: &Value, keywords: &Value) -> bool {
        keywords.as_object().unwrap().iter().all(|(keyword, value)| &schema[keyword] == value)
    }

    #[test]
    fn every_bound_has_its_place_in_the_document() {
        let document = super::super::super::document();
        let schemas = &document["components"]["schemas"];
        for (component, property, keywords) in properties() {
            let component = if component == "ExecutionRequest" { "CreateJobExecution" } else { component };
            assert!(has(&schemas[component]["properties"][property], &keywords), "{component}.{property}");
        }
        let items = document["paths"].as_object().unwrap().values();
        let operations: Vec<&Value> = items.flat_map(|item| item.as_object().unwrap().values()).collect();
        for (id, name, keywords) in parameters() {
            let own = operations.iter().filter(|operation| id.is_empty() || operation["operationId"] == id);
            let parameters = own.flat_map(|operation| operation["parameters"].as_array().into_iter().flatten());
            let bounded: Vec<bool> = parameters
                .filter(|parameter| parameter["name"] == name)
                .map(|parameter| has(&parameter["schema"], &keywords))
                .collect();
            assert!(!bounded.is_empty() && bounded.iter().all(|bounded| *bounded), "{id} {name}");
        }
    }
}
