//! The description of REST: operations of the OpenAPI document with the shapes of what they take and give.

use super::rules::{BODY_FIELDS, RENAMED_PARAMETERS, REPEATED};
use super::shape::{Object, Shape};
use serde_json::Value;
use std::collections::BTreeMap;

/// One operation.
pub struct Operation {
    pub id: String,
    pub method: String,
    pub path: String,
    /// Parameters and body.
    pub request: Shape,
    /// The body of the first successful answer; `None` if it has none.
    pub response: Option<Shape>,
}

/// The OpenAPI document.
pub struct Rest(Value);

impl Rest {
    /// The document that the tests of the schema keep equal to the code.
    pub fn read() -> Self {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/web/openapi.json");
        Self(serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap())
    }

    /// All operations, in the order of the document.
    pub fn operations(&self) -> Vec<Operation> {
        let mut all = Vec::new();
        for (path, methods) in self.0["paths"].as_object().unwrap() {
            for (method, operation) in methods.as_object().unwrap() {
                let Some(id) = operation["operationId"].as_str() else { continue };
                all.push(Operation {
                    id: id.to_owned(),
                    method: method.clone(),
                    path: path.clone(),
                    request: Shape::Object(self.request(id, operation)),
                    response: self.response(operation),
                });
            }
        }
        all
    }

    fn request(&self, id: &str, operation: &Value) -> Object {
        let mut request = Object::named(id);
        for parameter in operation["parameters"].as_array().into_iter().flatten() {
            let name = self.resolved(parameter)["name"].as_str().unwrap();
            let renamed = RENAMED_PARAMETERS.iter().find(|(rest, _)| *rest == name);
            request.fields.insert(renamed.map_or(name, |(_, grpc)| grpc).to_owned(), Shape::Any);
        }
        let body = &operation["requestBody"]["content"]["application/json"]["schema"];
        // An upload takes files of any kind: its parameters describe it.
        if id == "uploadDemonstration" || body.is_null() {
            return request;
        }
        let body = self.shape(body);
        if let Some((_, field)) = BODY_FIELDS.iter().find(|(operation, _)| *operation == id) {
            request.fields.insert((*field).to_owned(), body);
        } else if let Shape::Object(body) = body {
            request.merge(body);
        }
        request
    }

    fn response(&self, operation: &Value) -> Option<Shape> {
        let answers = operation["responses"].as_object().unwrap();
        let (_, answer) = answers.iter().find(|(status, _)| status.starts_with('2')).unwrap();
        let content = self.resolved(answer)["content"].as_object()?;
        let (media_type, content) = content.iter().next()?;
        match media_type.as_str() {
            // A document that is not JSON counts as text.
            "application/xml" => Some(Shape::Text),
            _ => Some(self.shape(&content["schema"])),
        }
    }

    fn resolved<'a>(&'a self, value: &'a Value) -> &'a Value {
        match value["$ref"].as_str() {
            Some(reference) => self.0.pointer(reference.trim_start_matches('#')).unwrap(),
            None => value,
        }
    }

    fn shape(&self, schema: &Value) -> Shape {
        if let Some(reference) = schema["$ref"].as_str() {
            let name = reference.rsplit('/').next().unwrap();
            let mut shape = self.shape(self.resolved(schema));
            if let Shape::Object(object) = &mut shape {
                name.clone_into(&mut object.name);
                if REPEATED.contains(&name) {
                    object.hoist();
                }
            }
            return shape;
        }
        if let Some(parts) = schema["allOf"].as_array() {
            return self.merged(schema, parts);
        }
        for key in ["oneOf", "anyOf"] {
            if let Some(alternatives) = schema[key].as_array() {
                return self.alternatives(alternatives);
            }
        }
        if let Some(names) = schema["enum"].as_array() {
            return Shape::Names(names.iter().filter_map(Value::as_str).map(str::to_lowercase).collect());
        }
        if let Some(name) = schema["const"].as_str() {
            return Shape::Names([name.to_lowercase()].into());
        }
        match (type_of(schema), schema["format"].as_str()) {
            ("string", Some("date-time")) => Shape::Time,
            ("string", Some("binary")) => Shape::Bytes,
            ("string", _) => Shape::Text,
            ("boolean", _) => Shape::Truth,
            ("integer", _) => Shape::Integer,
            ("number", _) => Shape::Number,
            ("array", _) => Shape::List(Box::new(self.shape(&schema["items"]))),
            ("object", _) if schema["properties"].is_object() => self.object(schema),
            ("object", _) if schema["additionalProperties"].is_object() => {
                Shape::Map(Box::new(self.shape(&schema["additionalProperties"])))
            }
            _ => Shape::Any,
        }
    }

    fn object(&self, schema: &Value) -> Shape {
        let properties = schema["properties"].as_object().unwrap();
        let fields = properties.iter().map(|(name, schema)| (name.clone(), self.shape(schema))).collect();
        Shape::Object(Object { name: String::new(), fields, variants: BTreeMap::new() })
    }

    fn merged(&self, schema: &Value, parts: &[Value]) -> Shape {
        let mut whole = Object::default();
        let own = schema["properties"].is_object().then(|| self.object(schema));
        for part in parts.iter().map(|part| self.shape(part)).chain(own) {
            match part {
                Shape::Object(object) => whole.merge(object),
                other if parts.len() == 1 => return other,
                other => panic!("{other:?} cannot be a part of an object"),
            }
        }
        Shape::Object(whole)
    }

    /// One of several: the variants of a tagged union, of names and single fields, or the one that is not null.
    fn alternatives(&self, alternatives: &[Value]) -> Shape {
        let present: Vec<&Value> = alternatives.iter().filter(|schema| type_of(schema) != "null").collect();
        if let [only] = present.as_slice() {
            return self.shape(only);
        }
        let mut union = Object::default();
        let mut plain = Vec::new();
        for schema in present {
            match self.shape(schema) {
                Shape::Object(mut object) => match tag(&object) {
                    Some((field, name)) => {
                        object.fields.remove(&field);
                        union.variants.insert(name, Shape::Object(object));
                    }
                    // `{"count_as": 5}` beside `"exclude"`
                    None if object.fields.len() == 1 => union.variants.extend(object.fields),
                    // a name in place of an object
                    None => union.merge(object),
                },
                Shape::Names(names) => plain.extend(names),
                Shape::Integer => plain.extend((1..=6).map(|number| number.to_string())),
                Shape::Text => {}
                other => panic!("{other:?} as one of several"),
            }
        }
        if union == Object::default() {
            return Shape::Names(plain.into_iter().collect());
        }
        for name in plain {
            union.variants.entry(name).or_insert_with(|| Shape::Object(Object::default()));
        }
        Shape::Object(union)
    }
}

/// The field with one name only, and that name.
fn tag(object: &Object) -> Option<(String, String)> {
    object.fields.iter().find_map(|(field, shape)| match shape {
        Shape::Names(names) if names.len() == 1 => Some((field.clone(), names.first()?.clone())),
        _ => None,
    })
}

/// The type, the one beside null if there are two.
fn type_of(schema: &Value) -> &str {
    match &schema["type"] {
        Value::Array(types) => types.iter().filter_map(Value::as_str).find(|name| *name != "null").unwrap_or("null"),
        other => other.as_str().unwrap_or(""),
    }
}
