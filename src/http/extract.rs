//! Extractors that reject with a problem; those of axum reject with plain text.

use super::problem::Problem;
use super::{Settings, body};
use crate::app::model::{AppError, ErrorKind};
use crate::app::strict_json;
use crate::app::{App, Caller, UseCases};
use axum::extract::{FromRef, FromRequest, FromRequestParts, Request};
use axum::http::header::{CONTENT_TYPE, IF_MATCH};
use axum::http::request::Parts;
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::sync::Arc;

/// A JSON body, of a request or of a response.
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
        strict_json::parse(&bytes).map(Self).map_err(Problem::from)
    }
}

impl<T: Serialize> IntoResponse for Json<T> {
    fn into_response(self) -> Response {
        axum::Json(self.0).into_response()
    }
}

/// The use-cases, on behalf of the caller that `auth.rs` admitted.
pub struct AsCaller(pub UseCases);

impl<S: Send + Sync> FromRequestParts<S> for AsCaller
where
    App: FromRef<S>,
{
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        let caller = parts.extensions.get::<Caller>();
        let caller = caller.ok_or_else(|| AppError::internal("a handler runs without authentication"))?;
        Ok(Self(App::from_ref(state).on_behalf_of(*caller)))
    }
}

/// Path parameters. A malformed id answers 404, exactly like an unknown one.
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
        let refuse = |_| {
            let message = "the Idempotency-Key header must consist of visible ASCII characters";
            Problem::from(AppError::new(ErrorKind::Malformed, "invalid_idempotency_key", message))
        };
        value.to_str().map(|key| Self(Some(key.to_owned()))).map_err(refuse)
    }
}

/// The `If-Match` header: the revision to change; `None` if it is absent or `*`, for any revision.
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
                let message = format!("If-Match {tag:?} is not an ETag of this resource: read the resource again");
                Err(AppError::new(ErrorKind::Precondition, "revision_mismatch", message).into())
            }
        }
    }
}

/// Problem for a content type that this address does not read.
pub fn unsupported(found: &str, expected: &str) -> Problem {
    let message = format!("content type is {found:?}: send {expected}");
    let error = AppError::new(ErrorKind::Malformed, "unsupported_media_type", message);
    Problem { status: axum::http::StatusCode::UNSUPPORTED_MEDIA_TYPE, error }
}

fn is_json(media_type: &str) -> bool {
    let essence = media_type.split(';').next().unwrap_or("").trim().to_ascii_lowercase();
    essence == "application/json" || (essence.starts_with("application/") && essence.ends_with("+json"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn content_types() {
        assert!(is_json("application/json; charset=utf-8") && is_json("application/merge-patch+json"));
        assert!(!is_json("text/csv") && !is_json(""));
    }
}
