//! The embedded dashboard: files of `web/dist`, and its single page for every path that its router handles.
//!
//! Architecture Invariants
//! - Answers GET and HEAD only; never below `/api`, never `application/grpc`, and a missing asset is never answered
//!   with the page.
//! - The page and its assets contain no data and need no token; all data comes from the REST API.
//! - Scripts and styles come from this server alone (content security policy): nothing inline, nothing external.
//!
//! Debug builds read `web/dist` from disk at each request; release builds embed it. Without it, a page explains how to
//! build.

use axum::body::Body;
use axum::http::{HeaderMap, HeaderName, HeaderValue, Method, Response, StatusCode, header};
use rust_embed::{EmbeddedFile, RustEmbed};

#[derive(RustEmbed)]
#[folder = "web/dist/"]
#[allow_missing = true]
struct Dashboard;

const PAGE: &str = "index.html";

/// Assets below this path have a hash of their content in their name.
const HASHED: &str = "assets/";

/// First path segments that belong to the APIs, whether or not a route exists there.
const INTERFACES: &[&str] = &["api", "docs", "openapi.json", "livez", "readyz", "metrics"];

const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; \
                      font-src 'self'; connect-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'self'; \
                      frame-ancestors 'none'";

const NOT_BUILT: &str = "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\">\
    <meta name=\"viewport\" content=\"width=device-width\"><meta name=\"color-scheme\" content=\"light dark\">\
    <title>cgda: dashboard not built</title></head><body><h1>The dashboard is not part of this build</h1>\
    <p>The server runs and its interfaces work. To have the dashboard, with node 20 or later:</p>\
    <pre>make web            # or: cd web &amp;&amp; npm ci &amp;&amp; npm run build</pre>\
    <p>A debug build then finds it at the next request; a release build has to be built again.</p></body></html>";

/// The dashboard's response to a request that no other route took; `None` if it is not the dashboard's to answer.
#[must_use]
pub fn respond(method: &Method, path: &str, headers: &HeaderMap) -> Option<Response<Body>> {
    let path = path.trim_start_matches('/');
    let is_read = *method == Method::GET || *method == Method::HEAD;
    let first_segment = path.split('/').next().unwrap_or_default();
    if !is_read || INTERFACES.contains(&first_segment) || is_grpc(headers) {
        return None;
    }
    if let Some(file) = Dashboard::get(path) {
        return Some(send(path, file, headers));
    }
    let last_segment = path.rsplit('/').next().unwrap_or_default();
    let is_page = !path.starts_with(HASHED) && !last_segment.contains('.') && accepts_html(headers);
    is_page.then(|| match Dashboard::get(PAGE) {
        Some(file) => send(PAGE, file, headers),
        None => not_built(),
    })
}

fn is_grpc(headers: &HeaderMap) -> bool {
    text(headers, &header::CONTENT_TYPE).starts_with("application/grpc")
}

fn accepts_html(headers: &HeaderMap) -> bool {
    let accepted = text(headers, &header::ACCEPT);
    accepted.is_empty() || accepted.contains("text/html") || accepted.contains("*/*")
}

fn text<'a>(headers: &'a HeaderMap, name: &HeaderName) -> &'a str {
    headers.get(name).and_then(|value| value.to_str().ok()).unwrap_or_default()
}

fn send(path: &str, file: EmbeddedFile, request: &HeaderMap) -> Response<Body> {
    let etag = format!("\"{}\"", hex::encode(&file.metadata.sha256_hash()[..16]));
    let known = text(request, &header::IF_NONE_MATCH).split(',').any(|tag| tag.trim().trim_start_matches("W/") == etag);
    let mut response = if known {
        let mut unchanged = Response::new(Body::empty());
        *unchanged.status_mut() = StatusCode::NOT_MODIFIED;
        unchanged
    } else {
        Response::new(Body::from(file.data.into_owned()))
    };
    let cache = if path.starts_with(HASHED) { "public, max-age=31536000, immutable" } else { "no-cache" };
    let headers = response.headers_mut();
    set(headers, header::CONTENT_TYPE, &content_type(&file.metadata));
    set(headers, header::CACHE_CONTROL, cache);
    set(headers, header::ETAG, &etag);
    protect(headers);
    response
}

