//! The OpenAPI 3.1 document, derived from the router: only what stands in the URL table is served and documented.
//!
//! The handlers and their types describe themselves; [`finish`] adds what client generators need and can be derived:
//! names for the variants of unions, bounds, the problems of each operation, examples.

mod bounds;
mod examples;
mod problems;
mod schemas;
mod unions;

use super::problem::ProblemDetails;
use super::verbs;
use serde_json::Value;
use utoipa::openapi::schema::{Schema, SchemaType};
use utoipa::openapi::security::{ApiKey, ApiKeyValue, Http, HttpAuthScheme, SecurityScheme};
use utoipa::openapi::{OpenApi, RefOr, schema};
use utoipa::{Modify, OpenApi as _};
use utoipa_axum::router::{OpenApiRouter, UtoipaMethodRouter};

/// The command that renews the snapshot the dashboard's client is generated from.
pub const RENEW: &str = "cargo run --quiet -- openapi > web/openapi.json";

#[derive(utoipa::OpenApi)]
#[openapi(
    info(
        title = "cgda",
        description = "Teach robots by showing effects: Continuous Goal-Directed Actions as a service. \
                       Every error is a problem (RFC 9457) with a stable `code`. Units stand in the names; radians."
    ),
    components(schemas(ProblemDetails)),
    security(("token" = []), ("session" = [])),
    tags(
        (name = "demonstrations", description = "Recorded performances of an action."),
        (name = "actions", description = "Demonstrations generalized into goals; versions are immutable."),
        (name = "recognitions", description = "Which action an observation looks like."),
        (name = "robots", description = "URDFs with their moving chains; versions are immutable."),
        (name = "worlds", description = "Simulations of the effects."),
        (name = "methods", description = "The methods with which a job can search."),
        (name = "jobs", description = "Durable work with live progress."),
        (name = "experiments", description = "Many runs of many settings, compared."),
        (name = "runs", description = "Finished repetitions of execution jobs."),
        (name = "trajectories", description = "Checked joint trajectories."),
        (name = "service", description = "The service itself.")
    ),
    modifiers(&Security)
)]
struct Document;

struct Security;

impl Modify for Security {
    fn modify(&self, document: &mut OpenApi) {
        let components = document.components.get_or_insert_default();
        components.add_security_scheme("token", SecurityScheme::Http(Http::new(HttpAuthScheme::Bearer)));
        let cookie = ApiKeyValue::new("cgda_session");
        components.add_security_scheme("session", SecurityScheme::ApiKey(ApiKey::Cookie(cookie)));
    }
}

/// An empty router with the general part of the document.
#[must_use]
pub fn start<S: Clone + Send + Sync + 'static>() -> OpenApiRouter<S> {
    OpenApiRouter::with_openapi(Document::openapi())
}

/// Rows of the URL table.
pub trait Table<S> {
    /// Adds the routes of one path to router and document; a path that ends in `:verb` is routed as in `verbs.rs`.
    #[must_use]
    fn at(self, routes: UtoipaMethodRouter<S>) -> Self;
}

impl<S: Clone + Send + Sync + 'static> Table<S> for OpenApiRouter<S> {
    fn at(mut self, (schemas, paths, methods): UtoipaMethodRouter<S>) -> Self {
        for path in paths.paths.keys() {
            self = self.route(&verbs::internal(path), methods.clone());
        }
        let document = self.get_openapi_mut();
        document.paths.merge(paths);
        document.components.get_or_insert_default().schemas.extend(schemas);
        self
    }
}

/// The document as it is served.
#[must_use]
pub fn finish(document: &OpenApi) -> Value {
    let mut document = serde_json::to_value(document).unwrap_or_default();
    if let Some(schemas) = document["components"]["schemas"].as_object_mut() {
        bounds::add_to_schemas(schemas);
        unions::name_variants(schemas);
    }
    schemas::rename_pages(&mut document);
    bounds::add_to_parameters(&mut document);
    problems::add(&mut document);
    examples::add(&mut document);
    schemas::remove_unused(&mut document);
    document
}

/// The schema of a file's bytes.
pub struct Binary;

impl utoipa::PartialSchema for Binary {
    fn schema() -> RefOr<Schema> {
        schema::ObjectBuilder::new()
            .schema_type(SchemaType::Type(schema::Type::String))
            .format(Some(schema::SchemaFormat::KnownFormat(schema::KnownFormat::Binary)))
            .build()
            .into()
    }
}

impl utoipa::ToSchema for Binary {}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn the_snapshot_is_fresh() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/web/openapi.json");
        let kept = std::fs::read_to_string(path).unwrap_or_default();
        assert!(kept == super::super::document_json(), "web/openapi.json is stale: renew it with `{RENEW}`");
    }

    #[test]
    fn every_variant_of_a_union_is_a_component() {
        fn check(place: &str, value: &Value) {
            for (key, value) in value.as_object().into_iter().flatten() {
                check(&format!("{place}/{key}"), value);
            }
            for (index, value) in value.as_array().into_iter().flatten().enumerate() {
                check(&format!("{place}/{index}"), value);
            }
            for variant in value["oneOf"].as_array().into_iter().flatten() {
                let named = variant.get("$ref").is_some() || variant["type"] == "null";
                assert!(named, "{place}: {variant} has no name");
            }
            assert!(value.get("allOf").is_none(), "{place}: not one object");
        }
        let document = super::super::document();
        check("", &document);
        let schemas = document["components"]["schemas"].as_object().unwrap();
        for (union, tag) in [("CreateJob", "kind"), ("WorldSpec", "kind"), ("MethodSpec", "name"), ("JobEvent", "type")]
        {
            assert_eq!(schemas[union]["discriminator"]["propertyName"], tag, "{union}");
        }
        assert!(schemas.keys().all(|name| !name.contains('_')), "{:?}", schemas.keys());
    }

    /// The schema of a bare name and the catalogue.
    #[test]
    fn a_method_is_named_as_in_the_catalogue() {
        let document = super::super::document();
        let names = document["components"]["schemas"]["MethodName"]["enum"].as_array().unwrap();
        let catalogue = crate::framework::method::catalogue();
        assert_eq!(*names, catalogue.iter().map(|entry| Value::from(entry.name)).collect::<Vec<_>>());
    }

    #[test]
    fn every_operation_has_an_own_id_a_known_tag_and_described_responses() {
        let document = super::super::document();
        let tags: BTreeSet<&str> =
            document["tags"].as_array().unwrap().iter().map(|tag| tag["name"].as_str().unwrap()).collect();
        let mut ids = BTreeSet::new();
        for (path, item) in document["paths"].as_object().unwrap() {
            for operation in item.as_object().unwrap().values() {
                let id = operation["operationId"].as_str().unwrap_or_default();
                assert!(!id.is_empty() && ids.insert(id), "{path}: operation id {id:?}");
                let own = operation["tags"].as_array().unwrap();
                assert!(own.len() == 1 && tags.contains(own[0].as_str().unwrap()), "{path}: tags {own:?}");
                for (status, response) in operation["responses"].as_object().unwrap() {
                    let described = response["description"].as_str().is_some_and(|text| !text.is_empty());
                    assert!(described || response.get("$ref").is_some(), "{path} {id} {status}: no description");
                }
            }
        }
        assert!(ids.len() > 20, "{ids:?}");
    }
}
