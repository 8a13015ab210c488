//! The description of gRPC: rpcs of the descriptor set with the shapes of what they take and give, and messages as the
//! JSON that REST would have sent.

use super::rules::{ALTERNATIVES, FIELDS, FLATTENED, LISTS, NESTED, TAGS, TUPLES};
use super::shape::{Object, Shape};
use cgda::app::model::Timestamp;
use prost_reflect::prost::Message;
use prost_reflect::{
    DescriptorPool, DynamicMessage, EnumDescriptor, FieldDescriptor, Kind, MapKey, MessageDescriptor, MethodDescriptor,
    OneofDescriptor, ReflectMessage as _, Value as Field,
};
use serde_json::{Map, Value, json};

/// The package of our services.
pub const PACKAGE: &str = "cgda.v1";

/// All descriptors.
pub fn pool() -> DescriptorPool {
    DescriptorPool::decode(cgda::grpc::proto::DESCRIPTORS).unwrap()
}

/// All rpcs of our services.
pub fn rpcs(pool: &DescriptorPool) -> Vec<MethodDescriptor> {
    let services = pool.services().filter(|service| service.package_name() == PACKAGE);
    services.flat_map(|service| service.methods().collect::<Vec<_>>()).collect()
}

/// A message of our package.
pub fn message(pool: &DescriptorPool, name: &str) -> MessageDescriptor {
    pool.get_message_by_name(&format!("{PACKAGE}.{name}")).unwrap_or_else(|| panic!("there is no message {name}"))
}

fn listed(table: &[&str], owner: &str, name: &str) -> bool {
    table.contains(&format!("{owner}.{name}").as_str())
}

/// The oneof a field belongs to; `None` for a plain or optional one.
fn oneof(field: &FieldDescriptor) -> Option<OneofDescriptor> {
    field.containing_oneof().filter(|oneof| !oneof.is_synthetic())
}

/// Fields of a message, as a shape to compare.
pub fn shape(message: &MessageDescriptor) -> Shape {
    match message.full_name() {
        "google.protobuf.Timestamp" => return Shape::Time,
        "google.protobuf.Struct" | "google.protobuf.Value" => return Shape::Any,
        _ => {}
    }
    let name = message.name();
    match name {
        "FileChunk" => return Shape::Bytes,
        "RobotUrdf" => return Shape::Text,
        _ => {}
    }
    if LISTS.contains(&name) {
        return field_shape(&message.fields().next().unwrap());
    }
    if TUPLES.contains(&name) {
        return Shape::List(Box::new(field_shape(&message.fields().next().unwrap())));
    }
    let page = name.starts_with("List") && name.ends_with("Response");
    let mut object = Object::named(name);
    for field in message.fields() {
        let shape = field_shape(&field);
        let of = oneof(&field).filter(|oneof| !listed(ALTERNATIVES, name, oneof.name()));
        match of {
            Some(oneof) if listed(FIELDS, name, oneof.name()) => {
                let whole = object.fields.entry(oneof.name().to_owned());
                let whole = whole.or_insert_with(|| Shape::Object(Object::named(oneof.name())));
                let Shape::Object(whole) = whole else { unreachable!("made as an object") };
                whole.variants.insert(field.name().to_owned(), shape);
            }
            Some(_) => drop(object.variants.insert(field.name().to_owned(), shape)),
            None if listed(FLATTENED, name, field.name()) => {
                let Shape::Object(inner) = shape else { panic!("{} is not an object", field.name()) };
                object.fields.extend(inner.fields);
            }
            None if page && field.is_list() => drop(object.fields.insert("items".to_owned(), shape)),
            None => drop(object.fields.insert(field.name().to_owned(), shape)),
        }
    }
    Shape::Object(object)
}

fn field_shape(field: &FieldDescriptor) -> Shape {
    if field.is_map() {
        let kind = field.kind();
        return Shape::Map(Box::new(field_shape(&kind.as_message().unwrap().map_entry_value_field())));
    }
    let one = match field.kind() {
        Kind::Double | Kind::Float => Shape::Number,
        Kind::Bool => Shape::Truth,
        Kind::String => Shape::Text,
        Kind::Bytes => Shape::Bytes,
        Kind::Message(message) => shape(&message),
        Kind::Enum(names) => {
            let names = names.values().filter(|value| value.number() != 0);
            Shape::Names(
                names.map(|value| json_name(&value.parent_enum().clone(), value.name()).to_lowercase()).collect(),
            )
        }
        _ => Shape::Integer,
    };
    if field.is_list() { Shape::List(Box::new(one)) } else { one }
}

/// The name of an enum value without its prefix, in the case that JSON has: states are upper case.
fn json_name(of: &EnumDescriptor, value: &str) -> String {
    let mut prefix = String::new();
    for letter in of.name().chars() {
        if letter.is_uppercase() && !prefix.is_empty() {
            prefix.push('_');
        }
        prefix.push(letter.to_ascii_uppercase());
    }
    let name = value.strip_prefix(&format!("{prefix}_")).unwrap_or(value);
    if of.name() == "JobState" { name.to_owned() } else { name.to_lowercase() }
}

