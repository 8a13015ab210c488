//! Extractors whose rejections are problems: axum's own answer in plain text.

use super::problem::Problem;
use super::{Settings, body, strict};
use crate::app::model::{AppError, ErrorKind};
use crate::app::shape;
use axum::extract::{FromRef, FromRequest, FromRequestParts, Request};
use axum::http::header::{CONTENT_TYPE, IF_MATCH};
use axum::http::request::Parts;
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt::Write as _;
use std::sync::Arc;

/// A JSON body, in or out.
#[derive(Debug)]
pub struct Json<T>(pub T);

impl<S: Send + Sync, T: DeserializeOwned + Serialize> FromRequest<S> for Json<T>
where
    Arc<Settings>: FromRef<S>,
{
    type Rejection = Problem;

    async fn from_request(request: Request, state: &S) -> Result<Self, Problem> {
        let media_type = request.headers().get(CONTENT_TYPE).and_then(|value| value.to_str().ok()).unwrap_or("");
        if !is_json(media_type) {
            return Err(unsupported(media_type, "application/json"));
        }
        let limit = Arc::<Settings>::from_ref(state).body_limit_bytes;
        let bytes = body::read(request, limit).await?;
        parse(&bytes).map(Self).map_err(Problem::from)
    }
}

impl<T: Serialize> IntoResponse for Json<T> {
    fn into_response(self) -> Response {
        axum::Json(self.0).into_response()
    }
}

/// Path parameters; an id that can be nobody's is not found like one that is nobody's.
#[derive(Debug)]
pub struct Path<T>(pub T);

impl<S: Send + Sync, T: DeserializeOwned + Send> FromRequestParts<S> for Path<T> {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        match axum::extract::Path::from_request_parts(parts, state).await {
            Ok(axum::extract::Path(value)) => Ok(Self(value)),
            Err(rejection) => {
                let message = format!("there is nothing at this address: {}", rejection.body_text());
                Err(AppError::new(ErrorKind::NotFound, "not_found", message).into())
            }
        }
    }
}

/// Query parameters.
#[derive(Debug)]
pub struct Query<T>(pub T);

impl<S: Send + Sync, T: DeserializeOwned> FromRequestParts<S> for Query<T> {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        match axum::extract::Query::from_request_parts(parts, state).await {
            Ok(axum::extract::Query(value)) => Ok(Self(value)),
            Err(rejection) => Err(AppError::new(ErrorKind::Malformed, "invalid_query", rejection.body_text()).into()),
        }
    }
}

/// The `Idempotency-Key` header: the same key and request give the same resource.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct IdempotencyKey(pub Option<String>);

impl<S: Send + Sync> FromRequestParts<S> for IdempotencyKey {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Problem> {
        let Some(value) = parts.headers.get("idempotency-key") else { return Ok(Self(None)) };
        let key = value.to_str().ok().filter(|key| !key.is_empty() && key.len() <= 128);
        let refuse = || {
            let message = "the Idempotency-Key header must hold 1 to 128 visible ASCII characters";
            Problem::from(AppError::new(ErrorKind::Malformed, "invalid_idempotency_key", message))
        };
        key.map(|key| Self(Some(key.to_owned()))).ok_or_else(refuse)
    }
}

/// The `If-Match` header: the revision a change is meant for; absent or `*` is any.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct IfMatch(pub Option<u64>);

impl<S: Send + Sync> FromRequestParts<S> for IfMatch {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Problem> {
        let Some(value) = parts.headers.get(IF_MATCH) else { return Ok(Self(None)) };
        let tag = value.to_str().unwrap_or("").trim();
        let revision = tag.strip_prefix('"').and_then(|t| t.strip_suffix('"')).and_then(|t| t.parse().ok());
        match revision {
            Some(revision) => Ok(Self(Some(revision))),
            None if tag == "*" => Ok(Self(None)),
            None => {
                let message = format!("If-Match {tag:?} is no ETag this resource ever had: read it again");
                Err(AppError::new(ErrorKind::Precondition, "revision_mismatch", message).into())
            }
        }
    }
}

/// The problem of a content type this address does not read.
pub fn unsupported(found: &str, expected: &str) -> Problem {
    let message = format!("content type is {found:?}: send {expected}");
    let error = AppError::new(ErrorKind::Malformed, "unsupported_media_type", message);
    Problem { status: axum::http::StatusCode::UNSUPPORTED_MEDIA_TYPE, error }
}

fn is_json(media_type: &str) -> bool {
    let essence = media_type.split(';').next().unwrap_or("").trim().to_ascii_lowercase();
    essence == "application/json" || (essence.starts_with("application/") && essence.ends_with("+json"))
}

fn parse<T: DeserializeOwned + Serialize>(bytes: &[u8]) -> Result<T, AppError> {
    strict::check(bytes).map_err(|(path, error)| refusal(pointer(&path), &error))?;
    let mut json = serde_json::Deserializer::from_slice(bytes);
    let value = serde_path_to_error::deserialize(&mut json).map_err(|error| {
        let pointer = pointer(error.path());
        refusal(pointer, error.inner())
    })?;
    json.end().map_err(|error| refusal(String::new(), &error))?;
    let sent = serde_json::from_slice(bytes).map_err(|error| refusal(String::new(), &error))?;
    shape::check("", &sent, &serde_json::to_value(&value).map_err(AppError::internal)?)?;
    Ok(value)
}

/// Text that is no JSON is malformed; JSON of another shape is invalid, at its place.
fn refusal(pointer: String, error: &serde_json::Error) -> AppError {
    match error.classify() {
        serde_json::error::Category::Data => AppError::field(pointer, "invalid_value", error.to_string()),
        _ => AppError::new(ErrorKind::Malformed, "invalid_json", format!("the body is no JSON: {error}")),
    }
}

/// RFC 6901.
fn pointer(path: &serde_path_to_error::Path) -> String {
    use serde_path_to_error::Segment;
    path.iter().fold(String::new(), |mut pointer, segment| {
        let written = match segment {
            Segment::Seq { index } => write!(pointer, "/{index}"),
            Segment::Map { key } => write!(pointer, "/{}", key.replace('~', "~0").replace('/', "~1")),
            Segment::Enum { .. } | Segment::Unknown => Ok(()),
        };
        debug_assert!(written.is_ok(), "writing to a string cannot fail");
        pointer
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
        parse::<serde_json::Value>(nested(strict::MAX_DEPTH - 1).as_bytes()).unwrap();
        assert!(place(&nested(strict::MAX_DEPTH)).starts_with("/a/0/0"));
        assert!(place(&nested(100_000)).starts_with("/a/0/0"));
    }

    #[test]
    fn content_types() {
        assert!(is_json("application/json; charset=utf-8") && is_json("application/merge-patch+json"));
        assert!(!is_json("text/csv") && !is_json(""));
    }
}
