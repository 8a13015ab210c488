//! Names every variant of a union and adds the discriminator.
//!
//! Serde's tagged enums arrive as a `oneOf` of unnamed `allOf`s: the payload beside an object that holds the tag. Client
//! generators skip such operations or invent names for the variants. Here each variant becomes one flat component, for
//! example `CreateJobExecution`, with its tag as a constant.
//!
//! # Invariants
//! - A variant is named after its union and its tag, in that order; without a tag, after its content.
//! - An object that rejects unknown properties still rejects them after its tag was added.
//! - `null` is the only variant without a name.

use super::schemas::{Schemas, pascal_case, reference, target};
use serde_json::{Map, Value, json};

/// Rewrites all unions among the components.
pub fn name_variants(schemas: &mut Schemas) {
    for name in schemas.keys().cloned().collect::<Vec<_>>() {
        let Some(schema) = schemas.get(&name).cloned() else { continue };
        let schema = distributed(schema, schemas);
        let schema = match schema.get("oneOf").and_then(Value::as_array) {
            Some(variants) => named(&name, &schema, variants, schemas),
            None if schema.get("allOf").is_some() => described(flat(&schema, schemas), &schema),
            None => continue,
        };
        schemas.insert(name, schema);
    }
}

/// The union of all its parts, for an `allOf` that adds fields to a union (serde's `flatten`).
fn distributed(schema: Value, schemas: &Schemas) -> Value {
    let Some(parts) = schema.get("allOf").and_then(Value::as_array) else { return schema };
    let union = |part: &Value| resolved(part, schemas).get("oneOf").and_then(Value::as_array).cloned();
    let Some((index, variants)) = parts.iter().enumerate().find_map(|(index, part)| Some((index, union(part)?))) else {
        return schema;
    };
    let variants = variants.into_iter().map(|variant| {
        let description = resolved(&variant, schemas).get("description").cloned();
        let mut all = parts.clone();
        all[index] = variant;
        json!({"allOf": all, "description": description})
    });
    described(json!({"oneOf": variants.collect::<Vec<_>>()}), &schema)
}

/// The union with references only; their targets are added to `schemas`.
fn named(name: &str, union: &Value, variants: &[Value], schemas: &mut Schemas) -> Value {
    let parts: Vec<Value> = variants.iter().map(|variant| described(flat(variant, schemas), variant)).collect();
    let tag = tag(&parts);
    let mut mapping = Map::new();
    let mut references = Vec::new();
    for (variant, mut part) in variants.iter().zip(parts) {
        if variant.get("$ref").is_some() || variant["type"] == "null" {
            references.push(variant.clone());
            continue;
        }
        let value = tag.as_ref().and_then(|tag| constant(&part["properties"][tag]));
        let part_name = format!("{name}{}", pascal_case(value.as_deref().unwrap_or_else(|| content(&part))));
        let reference = reference(&part_name);
        if let (Some(tag), Some(value)) = (&tag, value) {
            part["properties"][tag] = json!({"type": "string", "const": value});
            mapping.insert(value, Value::from(target(&part_name)));
        }
        references.push(reference);
        schemas.insert(part_name, part);
    }
    let mut union = union.clone();
    union["oneOf"] = Value::from(references);
    if let Some(tag) = tag {
        union["discriminator"] = json!({"propertyName": tag, "mapping": mapping});
    }
    union
}

/// One schema without `allOf` and without references at its top.
fn flat(schema: &Value, schemas: &Schemas) -> Value {
    let schema = resolved(schema, schemas);
    let Some(parts) = schema.get("allOf").and_then(Value::as_array) else { return schema.clone() };
    let (mut required, mut properties, mut closed) = (Vec::new(), Map::new(), false);
    for part in parts {
        let part = flat(part, schemas);
        required.extend(part.get("required").and_then(Value::as_array).cloned().unwrap_or_default());
        properties.extend(part.get("properties").and_then(Value::as_object).cloned().unwrap_or_default());
        closed |= part.get("additionalProperties") == Some(&Value::Bool(false));
    }
    let mut whole = json!({"type": "object", "required": required, "properties": properties});
    if closed {
        whole["additionalProperties"] = Value::Bool(false);
    }
    whole
}