fn content_type(metadata: &rust_embed::Metadata) -> String {
    let kind = metadata.mimetype();
    let is_text = kind.starts_with("text/") || kind.ends_with("/json");
    if is_text { format!("{kind}; charset=utf-8") } else { kind.to_owned() }
}

fn not_built() -> Response<Body> {
    let mut response = Response::new(Body::from(NOT_BUILT));
    *response.status_mut() = StatusCode::SERVICE_UNAVAILABLE;
    let headers = response.headers_mut();
    set(headers, header::CONTENT_TYPE, "text/html; charset=utf-8");
    set(headers, header::CACHE_CONTROL, "no-store");
    protect(headers);
    response
}

fn protect(headers: &mut HeaderMap) {
    set(headers, header::CONTENT_SECURITY_POLICY, POLICY);
    set(headers, header::X_CONTENT_TYPE_OPTIONS, "nosniff");
    set(headers, header::REFERRER_POLICY, "no-referrer");
    set(headers, HeaderName::from_static("cross-origin-opener-policy"), "same-origin");
}

fn set(headers: &mut HeaderMap, name: HeaderName, value: &str) {
    if let Ok(value) = HeaderValue::from_str(value) {
        headers.insert(name, value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn get(path: &str, headers: &[(HeaderName, &str)]) -> Option<Response<Body>> {
        let mut map = HeaderMap::new();
        for (name, value) in headers {
            set(&mut map, name.clone(), value);
        }
        respond(&Method::GET, path, &map)
    }

    fn header_of(response: &Response<Body>, name: &HeaderName) -> String {
        text(response.headers(), name).to_owned()
    }

    #[test]
    fn every_page_of_the_dashboard_is_the_one_page_with_its_policy() {
        for path in ["/", "/jobs", "/jobs/0193-a/replay"] {
            let page = get(path, &[(header::ACCEPT, "text/html")]).unwrap();
            assert!(header_of(&page, &header::CONTENT_TYPE).starts_with("text/html"));
            assert!(header_of(&page, &header::CONTENT_SECURITY_POLICY).contains("script-src 'self'"));
            assert!(!header_of(&page, &header::CACHE_CONTROL).contains("max-age"));
        }
    }

    #[test]
    fn the_interfaces_are_left_alone() {
        for path in ["/api/v1/nothing", "/api", "/metrics", "/openapi.json"] {
            assert!(get(path, &[(header::ACCEPT, "text/html")]).is_none(), "{path}");
        }
        assert!(get("/cgda.v1.JobService/Get", &[(header::CONTENT_TYPE, "application/grpc")]).is_none());
        assert!(respond(&Method::POST, "/jobs", &HeaderMap::new()).is_none());
    }

    #[test]
    fn a_missing_file_or_an_unreadable_answer_is_no_page() {
        assert!(get("/assets/main-0000.js", &[]).is_none());
        assert!(get("/robots.txt", &[]).is_none());
        assert!(get("/jobs", &[(header::ACCEPT, "application/json")]).is_none());
    }

    #[test]
    fn a_file_keeps_its_tag_and_is_not_sent_twice() {
        let data = b"body".as_slice().into();
        let metadata = rust_embed::Metadata::__rust_embed_new([7; 32], None, None, "text/css");
        let first = send("assets/a.css", EmbeddedFile { data, metadata }, &HeaderMap::new());
        assert_eq!(header_of(&first, &header::CONTENT_TYPE), "text/css; charset=utf-8");
        assert!(header_of(&first, &header::CACHE_CONTROL).contains("immutable"));

        let mut again = HeaderMap::new();
        set(&mut again, header::IF_NONE_MATCH, &header_of(&first, &header::ETAG));
        let metadata = rust_embed::Metadata::__rust_embed_new([7; 32], None, None, "text/css");
        let second = send("assets/a.css", EmbeddedFile { data: b"body".as_slice().into(), metadata }, &again);
        assert_eq!(second.status(), StatusCode::NOT_MODIFIED);
    }

    #[test]
    fn without_a_build_the_page_says_how_to_make_one() {
        let page = not_built();
        assert_eq!(page.status(), StatusCode::SERVICE_UNAVAILABLE);
        assert!(NOT_BUILT.contains("make web"));
    }
}
