//! Overrides: a cell's changes to its preset, as a JSON merge patch (RFC 7396) over the problem.
//!
//! One rule is added for tagged choices (`name`, `kind`, `strategy`, `shape`, `at`): a patch that selects another
//! variant replaces the whole choice, so that parameters of one method never leak into another.

use serde_json::{Map, Value};

/// Keys that select the variant of an object.
const TAGS: [&str; 5] = ["name", "kind", "strategy", "shape", "at"];

/// Applies `patch` to `target`: objects merge key by key, null removes a key, anything else replaces.
pub fn merge(target: &mut Value, patch: &Value) {
    let Value::Object(changes) = patch else {
        *target = patch.clone();
        return;
    };
    if target.as_object().is_none_or(|found| picks_another(found, changes)) {
        *target = Value::Object(Map::new());
    }
    let Value::Object(found) = target else { return };
    for (key, change) in changes {
        if change.is_null() {
            found.remove(key);
        } else {
            merge(found.entry(key.clone()).or_insert(Value::Null), change);
        }
    }
}

fn picks_another(found: &Map<String, Value>, changes: &Map<String, Value>) -> bool {
    TAGS.iter().any(|tag| match (found.get(*tag), changes.get(*tag)) {
        (Some(old), Some(new)) => old != new,
        _ => false,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;
    use serde_json::json;

    #[rstest]
    #[case(json!({"a": 1, "b": 2}), json!({"b": 3}), json!({"a": 1, "b": 3}))]
    #[case(json!({"a": {"x": 1, "y": 2}}), json!({"a": {"y": null, "z": 4}}), json!({"a": {"x": 1, "z": 4}}))]
    #[case(json!({"a": [1, 2]}), json!({"a": [3]}), json!({"a": [3]}))]
    #[case(json!({"m": {"name": "sst", "p": 3}}), json!({"m": {"name": "pso"}}), json!({"m": {"name": "pso"}}))]
    #[case(json!({"m": {"name": "sst", "p": 3}}), json!({"m": {"name": "sst", "q": 1}}), json!({"m": {"name": "sst", "p": 3, "q": 1}}))]
    #[case(json!({"a": null}), json!({"a": {"b": {"c": 1, "d": null}}}), json!({"a": {"b": {"c": 1}}}))]
    fn merges(#[case] mut target: Value, #[case] patch: Value, #[case] expected: Value) {
        merge(&mut target, &patch);
        assert_eq!(target, expected);
    }
}
