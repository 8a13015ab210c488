//! Enums whose variant is named by a member of the same object, such as `kind`, read without losing the place of an
//! error.
//!
//! Serde's derived reader of such an enum copies the whole object before it reads the variant, and an error in the copy
//! has no path. The macro [`tagged!`](crate::tagged!) declares the same enum, and reads the variant member by member if
//! the tag comes first; a tag that comes later is read serde's way.

use serde::de::value::{EnumAccessDeserializer, MapAccessDeserializer};
use serde::de::{
    DeserializeSeed, Deserializer, EnumAccess, Error, IntoDeserializer, MapAccess, VariantAccess, Visitor,
};
use std::convert::Infallible;
use std::fmt;
use std::marker::PhantomData;

/// An enum declared by [`tagged!`](crate::tagged!).
pub trait Tagged<'de>: Sized {
    /// Member that names the variant.
    const TAG: &'static str;

    /// The tag as the one field that is asked for, so that a reader that can choose gives it first.
    const FIRST: &'static [&'static str] = &[Self::TAG];

    /// Reads a variant's name and then its content.
    ///
    /// # Errors
    /// An unknown variant, or content that is not the variant's.
    fn streamed<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error>;

    /// Reads an object with the tag anywhere.
    ///
    /// # Errors
    /// As [`streamed`](Self::streamed), or no tag.
    fn buffered<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error>;
}

/// Reads an object whose member [`Tagged::TAG`] names the variant.
///
/// # Errors
/// Anything but such an object.
pub fn read<'de, T: Tagged<'de>, D: Deserializer<'de>>(deserializer: D) -> Result<T, D::Error> {
    deserializer.deserialize_struct("object", T::FIRST, ObjectVisitor(PhantomData))
}

struct ObjectVisitor<T>(PhantomData<T>);

impl<'de, T: Tagged<'de>> Visitor<'de> for ObjectVisitor<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "an object with `{}`", T::TAG)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut object: A) -> Result<T, A::Error> {
        match object.next_key::<String>()? {
            Some(key) if key == T::TAG => T::streamed(EnumAccessDeserializer::new(AtTag(object))),
            key => T::buffered(MapAccessDeserializer::new(Unread { key, rest: object })),
        }
    }
}

/// An object of which the key of the tag was read.
struct AtTag<A>(A);

impl<'de, A: MapAccess<'de>> EnumAccess<'de> for AtTag<A> {
    type Error = A::Error;
    type Variant = Self;

    fn variant_seed<V: DeserializeSeed<'de>>(mut self, seed: V) -> Result<(V::Value, Self), A::Error> {
        Ok((self.0.next_value_seed(seed)?, self))
    }
}

/// The members after the tag.
impl<'de, A: MapAccess<'de>> VariantAccess<'de> for AtTag<A> {
    type Error = A::Error;

    fn unit_variant(mut self) -> Result<(), A::Error> {
        match self.0.next_key::<String>()? {
            None => Ok(()),
            Some(key) => self.0.next_value_seed(Refused(&key)).map(|never| match never {}),
        }
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, A::Error> {
        seed.deserialize(MapAccessDeserializer::new(self.0))
    }

    fn tuple_variant<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, A::Error> {
        visitor.visit_map(self.0)
    }

    fn struct_variant<V: Visitor<'de>>(self, _: &'static [&'static str], visitor: V) -> Result<V::Value, A::Error> {
        visitor.visit_map(self.0)
    }
}

/// The value of a member that is not known: it is refused in its own place, which gives the error its path.
struct Refused<'a>(&'a str);

impl<'de> DeserializeSeed<'de> for Refused<'_> {
    type Value = Infallible;

    fn deserialize<D: Deserializer<'de>>(self, _: D) -> Result<Infallible, D::Error> {
        Err(D::Error::custom(format_args!("unknown field `{}`, there are no fields", self.0)))
    }
}

/// An object whose first key was read and is given once more.
struct Unread<A> {
    key: Option<String>,
    rest: A,
}

impl<'de, A: MapAccess<'de>> MapAccess<'de> for Unread<A> {
    type Error = A::Error;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, A::Error> {
        match self.key.take() {
            Some(key) => seed.deserialize(key.into_deserializer()).map(Some),
            None => self.rest.next_key_seed(seed),
        }
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, A::Error> {
        self.rest.next_value_seed(seed)
    }
}