/// The message of our package by that name, as the JSON that REST would have sent.
pub fn document(name: &str, message: &impl Message) -> Value {
    let mut dynamic = DynamicMessage::new(self::message(&pool(), name));
    dynamic.transcode_from(message).unwrap();
    json_of(&dynamic)
}

/// A message as the JSON that REST would have sent.
pub fn json_of(message: &DynamicMessage) -> Value {
    let descriptor = message.descriptor();
    match descriptor.full_name() {
        "google.protobuf.Timestamp" => return json!(time(message).to_string()),
        "google.protobuf.Struct" => return fields_of_struct(message),
        "google.protobuf.Value" => return value_of_struct(message),
        _ => {}
    }
    let name = descriptor.name();
    let values = || descriptor.fields().map(|field| field_json(&field, &message.get_field(&field))).collect::<Vec<_>>();
    if LISTS.contains(&name) {
        return values().remove(0);
    }
    if TUPLES.contains(&name) {
        return Value::Array(values());
    }
    let page = name.starts_with("List") && name.ends_with("Response");
    let mut object = Map::new();
    for field in descriptor.fields() {
        let is_member = oneof(&field).is_some();
        let is_optional = field.supports_presence() || is_member;
        if is_optional && !message.has_field(&field) {
            continue;
        }
        let value = field_json(&field, &message.get_field(&field));
        let member = oneof(&field).filter(|oneof| !listed(ALTERNATIVES, name, oneof.name()));
        match member {
            // `"exclude"` or `{"count_as": 5}`
            Some(_) if name == "InvalidRule" => {
                return if value.is_object() { json!(field.name()) } else { json!({ field.name(): value }) };
            }
            Some(_) => {
                let tag = TAGS.iter().find(|(message, _)| *message == name).map_or("kind", |(_, tag)| tag);
                object.insert(tag.to_owned(), json!(field.name()));
                match value {
                    Value::Object(inner) if !listed(NESTED, name, field.name()) => object.extend(inner),
                    other => drop(object.insert(field.name().to_owned(), other)),
                }
            }
            None if page && field.is_list() => drop(object.insert("items".to_owned(), value)),
            None => drop(object.insert(field.name().to_owned(), value)),
        }
    }
    Value::Object(object)
}

fn field_json(field: &FieldDescriptor, value: &Field) -> Value {
    match value {
        Field::List(items) => Value::Array(items.iter().map(|item| one_json(field, item)).collect()),
        Field::Map(entries) => {
            let kind = field.kind();
            let of = kind.as_message().unwrap().map_entry_value_field();
            let entry = |(key, value): (&MapKey, &Field)| (key.as_str().unwrap().to_owned(), one_json(&of, value));
            Value::Object(entries.iter().map(entry).collect())
        }
        one => one_json(field, one),
    }
}

fn one_json(field: &FieldDescriptor, value: &Field) -> Value {
    match value {
        Field::Bool(value) => json!(value),
        Field::I32(value) => json!(value),
        Field::I64(value) => json!(value),
        Field::U32(value) => json!(value),
        Field::U64(value) => json!(value),
        Field::F32(value) => json!(value),
        Field::F64(value) => json!(value),
        Field::String(value) => json!(value),
        Field::Bytes(value) => json!(value.to_vec()),
        Field::Message(message) => json_of(message),
        Field::EnumNumber(0) => Value::Null,
        Field::EnumNumber(number) => {
            let kind = field.kind();
            let names = kind.as_enum().unwrap();
            let name = json_name(names, names.get_value(*number).unwrap().name());
            name.parse::<u32>().map_or(json!(name), |number| json!(number))
        }
        Field::List(_) | Field::Map(_) => unreachable!("a list or map within one"),
    }
}

fn time(message: &DynamicMessage) -> Timestamp {
    let seconds = message.get_field_by_name("seconds").unwrap().as_i64().unwrap();
    let nanos = message.get_field_by_name("nanos").unwrap().as_i32().unwrap();
    Timestamp(seconds * 1000 + i64::from(nanos) / 1_000_000)
}

fn fields_of_struct(message: &DynamicMessage) -> Value {
    let fields = message.get_field_by_name("fields").unwrap();
    let entry = |(key, value): (&MapKey, &Field)| {
        (key.as_str().unwrap().to_owned(), value_of_struct(value.as_message().unwrap()))
    };
    Value::Object(fields.as_map().unwrap().iter().map(entry).collect())
}

fn value_of_struct(message: &DynamicMessage) -> Value {
    let Some((field, value)) = message.fields().next() else { return Value::Null };
    match (field.name(), value) {
        ("null_value", _) => Value::Null,
        ("list_value", Field::Message(list)) => {
            let values = list.get_field_by_name("values").unwrap();
            Value::Array(values.as_list().unwrap().iter().map(|v| value_of_struct(v.as_message().unwrap())).collect())
        }
        (_, other) => one_json(&field, other),
    }
}
