//! Reads JSON that a client sent and rejects what serde would accept although no client means it: duplicate keys, deep
//! nesting, an array in place of an object, a number in place of a variant's name.
//!
//! # Invariants
//! - Text that is not JSON is `Malformed`; JSON that does not fit is `Invalid` at its JSON pointer.
//! - Accepted JSON means the same to every reader.

mod shape;
mod structure;
mod tag_first;

use super::json_pointer;
use super::model::{AppError, ErrorKind};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_path_to_error::{Path, Segment};
use tag_first::TagFirst;

/// The value in `bytes`.
///
/// # Errors
/// `Malformed` or `Invalid`, as the module says.
pub fn parse<T: DeserializeOwned + Serialize>(bytes: &[u8]) -> Result<T, AppError> {
    structure::check(bytes).map_err(|(path, error)| refusal(pointer(&path), &error))?;
    let sent = serde_json::from_slice(bytes).map_err(|error| refusal(String::new(), &error))?;
    let value = serde_path_to_error::deserialize(TagFirst(&sent)).map_err(|error| {
        let pointer = pointer(error.path());
        refusal(pointer, error.inner())
    })?;
    shape::check("", &sent, &serde_json::to_value(&value).map_err(AppError::internal)?)?;
    Ok(value)
}

fn refusal(pointer: String, error: &serde_json::Error) -> AppError {
    match error.classify() {
        serde_json::error::Category::Data => AppError::field(pointer, "invalid_value", error.to_string()),
        _ => AppError::new(ErrorKind::Malformed, "invalid_json", format!("the body is not JSON: {error}")),
    }
}

fn pointer(path: &Path) -> String {
    path.iter().fold(String::new(), |pointer, segment| match segment {
        Segment::Seq { index } => json_pointer::join(&pointer, index),
        Segment::Map { key } => json_pointer::join(&pointer, key),
        Segment::Enum { .. } | Segment::Unknown => pointer,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, serde::Deserialize, Serialize, PartialEq)]
    #[serde(deny_unknown_fields)]
    struct Outer {
        rows: Vec<Inner>,
    }
    #[derive(Debug, serde::Deserialize, Serialize, PartialEq)]
    struct Inner {
        count: u8,
    }

    #[test]
    fn a_wrong_value_is_invalid_and_told_by_its_pointer() {
        let error = parse::<Outer>(br#"{"rows": [{"count": 1}, {"count": 300}]}"#).unwrap_err();
        assert_eq!((error.kind, error.details[0].pointer.as_str()), (ErrorKind::Invalid, "/rows/1/count"));
        let error = parse::<Outer>(br#"{"rows": [{"count": 1}, [2]]}"#).unwrap_err();
        assert_eq!((error.kind, error.details[0].pointer.as_str()), (ErrorKind::Invalid, "/rows/1"));
        let error = parse::<Outer>(br#"{"rows": [], "ro/ws": 1}"#).unwrap_err();
        assert_eq!((error.kind, error.details[0].pointer.as_str()), (ErrorKind::Invalid, "/ro~1ws"));
    }

    #[test]
    fn a_wrong_value_is_told_by_its_pointer_wherever_the_tag_stands() {
        let id = "0".repeat(32);
        let place = |execution: &str| {
            let (action, robot, world) = (format!("act_{id}"), format!("rob_{id}"), format!("wld_{id}"));
            let body = format!(
                r#"{{"execution": {execution}, "action": "{action}", "robot": "{robot}", "world": "{world}", "kind": "execution"}}"#
            );
            parse::<crate::app::model::CreateJob>(body.as_bytes()).unwrap_err().details[0].pointer.clone()
        };
        assert_eq!(place(r#"{"method": {"population": -1, "name": "sst"}}"#), "/execution/method/population");
        assert_eq!(place(r#"{"method": {"population": 10, "name": "sts"}}"#), "/execution/method/name");
        assert_eq!(place(r#"{"method": "sts"}"#), "/execution/method");
        assert_eq!(place(r#"{"method": {"at": 1, "name": "sst"}}"#), "/execution/method/at");
        let point = r#"{"shape": 1, "at": "tool"}"#;
        let region = r#"{"geometry": {"center_m": [0, 0, 0], "radius_m": 1, "shape": "sphere"}, "kind": "region""#;
        let body = format!(r#"{{"method": "sst", "constraints": [{region}, "point": {point}}}]}}"#);
        assert_eq!(place(&body), "/execution/constraints/0/point/shape");
    }

    #[test]
    fn text_that_is_no_json_and_duplicate_keys_are_refused() {
        for wrong in ["", "{", "{\"rows\": []} x", "\u{feff}{}"] {
            assert_eq!(parse::<Outer>(wrong.as_bytes()).unwrap_err().kind, ErrorKind::Malformed, "{wrong:?}");
        }
    }

    #[test]
    fn what_could_be_read_in_two_ways_is_refused_at_its_place() {
        let place = |text: &str| {
            let error = parse::<serde_json::Value>(text.as_bytes()).unwrap_err();
            assert_eq!((error.kind, error.details.len()), (ErrorKind::Invalid, 1), "{text}");
            assert!(!error.message.starts_with(':'), "{}", error.message);
            error.details[0].pointer.clone()
        };
        assert_eq!(place(r#"{"fixed": {"a": 1, "b": {}, "a": 2}}"#), "/fixed");
        assert_eq!(place(r#"{"rows": [], "rows": []}"#), "");
        for wrong in ["[]", "null", "1", "-1", "1.5", "true", "\"text\"", "[[{}]]"] {
            assert_eq!(place(wrong), "");
        }
        let nested = |depth: usize| format!("{{\"a\":{}{}}}", "[".repeat(depth), "]".repeat(depth));
        parse::<serde_json::Value>(nested(structure::MAX_DEPTH - 1).as_bytes()).unwrap();
        assert!(place(&nested(structure::MAX_DEPTH)).starts_with("/a/0/0"));
        assert!(place(&nested(100_000)).starts_with("/a/0/0"));
    }
}