/// Declares an enum with `#[serde(tag = ..)]` and implements `Deserialize` for it; everything else is derived as written.
#[macro_export]
macro_rules! tagged {
    (
        $(#[doc = $doc:tt])+
        #[derive($($derive:ident),+)]
        $(#[cfg_attr($($conditional:tt)+)])?
        #[serde(tag = $tag:tt $(, $rule:ident $(= $value:tt)?)*)]
        pub enum $name:ident { $($variants:tt)* }
    ) => {
        $(#[doc = $doc])+
        #[derive($($derive),+)]
        $(#[cfg_attr($($conditional)+)])?
        #[serde(tag = $tag $(, $rule $(= $value)?)*)]
        pub enum $name { $($variants)* }

        const _: () = {
            type Declared = $name;

            #[derive(serde::Deserialize)]
            #[serde(remote = "Declared" $(, $rule $(= $value)?)*)]
            enum Streamed { $($variants)* }

            #[derive(serde::Deserialize)]
            #[serde(remote = "Declared", tag = $tag $(, $rule $(= $value)?)*)]
            enum Buffered { $($variants)* }

            impl<'de> $crate::tagged::Tagged<'de> for $name {
                const TAG: &'static str = $tag;

                fn streamed<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                    Streamed::deserialize(deserializer)
                }

                fn buffered<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                    Buffered::deserialize(deserializer)
                }
            }

            impl<'de> serde::Deserialize<'de> for $name {
                fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                    $crate::tagged::read(deserializer)
                }
            }
        };
    };
}

#[cfg(test)]
mod tests {
    use serde::{Deserialize, Serialize};

    tagged! {
        /// An animal of this test.
        #[derive(Debug, PartialEq, Serialize)]
        #[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
        pub enum Animal {
            /// Nothing to say about it.
            Fish,
            /// Its legs.
            Dog {
                /// Number of legs.
                #[serde(default = "four")]
                legs: u8,
            },
            /// Its wings.
            Bird(Wings),
        }
    }

    /// Wings of a bird.
    #[derive(Debug, PartialEq, Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct Wings {
        /// Span of each wing, m.
        spans_m: [f64; 2],
    }

    fn four() -> u8 {
        4
    }

    fn read(json: &str) -> Result<Animal, String> {
        serde_json::from_str(json).map_err(|error| error.to_string())
    }

    #[test]
    fn a_tag_may_stand_anywhere() {
        for json in [r#"{"kind": "dog", "legs": 3}"#, r#"{"legs": 3, "kind": "dog"}"#] {
            assert_eq!(read(json), Ok(Animal::Dog { legs: 3 }));
        }
        assert_eq!(read(r#"{"kind": "dog"}"#), Ok(Animal::Dog { legs: 4 }));
        assert_eq!(read(r#"{"kind": "fish"}"#), Ok(Animal::Fish));
        let bird = Animal::Bird(Wings { spans_m: [0.5, 0.25] });
        assert_eq!(read(&serde_json::to_string(&bird).unwrap()), Ok(bird));
        assert_eq!(toml::from_str::<Animal>("legs = 3\nkind = \"dog\"").unwrap(), Animal::Dog { legs: 3 });
    }

    #[test]
    fn what_does_not_fit_is_named() {
        for (json, named) in [
            ("3", "an object with `kind`"),
            ("{}", "missing field `kind`"),
            (r#"{"legs": 3}"#, "missing field `kind`"),
            (r#"{"kind": "cat"}"#, "unknown variant `cat`, expected one of `fish`, `dog`, `bird`"),
            (r#"{"kind": "dog", "legs": 300}"#, "300"),
            (r#"{"legs": 300, "kind": "dog"}"#, "300"),
            (r#"{"kind": "dog", "tails": 1}"#, "unknown field `tails`"),
            (r#"{"kind": "fish", "legs": 1}"#, "unknown field `legs`"),
            (r#"{"kind": "bird"}"#, "missing field `spans_m`"),
            (r#"{"kind": "bird", "spans_m": [1, 2], "legs": 2}"#, "unknown field `legs`"),
        ] {
            let error = read(json).unwrap_err();
            assert!(error.contains(named), "{json}: {error}");
        }
    }
}
