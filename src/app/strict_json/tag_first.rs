//! Reads JSON with the tag of each object before its other members.
//!
//! A tag names the type of what stands beside it. Met first, it lets the rest be read in place, so that an error there
//! has a path; see [`tagged`](mod@crate::framework::tagged).

use serde::de::value::{MapDeserializer, SeqDeserializer};
use serde::de::{Deserializer, IntoDeserializer, Visitor};
use serde::forward_to_deserialize_any;
use serde_json::{Error, Value};

/// Tag of a method, the one object that is asked for as any value: a bare name may stand for it.
const TAG_OF_A_METHOD: &str = "name";

/// A value of which each object gives its tag first, which is the first of the fields that are asked for.
#[derive(Debug, Clone, Copy)]
pub struct TagFirst<'de>(pub &'de Value);

impl<'de> TagFirst<'de> {
    /// Gives the value; of an object, the member `first` before the others.
    fn give<V: Visitor<'de>>(self, first: &str, visitor: V) -> Result<V::Value, Error> {
        match self.0 {
            Value::Object(members) => {
                let rank = |&(key, _): &(&str, Self)| key != first;
                let mut sorted: Vec<_> = members.iter().map(|(key, value)| (key.as_str(), Self(value))).collect();
                sorted.sort_by_key(rank);
                visitor.visit_map(MapDeserializer::new(sorted.into_iter()))
            }
            Value::Array(list) => {
                let mut items: SeqDeserializer<_, Error> = SeqDeserializer::new(list.iter().map(Self));
                let value = visitor.visit_seq(&mut items)?;
                items.end()?;
                Ok(value)
            }
            leaf => leaf.deserialize_any(visitor),
        }
    }
}

impl<'de> IntoDeserializer<'de, Error> for TagFirst<'de> {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}

impl<'de> Deserializer<'de> for TagFirst<'de> {
    type Error = Error;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        self.give(TAG_OF_A_METHOD, visitor)
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        self.give(fields.first().copied().unwrap_or_default(), visitor)
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        if self.0.is_null() { visitor.visit_none() } else { visitor.visit_some(self) }
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value, Error> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        self.0.deserialize_enum(name, variants, visitor)
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit unit_struct seq tuple
        tuple_struct map identifier ignored_any
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn the_value_stays_the_same() {
        let value = json!({"a": [1, -1, 0.5, "text", null, true, {}], "kind": {"b": {"c": u64::MAX}, "at": 1}});
        let read: Value = serde_path_to_error::deserialize(TagFirst(&value)).unwrap();
        assert_eq!(read, value);
    }
}
