//! `/jobs/{id}:pause`: custom methods as in the Google AIPs.
//!
//! The router matches whole segments only, so `…/SEGMENT:verb` is rewritten to `…/SEGMENT/@verb` before routing and
//! registered in that form; documentation and clients only see the colon. A request whose own path contains `/@`
//! answers 404.

use axum::extract::Request;
use axum::http::Uri;
use axum::http::uri::PathAndQuery;

/// The router's form of a documented path.
#[must_use]
pub fn internal(documented: &str) -> String {
    documented.replacen(':', "/@", 1)
}

/// Rewrites the path of a request below the API.
#[must_use]
pub fn rewrite(mut request: Request) -> Request {
    if let Some(uri) = rewritten(request.uri()) {
        *request.uri_mut() = uri;
    }
    request
}

fn rewritten(uri: &Uri) -> Option<Uri> {
    let path = uri.path();
    if !path.starts_with(super::API) {
        return None;
    }
    let target = if path.contains("/@") {
        path.replace("/@", "/%40")
    } else {
        let start = path.rfind('/')? + 1;
        let (id, verb) = path[start..].rsplit_once(':')?;
        let known = !id.is_empty() && !verb.is_empty() && verb.bytes().all(|b| b.is_ascii_alphabetic());
        known.then(|| format!("{}{id}/@{verb}", &path[..start]))?
    };
    let target = match uri.query() {
        Some(query) => format!("{target}?{query}"),
        None => target,
    };
    let mut parts = uri.clone().into_parts();
    parts.path_and_query = Some(PathAndQuery::try_from(target).ok()?);
    Uri::from_parts(parts).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn documented_paths_and_requests_meet() {
        for (documented, request) in [
            ("/jobs/{id}:pause", "/api/v1/jobs/job_1:pause?x=1"),
            ("/actions:selectFeatures", "/api/v1/actions:selectFeatures"),
        ] {
            let uri = rewritten(&request.parse().unwrap()).unwrap();
            let concrete = internal(documented).replace("{id}", "job_1");
            assert_eq!(uri.path(), format!("/api/v1{concrete}"));
            assert_eq!(uri.query().is_some(), request.contains('?'));
        }
    }

    #[test]
    fn other_paths_stay_and_the_inner_form_is_unreachable() {
        assert_eq!(rewritten(&"/api/v1/jobs/1".parse().unwrap()), None);
        assert_eq!(rewritten(&"/assets/a:b".parse().unwrap()), None);
        assert_eq!(rewritten(&"/api/v1/jobs/1/@pause".parse().unwrap()).unwrap().path(), "/api/v1/jobs/1/%40pause");
    }
}
