//! Rejects JSON that serde accepts but no client means: an array in place of an object, or a number in place of a
//! variant's name.

use crate::app::json_pointer;
use crate::app::model::AppError;
use serde_json::Value;

/// Compares what was sent with what was understood, serialized again. A name may stand for an object with its defaults;
/// what is absent on either side is not compared.
///
/// # Errors
/// The first place below `pointer` with another shape.
pub fn check(pointer: &str, sent: &Value, understood: &Value) -> Result<(), AppError> {
    match (sent, understood) {
        (Value::Object(sent), Value::Object(understood)) => sent.iter().try_for_each(|(key, value)| {
            let below = || json_pointer::join(pointer, key);
            understood.get(key).map_or(Ok(()), |understood| check(&below(), value, understood))
        }),
        (Value::Array(sent), Value::Array(understood)) => {
            let mut pairs = sent.iter().zip(understood).enumerate();
            pairs.try_for_each(|(index, (sent, understood))| {
                check(&json_pointer::join(pointer, index), sent, understood)
            })
        }
        (Value::Null, _) | (_, Value::Null) | (Value::String(_), Value::Object(_)) => Ok(()),
        (sent, understood) if kind(sent) == kind(understood) => Ok(()),
        (sent, understood) => {
            let detail = format!("{} where {} is meant: give {1}", kind(sent), kind(understood));
            Err(AppError::field(pointer, "invalid_value", detail))
        }
    }
}

fn kind(value: &Value) -> &'static str {
    match value {
        Value::Null => "null",
        Value::Bool(_) => "a truth value",
        Value::Number(_) => "a number",
        Value::String(_) => "a text",
        Value::Array(_) => "a list",
        Value::Object(_) => "an object",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::model::CreateJob;
    use serde_json::json;

    fn place(execution: &Value) -> Option<String> {
        let id = "0".repeat(32);
        let sent = json!({"kind": "execution", "action": format!("act_{id}"), "robot": format!("rob_{id}"),
            "world": format!("wld_{id}"), "execution": execution});
        let found = crate::app::strict_json::parse::<CreateJob>(sent.to_string().as_bytes());
        found.err().map(|error| error.details[0].pointer.clone())
    }

    #[test]
    fn what_serde_takes_by_position_or_index_is_refused_at_its_place() {
        assert_eq!(place(&json!(["model"])), Some("/execution".to_owned()));
        assert_eq!(place(&json!({"method": {"name": 3}})), Some("/execution/method/name".to_owned()));
        assert_eq!(place(&json!({"method": "model", "reality": [0.5]})), Some("/execution/reality".to_owned()));
        let region = json!([{"kind": "region", "geometry": {"shape": 0, "lower_m": [0, 0, 0], "upper_m": [1, 1, 1]}}]);
        let pointer = "/execution/constraints/0/geometry/shape";
        assert_eq!(place(&json!({"method": "model", "constraints": region})), Some(pointer.to_owned()));
    }

    #[test]
    fn names_defaults_and_whole_numbers_are_no_other_shape() {
        assert_eq!(place(&json!({"method": "model", "tolerance": null})), None);
        assert_eq!(place(&json!({"method": {"name": "model"}, "tolerance": 5, "constraints": []})), None);
    }
}
