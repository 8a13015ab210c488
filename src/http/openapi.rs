//! The OpenAPI 3.1 document, made of the router: what is not in the table is neither served nor documented.

use super::problem::{CONTENT_TYPE_PROBLEM, ProblemDetails};
use super::verbs;
use utoipa::openapi::path::PathItem;
use utoipa::openapi::schema::{Schema, SchemaType};
use utoipa::openapi::security::{ApiKey, ApiKeyValue, Http, HttpAuthScheme, SecurityScheme};
use utoipa::openapi::{ContentBuilder, OpenApi, Ref, RefOr, Response, ResponseBuilder, schema};
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
        (name = "demonstrations", description = "Recorded showings of an action."),
        (name = "actions", description = "Demonstrations generalized into goals; versions are immutable."),
        (name = "recognitions", description = "Which action an observation looks like."),
        (name = "robots", description = "A URDF and the part of it that moves; versions are immutable."),
        (name = "worlds", description = "Where effects happen."),
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

/// A router that starts with what no route says of itself.
#[must_use]
pub fn start<S: Clone + Send + Sync + 'static>() -> OpenApiRouter<S> {
    OpenApiRouter::with_openapi(Document::openapi())
}

/// Rows of the URL table.
pub trait Table<S> {
    /// Adds the routes of one path, documented as they are and, if they end in `:verb`, routed as `verbs.rs` says.
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

/// Adds to every operation the answer all of them have in common.
#[must_use]
pub fn finish(mut document: OpenApi) -> OpenApi {
    for item in document.paths.paths.values_mut() {
        for operation in operations(item) {
            operation.responses.responses.entry("default".to_owned()).or_insert_with(|| RefOr::T(problem()));
        }
    }
    open_extended(&mut document);
    document
}

/// A schema that refuses unknown properties cannot be part of an `allOf` that adds one (the tag of a union): the
/// document would allow nothing at all. Such parts are documented open; the service still refuses unknown fields.
fn open_extended(document: &mut OpenApi) {
    let Some(components) = &mut document.components else { return };
    let unions = components.schemas.values().filter_map(|schema| match schema {
        RefOr::T(Schema::OneOf(union)) => Some(&union.items),
        _ => None,
    });
    let parts = unions.flatten().filter_map(|variant| match variant {
        RefOr::T(Schema::AllOf(all)) => Some(&all.items),
        _ => None,
    });
    let names = parts.flatten().filter_map(|part| match part {
        RefOr::Ref(reference) => reference.ref_location.rsplit('/').next().map(str::to_owned),
        RefOr::T(_) => None,
    });
    for name in names.collect::<Vec<_>>() {
        if let Some(RefOr::T(Schema::Object(object))) = components.schemas.get_mut(&name) {
            object.additional_properties = None;
        }
    }
}

fn operations(item: &mut PathItem) -> impl Iterator<Item = &mut utoipa::openapi::path::Operation> {
    [&mut item.get, &mut item.post, &mut item.put, &mut item.patch, &mut item.delete].into_iter().flatten()
}

fn problem() -> Response {
    let content = ContentBuilder::new().schema(Some(Ref::from_schema_name("ProblemDetails"))).build();
    ResponseBuilder::new().description("Any error, as a problem.").content(CONTENT_TYPE_PROBLEM, content).build()
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
    fn the_variants_of_a_union_allow_their_tag() {
        let text = super::super::document_json();
        let document: serde_json::Value = serde_json::from_str(&text).unwrap();
        let schemas = &document["components"]["schemas"];
        assert_eq!(schemas["CreateWorld"]["additionalProperties"], false);
        for name in ["CreateJob", "WorldSpec", "MethodSpec"] {
            let variants = schemas[name]["oneOf"].as_array().unwrap();
            let references = variants.iter().map(|variant| variant["allOf"][0]["$ref"].as_str().unwrap());
            for part in references.map(|reference| reference.rsplit('/').next().unwrap()) {
                assert_eq!(schemas[part]["type"], "object", "{name}: {part}");
                assert!(schemas[part]["additionalProperties"].is_null(), "{name}: {part}");
            }
        }
    }

    #[test]
    fn every_operation_has_an_own_id_a_known_tag_and_described_responses() {
        let mut document = super::super::document();
        let tags: BTreeSet<String> =
            document.tags.clone().unwrap_or_default().into_iter().map(|tag| tag.name).collect();
        let mut ids = BTreeSet::new();
        for (path, item) in &mut document.paths.paths {
            for operation in operations(item) {
                let id = operation.operation_id.clone().unwrap_or_default();
                assert!(!id.is_empty() && ids.insert(id.clone()), "{path}: operation id {id:?}");
                let own = operation.tags.clone().unwrap_or_default();
                assert!(own.len() == 1 && tags.contains(&own[0]), "{path}: tags {own:?}");
                for (status, response) in &operation.responses.responses {
                    let RefOr::T(response) = response else { continue };
                    assert!(!response.description.is_empty(), "{path} {id} {status}: no description");
                }
            }
        }
        assert!(ids.len() > 20, "{ids:?}");
    }
}
