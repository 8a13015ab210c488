//! JSON objects and `google.protobuf.Struct`.

use crate::app::json_pointer;
use crate::app::model::{AppError, FieldError};
use prost_types::value::Kind;
use prost_types::{ListValue, Struct};
use serde_json::{Map, Number, Value};

/// Whole numbers up to this magnitude are exact in a message, which knows 64-bit floating point only.
const EXACT: f64 = 9_007_199_254_740_992.0;

/// An object; null if absent.
///
/// # Errors
/// `Invalid` below `pointer` for a number that JSON cannot hold or a value of no kind.
pub fn read(pointer: &str, object: Option<Struct>) -> Result<Value, AppError> {
    object.map_or(Ok(Value::Null), |object| members(pointer, object))
}

fn members(pointer: &str, object: Struct) -> Result<Value, AppError> {
    let Struct { fields } = object;
    let member = |(key, member): (String, prost_types::Value)| {
        let below = json_pointer::join(pointer, &key);
        Ok((key, value(&below, member)?))
    };
    fields.into_iter().map(member).collect::<Result<Map<_, _>, _>>().map(Value::Object)
}

fn value(pointer: &str, message: prost_types::Value) -> Result<Value, AppError> {
    let prost_types::Value { kind } = message;
    let wrong = |detail: String| AppError::invalid(vec![FieldError::new(pointer, "invalid_value", detail)]);
    match kind {
        None => Err(wrong("a value has a kind, this one has none".to_owned())),
        Some(Kind::NullValue(_)) => Ok(Value::Null),
        Some(Kind::BoolValue(value)) => Ok(Value::Bool(value)),
        Some(Kind::StringValue(text)) => Ok(Value::String(text)),
        Some(Kind::StructValue(object)) => members(pointer, object),
        Some(Kind::ListValue(ListValue { values })) => {
            let item = |(index, item)| value(&json_pointer::join(pointer, index), item);
            values.into_iter().enumerate().map(item).collect::<Result<Vec<_>, _>>().map(Value::Array)
        }
        Some(Kind::NumberValue(number)) => {
            self::number(number).ok_or_else(|| wrong(format!("{number} is not a finite number")))
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "whole and within the exact range")]
fn number(number: f64) -> Option<Value> {
    if number.fract() == 0.0 && number.abs() <= EXACT {
        return Some(Value::from(number as i64));
    }
    Number::from_f64(number).map(Value::Number)
}

/// The same object; `None` for anything else, which the service does not keep.
pub fn write(value: Value) -> Option<Struct> {
    match value {
        Value::Object(members) => {
            Some(Struct { fields: members.into_iter().map(|(key, member)| (key, message(member))).collect() })
        }
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) | Value::Array(_) => None,
    }
}

/// The same value.
pub fn message(value: Value) -> prost_types::Value {
    let kind = match value {
        Value::Null => Kind::NullValue(0),
        Value::Bool(value) => Kind::BoolValue(value),
        Value::Number(number) => Kind::NumberValue(number.as_f64().unwrap_or_default()),
        Value::String(text) => Kind::StringValue(text),
        Value::Array(items) => Kind::ListValue(ListValue { values: items.into_iter().map(message).collect() }),
        Value::Object(members) => {
            let fields = members.into_iter().map(|(key, member)| (key, message(member))).collect();
            Kind::StructValue(Struct { fields })
        }
    };
    prost_types::Value { kind: Some(kind) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn an_object_survives_and_anything_else_is_absent() {
        let object = json!({"execution": {"method": {"name": "sst", "population": 10, "mutation_probability": 0.25},
            "tolerance": null, "constraints": [true, "a", -3]}});
        assert_eq!(read("", write(object.clone())).unwrap(), object);
        assert_eq!(write(json!("sst")), None);
        assert_eq!(read("", None).unwrap(), Value::Null);
    }

    #[test]
    fn a_number_that_json_cannot_hold_is_refused_at_its_place() {
        let infinite = prost_types::Value { kind: Some(Kind::NumberValue(f64::INFINITY)) };
        let list = prost_types::Value { kind: Some(Kind::ListValue(ListValue { values: vec![infinite] })) };
        let wrong = Struct { fields: [("a/b".to_owned(), list)].into() };
        assert_eq!(read("/overrides", Some(wrong)).unwrap_err().details[0].pointer, "/overrides/a~1b/0");
        let empty = Struct { fields: [("a".to_owned(), prost_types::Value { kind: None })].into() };
        assert_eq!(read("/overrides", Some(empty)).unwrap_err().details[0].pointer, "/overrides/a");
    }
}
