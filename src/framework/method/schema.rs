//! Schemas of how users write a method, for descriptions of an API.

use super::catalogue::MethodSpec;
use utoipa::openapi::RefOr;
use utoipa::openapi::schema::{ObjectBuilder, Schema, Type};
use utoipa::{PartialSchema, ToSchema};

/// A method as users write it: its name alone, for its defaults, or an object with its parameters.
#[derive(ToSchema)]
#[schema(as = MethodChoice)]
#[serde(untagged)]
pub enum MethodChoice {
    /// A method by its name, for example `model`.
    Name(MethodName),
    /// A method with its parameters.
    Method(MethodSpec),
}

/// The name of a method of the catalogue.
pub struct MethodName;

impl PartialSchema for MethodName {
    fn schema() -> RefOr<Schema> {
        let names = ObjectBuilder::new().schema_type(Type::String).enum_values(Some(MethodSpec::NAMES));
        names.description(Some("The name of a method.")).into()
    }
}

impl ToSchema for MethodName {}