/// Name of the tag: the property with one allowed value in every part.
fn tag(parts: &[Value]) -> Option<String> {
    let has = |part: &Value, property: &String| constant(&part["properties"][property]).is_some();
    let first = parts.first()?.get("properties")?.as_object()?;
    first.keys().find(|property| parts.iter().all(|part| has(part, property))).cloned()
}

fn constant(schema: &Value) -> Option<String> {
    let only = match schema["enum"].as_array().map(Vec::as_slice) {
        Some([only]) => only,
        _ => schema.get("const")?,
    };
    only.as_str().map(str::to_owned)
}

/// Second part of an untagged variant's name: its one allowed value, its one required property, or else its type.
fn content(part: &Value) -> &str {
    let value = part["enum"].as_array().and_then(|values| values.first());
    let property = part["required"].as_array().and_then(|required| required.first());
    value.or(property).or(part.get("type")).and_then(Value::as_str).unwrap_or_default()
}

fn resolved<'a>(schema: &'a Value, schemas: &'a Schemas) -> &'a Value {
    let name = schema["$ref"].as_str().and_then(|reference| reference.rsplit('/').next());
    name.and_then(|name| schemas.get(name)).unwrap_or(schema)
}

fn described(mut schema: Value, source: &Value) -> Value {
    if let Some(description) = source.get("description").filter(|description| description.is_string()) {
        schema["description"] = description.clone();
    }
    schema
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rewritten(schemas: Value) -> Value {
        let Value::Object(mut schemas) = schemas else { panic!("no object") };
        name_variants(&mut schemas);
        Value::Object(schemas)
    }

    fn tagged(tag: &str, value: &str) -> Value {
        json!({"type": "object", "required": [tag], "properties": {tag: {"type": "string", "enum": [value]}}})
    }

    #[test]
    fn a_tagged_variant_becomes_one_closed_object_with_a_constant() {
        let payload = json!({"type": "object", "required": ["unit"], "properties": {"unit": {"type": "string"}},
            "additionalProperties": false});
        let variant = json!({"description": "Where the tool is.",
            "allOf": [{"$ref": "#/components/schemas/Payload"}, tagged("kind", "tool_position")]});
        let schemas = rewritten(json!({"Payload": payload, "World": {"oneOf": [variant]}}));
        assert_eq!(
            schemas["WorldToolPosition"],
            json!({"type": "object", "description": "Where the tool is.", "required": ["unit", "kind"],
                "properties": {"unit": {"type": "string"}, "kind": {"type": "string", "const": "tool_position"}},
                "additionalProperties": false})
        );
        let target = "#/components/schemas/WorldToolPosition";
        let discriminator = json!({"propertyName": "kind", "mapping": {"tool_position": target}});
        assert_eq!(schemas["World"], json!({"oneOf": [{"$ref": target}], "discriminator": discriminator}));
    }

    #[test]
    fn fields_beside_a_union_are_in_each_of_its_variants() {
        let union = json!({"oneOf": [tagged("type", "goal"), tagged("type", "run")]});
        let event = json!({"allOf": [{"$ref": "#/components/schemas/Data"},
            {"type": "object", "required": ["seq"], "properties": {"seq": {"type": "integer"}}}]});
        let schemas = rewritten(json!({"Data": union, "Event": event}));
        assert_eq!(schemas["Event"]["discriminator"]["mapping"]["run"], "#/components/schemas/EventRun");
        assert_eq!(schemas["EventRun"]["required"], json!(["type", "seq"]));
        assert_eq!(schemas["EventGoal"]["properties"]["seq"]["type"], "integer");
    }

    #[test]
    fn untagged_variants_are_named_after_what_they_hold_and_null_stays() {
        let count = json!({"type": "object", "required": ["count_as"], "properties": {"count_as": {"type": "number"}}});
        let variants = json!([{"type": "string", "enum": ["exclude"]}, count, {"type": "integer"}, {"type": "null"}]);
        let schemas = rewritten(json!({"Rule": {"oneOf": variants}}));
        let names: Vec<&String> = schemas.as_object().unwrap().keys().collect();
        assert_eq!(names, ["Rule", "RuleCountAs", "RuleExclude", "RuleInteger"]);
        assert_eq!(schemas["Rule"]["oneOf"][3], json!({"type": "null"}));
        assert!(schemas["Rule"].get("discriminator").is_none());
    }
}
