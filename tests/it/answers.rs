//! Fields of answers are always present, `null` if there is no value: only schemas that a request may hold as well have
//! optional ones.

use serde_json::Value;
use std::collections::BTreeSet;

/// Names of the schemas that `part` leads to.
fn reachable(document: &Value, part: &Value, found: &mut BTreeSet<String>) {
    match part {
        Value::Object(members) => {
            let target = members.get("$ref").and_then(Value::as_str);
            if let Some(name) = target.and_then(|target| target.strip_prefix("#/components/schemas/"))
                && found.insert(name.to_owned())
            {
                reachable(document, &document["components"]["schemas"][name], found);
            }
            members.values().for_each(|member| reachable(document, member, found));
        }
        Value::Array(items) => items.iter().for_each(|item| reachable(document, item, found)),
        _ => {}
    }
}

#[test]
fn fields_of_answers_are_never_optional() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/web/openapi.json");
    let document: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let (mut requested, mut answered) = (BTreeSet::new(), BTreeSet::new());
    let operations =
        document["paths"].as_object().unwrap().values().flat_map(|path| path.as_object().unwrap().values());
    for operation in operations {
        reachable(&document, &operation["requestBody"], &mut requested);
        reachable(&document, &operation["parameters"], &mut requested);
        // Problems have members of their own, see RFC 9457.
        let answers = operation["responses"].as_object().unwrap();
        for (_, answer) in answers.iter().filter(|(status, _)| status.starts_with('2')) {
            reachable(&document, answer, &mut answered);
        }
    }
    assert!(answered.contains("RunView") && requested.contains("RobotSpec"), "{answered:?}");
    let mut optional = Vec::new();
    for name in answered.difference(&requested) {
        let schema = &document["components"]["schemas"][name];
        let required: BTreeSet<&str> =
            schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
        let fields = schema["properties"].as_object().into_iter().flat_map(|fields| fields.keys());
        optional
            .extend(fields.filter(|field| !required.contains(field.as_str())).map(|field| format!("{name}.{field}")));
    }
    assert!(optional.is_empty(), "mark these `#[schema(required = true)]` and write them always: {optional:?}");
}
