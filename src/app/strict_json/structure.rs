//! Rejects duplicate keys, deep nesting and anything but an object before deserialization; serde would silently keep
//! the last duplicate and read a list as an object.

use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde_path_to_error::{Path, Track};
use std::collections::HashSet;
use std::fmt;

/// Maximum nesting of objects and lists.
pub const MAX_DEPTH: usize = 32;

/// Checks the whole body.
///
/// # Errors
/// The place and what is wrong there; the same for text that is not JSON.
pub fn check(bytes: &[u8]) -> Result<(), (Path, serde_json::Error)> {
    let mut json = serde_json::Deserializer::from_slice(bytes);
    let mut track = Track::new();
    let tracked = serde_path_to_error::Deserializer::new(&mut json, &mut track);
    Place { depth: 0 }.deserialize(tracked).map_err(|error| (track.path(), error))
}

/// A value, `depth` objects and lists below the top.
#[derive(Clone, Copy)]
struct Place {
    depth: usize,
}

impl Place {
    fn inside<E: Error>(self) -> Result<Self, E> {
        if self.depth == MAX_DEPTH {
            return Err(E::custom(format_args!(
                "more than {MAX_DEPTH} objects and lists inside each other: flatten it"
            )));
        }
        Ok(Self { depth: self.depth + 1 })
    }

    fn leaf<E: Error>(self, what: &str) -> Result<(), E> {
        if self.depth > 0 {
            return Ok(());
        }
        Err(E::custom(format_args!("the body is {what}: send an object")))
    }
}

impl<'de> DeserializeSeed<'de> for Place {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, json: D) -> Result<(), D::Error> {
        json.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Place {
    type Value = ();

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("JSON")
    }

    fn visit_bool<E: Error>(self, _: bool) -> Result<(), E> {
        self.leaf("a truth value")
    }

    fn visit_i64<E: Error>(self, _: i64) -> Result<(), E> {
        self.leaf("a number")
    }

    fn visit_u64<E: Error>(self, _: u64) -> Result<(), E> {
        self.leaf("a number")
    }

    fn visit_f64<E: Error>(self, _: f64) -> Result<(), E> {
        self.leaf("a number")
    }

    fn visit_str<E: Error>(self, _: &str) -> Result<(), E> {
        self.leaf("a text")
    }

    fn visit_unit<E: Error>(self) -> Result<(), E> {
        self.leaf("null")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        self.leaf("a list")?;
        let inside = self.inside()?;
        while list.next_element_seed(inside)?.is_some() {}
        Ok(())
    }

    fn visit_map<A: MapAccess<'de>>(self, mut object: A) -> Result<(), A::Error> {
        let inside = self.inside()?;
        let mut seen = HashSet::new();
        while let Some(key) = object.next_key::<String>()? {
            if seen.contains(&key) {
                return Err(A::Error::custom(format_args!("key {key:?} stands twice in one object: give it once")));
            }
            object.next_value_seed(inside)?;
            seen.insert(key);
        }
        Ok(())
    }
}
