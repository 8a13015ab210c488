//! The problems with which each operation can answer, by status.
//!
//! Most follow from the operation's parameters: one with a body can reject the body, one with an id may not find it.
//! Statuses with a reason of their own (mostly 409) are written beside the handler.

use super::super::error::of_status;
use super::super::problem::{CONTENT_TYPE_PROBLEM, Problem};
use super::schemas::reference;
use crate::app::model::{AppError, ErrorKind, FieldError, limits};
use axum::http::StatusCode;
use serde_json::{Value, json};

/// The request id of the examples.
const REQUEST_ID: &str = "7f1c9a3e5b2d4860a1c3e5f708192a3b";

/// Operations that take a body and write nothing.
const READING: [&str; 2] = ["recognize", "validateJob"];

/// A problem that many operations have in common: name of its component, description, example.
struct Common {
    name: &'static str,
    description: &'static str,
    example: Problem,
}

impl Common {
    fn new(name: &'static str, description: &'static str, example: impl Into<Problem>) -> Self {
        Self { name, description, example: example.into() }
    }
}

fn common() -> [Common; 12] {
    let no_token = "send the token that `cgda serve` printed as `authorization: Bearer TOKEN`";
    let forbidden = "a request with the session cookie must come from this server's own pages";
    let page_size = format!("page_size is 0: give {}", limits::in_words(&limits::PAGE_SIZE));
    let repetitions = format!("repetitions is 0: give {}", limits::in_words(&limits::REPETITIONS));
    let repetitions = FieldError::new("/repetitions", "out_of_range", repetitions);
    let revision = "dem_0193c5a1f2b87c3d9e4f5a6b7c8d9e0f has revision 2, not 1";
    let disk = "no space is left to write: nothing was changed; free space on the disk of the data directory";
    let error = |kind, code, message: &str| AppError::new(kind, code, message);
    [
        Common::new(
            "Malformed",
            "The request cannot be read: its JSON, a header or a parameter of its query.",
            error(ErrorKind::Malformed, "invalid_query", &page_size),
        ),
        Common::new(
            "Unauthenticated",
            "No valid credentials were sent.",
            error(ErrorKind::Unauthenticated, "unauthenticated", no_token),
        ),
        Common::new(
            "Forbidden",
            "The credentials do not allow it, or a cookie was sent from another site's page.",
            error(ErrorKind::Forbidden, "cross_origin", forbidden),
        ),
        Common::new(
            "NotFound",
            "There is no such resource.",
            AppError::not_found("job", "job_0193c5a1f2b87c3d9e4f5a6b7c8d9e0f"),
        ),
        Common::new(
            "RequestTimeout",
            "The response took longer than the limit.",
            of_status(StatusCode::REQUEST_TIMEOUT),
        ),
        Common::new(
            "Precondition",
            "`If-Match` does not name the current revision: read the resource again.",
            error(ErrorKind::Precondition, "revision_mismatch", revision),
        ),
        Common::new("TooLarge", "The body is larger than the limit.", of_status(StatusCode::PAYLOAD_TOO_LARGE)),
        Common::new(
            "UnsupportedMediaType",
            "This operation does not read the body's content type or encoding.",
            of_status(StatusCode::UNSUPPORTED_MEDIA_TYPE),
        ),
        Common::new(
            "Invalid",
            "The request is well-formed but invalid; `errors` lists the places.",
            AppError::invalid(vec![repetitions]),
        ),
        Common::new("Internal", "The service failed; its log has the cause.", AppError::internal("database")),
        Common::new(
            "Unavailable",
            "The service cannot answer now: retry after `Retry-After` seconds.",
            AppError::unavailable("store_unavailable", "the store does not answer"),
        ),
        Common::new(
            "StorageFull",
            "The disk is full: nothing was written; reading still works.",
            error(ErrorKind::StorageFull, "storage_full", disk),
        ),
    ]
}

