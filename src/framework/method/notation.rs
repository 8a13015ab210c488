//! A method by its name alone, or with its parameters.

use super::catalogue::MethodSpec;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserialize, Deserializer, Error, MapAccess, Visitor};
use std::fmt;

/// Reads a method written either way.
///
/// # Errors
/// An unknown name, reported with the known ones, or a parameter that the method does not have.
pub fn method_or_name<'de, D: Deserializer<'de>>(deserializer: D) -> Result<MethodSpec, D::Error> {
    deserializer.deserialize_any(MethodVisitor)
}

struct MethodVisitor;

impl<'de> Visitor<'de> for MethodVisitor {
    type Value = MethodSpec;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the name of a method or an object with `name` and parameters")
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<MethodSpec, E> {
        MethodSpec::by_name(name).ok_or_else(|| E::unknown_variant(name, &MethodSpec::NAMES))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<MethodSpec, A::Error> {
        MethodSpec::deserialize(MapAccessDeserializer::new(map))
    }
}

#[cfg(test)]
mod tests {
    use crate::execution::ExecutionSpec;
    use crate::method::MethodSpec;

    fn read(json: &str) -> Result<ExecutionSpec, String> {
        serde_json::from_str(json).map_err(|error| error.to_string())
    }

    #[test]
    fn a_name_is_the_method_with_its_defaults() {
        for name in MethodSpec::NAMES {
            let short = read(&format!(r#"{{"method": "{name}"}}"#)).unwrap();
            assert_eq!(short, ExecutionSpec::new(MethodSpec::by_name(name).unwrap()));
            assert_eq!(short, read(&format!(r#"{{"method": {{"name": "{name}"}}}}"#)).unwrap());
        }
    }

    #[test]
    fn what_is_no_method_is_told_with_what_would_be() {
        let error = read(r#"{"method": "modle"}"#).unwrap_err();
        assert!(error.contains("`modle`") && error.contains("`model`"), "{error}");
        let error = read(r#"{"method": 3}"#).unwrap_err();
        assert!(error.contains("the name of a method"), "{error}");
        let error = read(r#"{"method": {"name": "model", "nose": 1}}"#).unwrap_err();
        assert!(error.contains("nose"), "{error}");
    }
}
