//! The components of the document: gives them their names and removes unused ones.

use serde_json::{Map, Value, json};
use std::collections::BTreeSet;

/// Schemas by component name.
pub type Schemas = Map<String, Value>;

const PREFIX: &str = "#/components/schemas/";

/// Reference to a component, as text.
pub fn target(name: &str) -> String {
    format!("{PREFIX}{name}")
}

/// Schema that refers to the component of that name.
pub fn reference(name: &str) -> Value {
    json!({"$ref": target(name)})
}

/// `tool_position` as `ToolPosition`.
pub fn pascal_case(name: &str) -> String {
    let capitalized = |word: &str| word[..1].to_ascii_uppercase() + &word[1..];
    name.split('_').filter(|word| !word.is_empty()).map(capitalized).collect()
}

/// Names pages as clients expect, `JobPage` for the generic `Page_JobView`, and lets them refer to their items, which
/// utoipa repeats in every page.
pub fn rename_pages(document: &mut Value) {
    let renamed = |name: &str| {
        let item = name.strip_prefix("Page_")?;
        Some(format!("{}Page", item.strip_suffix("View").unwrap_or(item)))
    };
    if let Some(schemas) = document["components"]["schemas"].as_object_mut() {
        for (name, mut schema) in std::mem::take(schemas) {
            if let Some(item) = name.strip_prefix("Page_") {
                schema["properties"]["items"]["items"] = reference(item);
            }
            schemas.insert(renamed(&name).unwrap_or(name), schema);
        }
    }
    for_each_reference(document, &mut |reference| {
        if let Some(name) = reference.strip_prefix(PREFIX).and_then(renamed) {
            *reference = target(&name);
        }
    });
}

/// Removes the components that no operation uses, directly or through others.
pub fn remove_unused(document: &mut Value) {
    let mut schemas = std::mem::take(&mut document["components"]["schemas"]);
    let mut used = BTreeSet::new();
    let mut next = names_in(document);
    while let Some(name) = next.pop() {
        if let Some(schema) = schemas.get_mut(&name)
            && used.insert(name)
        {
            next.extend(names_in(schema));
        }
    }
    if let Some(schemas) = schemas.as_object_mut() {
        schemas.retain(|name, _| used.contains(name));
    }
    document["components"]["schemas"] = schemas;
}

fn names_in(value: &mut Value) -> Vec<String> {
    let mut names = Vec::new();
    for_each_reference(value, &mut |reference| names.extend(reference.strip_prefix(PREFIX).map(str::to_owned)));
    names
}

fn for_each_reference(value: &mut Value, visit: &mut impl FnMut(&mut String)) {
    match value {
        Value::Object(object) => {
            for (key, value) in object {
                match value {
                    Value::String(text) if key == "$ref" => visit(text),
                    value => for_each_reference(value, visit),
                }
            }
        }
        Value::Array(list) => list.iter_mut().for_each(|value| for_each_reference(value, visit)),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_get_readable_names_and_keep_their_references() {
        let page = json!({"properties": {"items": {"items": {"type": "object"}}}});
        let mut document = json!({"paths": {"/jobs": reference("Page_JobView")},
            "components": {"schemas": {"Page_JobView": page, "JobView": {}, "Unused": reference("JobView")}}});
        rename_pages(&mut document);
        remove_unused(&mut document);
        assert_eq!(document["paths"]["/jobs"], reference("JobPage"));
        let items = &document["components"]["schemas"]["JobPage"]["properties"]["items"]["items"];
        assert_eq!(items, &reference("JobView"));
        let names: Vec<&String> = document["components"]["schemas"].as_object().unwrap().keys().collect();
        assert_eq!(names, ["JobPage", "JobView"]);
    }

    #[test]
    fn names_are_written_as_types() {
        assert_eq!([pascal_case("tool_position"), pascal_case("sst")], ["ToolPosition", "Sst"]);
    }
}
