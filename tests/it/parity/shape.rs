//! Shape of a value in terms that OpenAPI and protocol buffers share, and the differences between two shapes.

use std::collections::{BTreeMap, BTreeSet};

/// Shape of a value.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    Text,
    Time,
    Truth,
    Integer,
    Number,
    Bytes,
    /// Any JSON, or a parameter of a URL, which is text whatever it means.
    Any,
    /// One of these names, in lower case.
    Names(BTreeSet<String>),
    List(Box<Shape>),
    Map(Box<Shape>),
    Object(Object),
}

/// Named fields, and the variants of which one is present.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Object {
    /// Name of the schema or message; of the operation if it has none.
    pub name: String,
    pub fields: BTreeMap<String, Shape>,
    pub variants: BTreeMap<String, Shape>,
}

impl Object {
    pub fn named(name: &str) -> Self {
        Self { name: name.to_owned(), ..Self::default() }
    }

    /// Takes in the fields and variants of another one, and its name if it has none.
    pub fn merge(&mut self, other: Object) {
        let Object { name, fields, variants } = other;
        if self.name.is_empty() {
            self.name = name;
        }
        self.fields.extend(fields);
        self.variants.extend(variants);
    }
}

impl Object {
    /// Makes fields that every variant has the object's own.
    pub fn hoist(&mut self) {
        let variants: Vec<&Object> = self.variants.values().filter_map(Shape::object).collect();
        let Some(first) = variants.first() else { return };
        let is_shared = |name: &&String| variants.iter().all(|variant| variant.fields.contains_key(*name));
        let shared: Vec<String> = first.fields.keys().filter(is_shared).cloned().collect();
        for variant in self.variants.values_mut() {
            if let Shape::Object(variant) = variant {
                for name in &shared {
                    self.fields.extend(variant.fields.remove_entry(name));
                }
            }
        }
    }
}

impl Shape {
    fn object(&self) -> Option<&Object> {
        match self {
            Self::Object(object) => Some(object),
            _ => None,
        }
    }
}

/// Writes down how the value of `rest` and the one of `grpc` differ; `place` names the field.
pub fn compare(place: &str, rest: &Shape, grpc: &Shape, differences: &mut BTreeSet<String>) {
    match (rest, grpc) {
        (Shape::Any, _) | (_, Shape::Any) => {}
        (Shape::List(rest), Shape::List(grpc)) | (Shape::Map(rest), Shape::Map(grpc)) => {
            compare(place, rest, grpc, differences);
        }
        (Shape::Object(rest), Shape::Object(grpc)) => objects(rest, grpc, differences),
        (rest, grpc) if rest == grpc => {}
        _ => drop(differences.insert(format!("type of: {place}"))),
    }
}

fn objects(rest: &Object, grpc: &Object, differences: &mut BTreeSet<String>) {
    let both = |rest_fields: &BTreeMap<String, Shape>,
                grpc_fields: &BTreeMap<String, Shape>,
                differences: &mut BTreeSet<String>| {
        let alone = rest_fields.keys().filter(|name| !grpc_fields.contains_key(*name));
        differences.extend(alone.map(|name| format!("REST only: {}.{name}", grpc.name)));
        let alone = grpc_fields.keys().filter(|name| !rest_fields.contains_key(*name));
        differences.extend(alone.map(|name| format!("gRPC only: {}.{name}", grpc.name)));
    };
    both(&rest.fields, &grpc.fields, differences);
    both(&rest.variants, &grpc.variants, differences);
    for (name, shape) in &rest.fields {
        if let Some(other) = grpc.fields.get(name) {
            compare(&format!("{}.{name}", grpc.name), shape, other, differences);
        }
    }
    for (name, shape) in &rest.variants {
        if let Some(other) = grpc.variants.get(name) {
            compare(&format!("{}.{name}", grpc.name), nested(name, shape, other), other, differences);
        }
    }
}

/// A variant whose only field has its name is that field, unless the other side has such a field too.
fn nested<'a>(name: &str, variant: &'a Shape, other: &Shape) -> &'a Shape {
    let has_field = |shape: &Shape| matches!(shape, Shape::Object(object) if object.fields.contains_key(name));
    match variant {
        Shape::Object(object) if object.fields.len() == 1 && has_field(variant) && !has_field(other) => {
            &object.fields[name]
        }
        whole => whole,
    }
}

#[test]
fn a_difference_names_its_side_and_its_place() {
    let object = |name: &str, fields: &[(&str, Shape)]| {
        let fields = fields.iter().map(|(name, shape)| ((*name).to_owned(), shape.clone())).collect();
        Shape::Object(Object { name: name.to_owned(), fields, variants: BTreeMap::new() })
    };
    let rest = object("RunView", &[("valid", Shape::Truth), ("seed", Shape::Integer), ("id", Shape::Text)]);
    let grpc = object("Run", &[("seed", Shape::Number), ("id", Shape::Text), ("extra", Shape::Text)]);
    let mut differences = BTreeSet::new();
    compare("getRun", &rest, &grpc, &mut differences);
    let expected = ["REST only: Run.valid", "gRPC only: Run.extra", "type of: Run.seed"];
    assert_eq!(differences, expected.map(str::to_owned).into());
}