/// Adds every operation's problems and the components they refer to.
pub fn add(document: &mut Value) {
    let common = common();
    let Some(paths) = document["paths"].as_object_mut() else { return };
    for (path, item) in paths {
        for (method, operation) in item.as_object_mut().into_iter().flatten() {
            let names = names(path, method, operation);
            let Some(responses) = operation["responses"].as_object_mut() else { continue };
            let own = responses.iter_mut().filter(|(status, _)| status.starts_with(['4', '5']));
            own.for_each(|(_, response)| response["content"] = content(None));
            for row in common.iter().filter(|row| names.contains(&row.name)) {
                let reference = json!({"$ref": format!("#/components/responses/{}", row.name)});
                responses.entry(row.example.status.as_str()).or_insert(reference);
            }
            responses.insert("default".to_owned(), json!({"$ref": "#/components/responses/Problem"}));
        }
    }
    let responses = common.iter().map(|row| {
        let example = json!(row.example.details(REQUEST_ID));
        (row.name.to_owned(), json!({"description": row.description, "content": content(Some(example))}))
    });
    let any = json!({"description": "Any other error, as a problem.", "content": content(None)});
    document["components"]["responses"] = responses.chain([("Problem".to_owned(), any)]).collect();
}

/// The common problems of an operation, derived from its method, parameters and body.
fn names(path: &str, method: &str, operation: &Value) -> Vec<&'static str> {
    let mut names = vec![];
    if !path.starts_with(super::super::API) {
        return names;
    }
    names.extend(["Unauthenticated", "Forbidden", "RequestTimeout", "Internal", "Unavailable"]);
    let parameters = operation["parameters"].as_array().map(Vec::as_slice).unwrap_or_default();
    let has = |key: &str, value: &str| parameters.iter().any(|parameter| parameter[key] == value);
    if has("in", "path") {
        names.push("NotFound");
    }
    if has("in", "query") {
        names.push("Malformed");
    }
    if has("name", "If-Match") {
        names.push("Precondition");
    }
    if has("name", "Idempotency-Key") {
        names.extend(["Malformed", "Invalid"]);
    }
    if operation.get("requestBody").is_some() {
        names.extend(["Malformed", "TooLarge", "UnsupportedMediaType", "Invalid"]);
    }
    let reads = method == "get" || READING.iter().any(|id| operation["operationId"] == *id);
    if !reads {
        names.push("StorageFull");
    }
    names
}

fn content(example: Option<Value>) -> Value {
    let schema = reference("ProblemDetails");
    match example {
        Some(example) => json!({CONTENT_TYPE_PROBLEM: {"schema": schema, "example": example}}),
        None => json!({CONTENT_TYPE_PROBLEM: {"schema": schema}}),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn operation(document: &Value, path: &str, method: &str) -> Vec<String> {
        document["paths"][path][method]["responses"].as_object().unwrap().keys().cloned().collect()
    }

    #[test]
    fn an_operation_lists_the_problems_it_can_answer() {
        let document = super::super::super::document();
        let statuses = operation(&document, "/api/v1/jobs", "post");
        assert_eq!(statuses, ["202", "400", "401", "403", "408", "413", "415", "422", "500", "503", "507", "default"]);
        let statuses = operation(&document, "/api/v1/jobs/{id}:pause", "post");
        assert_eq!(statuses, ["200", "401", "403", "404", "408", "409", "500", "503", "507", "default"]);
        let statuses = operation(&document, "/livez", "get");
        assert_eq!(statuses, ["200", "default"]);
    }

    #[test]
    fn every_common_problem_is_answered_by_some_operation_and_keeps_its_status() {
        let document = super::super::super::document();
        let text = document["paths"].to_string();
        for row in common() {
            assert!(text.contains(&format!("#/components/responses/{}\"", row.name)), "{}", row.name);
            let media = &document["components"]["responses"][row.name]["content"][CONTENT_TYPE_PROBLEM];
            assert_eq!(media["example"]["status"], row.example.status.as_u16(), "{}", row.name);
        }
    }
}
