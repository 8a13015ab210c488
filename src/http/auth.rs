//! Authentication: the token as a bearer header, or a cookie that a browser gets in exchange for `?token=`.
//!
//! # Architecture Invariants
//! - Everything except the paths in `OPEN` requires credentials; a new route is protected by being in the router.
//! - The cookie works only for a host name that no foreign name server can point here, and for writes only from our own
//!   pages. The header needs neither check, because no page of another origin can set it.

use super::problem::Problem;
use crate::app::model::{AppError, ErrorKind};
use crate::app::{Access, Caller};
use axum::extract::{Request, State};
use axum::http::header::{ACCEPT, AUTHORIZATION, CONTENT_TYPE, COOKIE, HOST, LOCATION, ORIGIN, SET_COOKIE};
use axum::http::{HeaderMap, Method, StatusCode, Uri};
use axum::middleware::Next;
use axum::response::{Html, IntoResponse as _, Response};
use std::net::{Ipv4Addr, Ipv6Addr};
use std::sync::Arc;

const OPEN: [&str; 3] = ["/livez", "/readyz", "/openapi.json"];
const COOKIE_NAME: &str = "cgda_session";
const PAGE: &str = "<!doctype html><meta charset=utf-8><title>cgda</title><p>This address needs the token. Open the URL \
                    that <code>cgda serve</code> printed when it started: it ends in <code>?token=…</code>.";

/// State of the middleware.
#[derive(Debug, Clone)]
pub struct Guard {
    /// Checks the token.
    pub access: Access,
    /// Host names of this server besides its numeric addresses and `localhost`.
    pub hosts: Arc<[String]>,
}

/// Middleware that rejects requests without credentials.
pub async fn require(State(guard): State<Guard>, mut request: Request, next: Next) -> Response {
    if OPEN.contains(&request.uri().path()) {
        return next.run(request).await;
    }
    match admit(&guard, &request) {
        Ok(Admission::Pass(caller)) => {
            request.extensions_mut().insert(caller);
            next.run(request).await
        }
        Ok(Admission::Session(location)) => {
            let port = host(&request).rsplit_once(':').map_or("80", |(_, port)| port);
            let session = guard.access.session();
            let cookie = format!("{COOKIE_NAME}_{port}={session}; Path=/; HttpOnly; SameSite=Strict");
            (StatusCode::SEE_OTHER, [(LOCATION, location), (SET_COOKIE, cookie)]).into_response()
        }
        Err(error) => refuse(request.headers(), error),
    }
}

enum Admission {
    Pass(Caller),
    Session(String),
}

fn admit(guard: &Guard, request: &Request) -> Result<Admission, AppError> {
    let headers = request.headers();
    if let Some(value) = headers.get(AUTHORIZATION) {
        let bearer = value.to_str().ok().and_then(|text| text.split_once(' '));
        let token = bearer.filter(|(scheme, _)| scheme.eq_ignore_ascii_case("bearer")).map(|(_, token)| token.trim());
        return match token {
            Some(token) if guard.access.admits_token(token) => Ok(Admission::Pass(Caller::LocalOperator)),
            _ => Err(unauthenticated("the authorization header does not contain this server's token")),
        };
    }
    if cookies(headers).any(|session| guard.access.admits_session(session)) {
        own_host(guard, request)?;
        own_page(request)?;
        return Ok(Admission::Pass(Caller::LocalOperator));
    }
    if let Some(token) = query_token(request.uri()) {
        if request.method() != Method::GET || request.uri().path().starts_with(super::API) {
            return Err(unauthenticated("send the token as `authorization: Bearer TOKEN`, not in the address"));
        }
        own_host(guard, request)?;
        return if guard.access.admits_token(&token) {
            Ok(Admission::Session(without_token(request.uri())))
        } else {
            Err(unauthenticated("the token in the address is not this server's"))
        };
    }
    Err(unauthenticated("send the token that `cgda serve` printed as `authorization: Bearer TOKEN`"))
}

fn refuse(headers: &HeaderMap, error: AppError) -> Response {
    let has = |name, text: &str| headers.get(name).and_then(|v| v.to_str().ok()).is_some_and(|v| v.contains(text));
    if has(CONTENT_TYPE, "application/grpc") {
        return super::grpc_status("16");
    }
    if has(ACCEPT, "text/html") && error.kind == ErrorKind::Unauthenticated {
        return (StatusCode::UNAUTHORIZED, Html(PAGE)).into_response();
    }
    Problem::from(error).into_response()
}

fn unauthenticated(message: &str) -> AppError {
    AppError::new(ErrorKind::Unauthenticated, "unauthenticated", message)
}

fn cookies(headers: &HeaderMap) -> impl Iterator<Item = &str> {
    let all = headers.get_all(COOKIE).into_iter().filter_map(|value| value.to_str().ok());
    all.flat_map(|value| value.split(';')).filter_map(|cookie| {
        let (name, value) = cookie.trim().split_once('=')?;
        name.starts_with(COOKIE_NAME).then_some(value)
    })
}

fn host(request: &Request) -> &str {
    let header = request.headers().get(HOST).and_then(|value| value.to_str().ok());
    header.or_else(|| request.uri().authority().map(axum::http::uri::Authority::as_str)).unwrap_or("")
}

/// Guards against DNS rebinding: a name that someone else controls may resolve to this machine. Numeric addresses and
/// `localhost` cannot, and configured names are ours.
fn own_host(guard: &Guard, request: &Request) -> Result<(), AppError> {
    let authority = host(request);
    let name = match authority.rsplit_once(':') {
        Some((name, port)) if port.bytes().all(|b| b.is_ascii_digit()) => name,
        _ => authority,
    };
    let numeric = name.parse::<Ipv4Addr>().is_ok()
        || name.strip_prefix('[').and_then(|n| n.strip_suffix(']')).is_some_and(|n| n.parse::<Ipv6Addr>().is_ok());
    let local = name.eq_ignore_ascii_case("localhost");
    if numeric || local || guard.hosts.iter().any(|own| own.eq_ignore_ascii_case(name)) {
        return Ok(());
    }
    let message =
        format!("host {name:?} is not one of this server's names: add it to the configuration, or use its address");
    Err(AppError::new(ErrorKind::Forbidden, "unknown_host", message))
}

/// Guards against cross-site request forgery: a write with a cookie must come from one of our own pages.
fn own_page(request: &Request) -> Result<(), AppError> {
    let text = |name| request.headers().get(name).and_then(|value| value.to_str().ok());
    let site = text("sec-fetch-site");
    let reads = matches!(*request.method(), Method::GET | Method::HEAD | Method::OPTIONS);
    let own = match text(ORIGIN.as_str()) {
        Some(origin) => origin.split_once("://").is_some_and(|(_, authority)| authority == host(request)),
        None if reads => !matches!(site, Some("cross-site")),
        None => site == Some("same-origin"),
    };
    let message = "a request with the session cookie must come from this server's own pages";
    if own { Ok(()) } else { Err(AppError::new(ErrorKind::Forbidden, "cross_origin", message)) }
}

fn query_token(uri: &Uri) -> Option<String> {
    let pairs = uri.query()?.split('&');
    pairs.filter_map(|pair| pair.strip_prefix("token=")).map(str::to_owned).next()
}

/// The same address without the token, and never on another host (`//evil.example`).
fn without_token(uri: &Uri) -> String {
    let path = format!("/{}", uri.path().trim_start_matches(['/', '\\']));
    let rest: Vec<&str> = uri.query().unwrap_or("").split('&').filter(|pair| !pair.starts_with("token=")).collect();
    let rest = rest.join("&");
    if rest.is_empty() { path } else { format!("{path}?{rest}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use axum::Router;
    use axum::body::Body;
    use axum::routing::any;
    use tower::ServiceExt as _;

    async fn ask(request: axum::http::request::Builder) -> Response {
        let guard = Guard { access: Access::new("secret"), hosts: vec!["lab.example".to_owned()].into() };
        let router =
            Router::new().fallback(any(|| async { "in" })).layer(axum::middleware::from_fn_with_state(guard, require));
        router.oneshot(request.body(Body::empty()).unwrap()).await.unwrap()
    }

    fn request(method: &str, uri: &str) -> axum::http::request::Builder {
        Request::builder().method(method).uri(uri).header(HOST, "127.0.0.1:8080")
    }

    fn cookie() -> String {
        format!("other=1; cgda_session_8080={}", Access::new("secret").session())
    }

    #[tokio::test]
    async fn the_header_opens_and_a_wrong_one_does_not_even_with_a_cookie() {
        assert_eq!(ask(request("GET", "/api/v1/jobs").header(AUTHORIZATION, "Bearer secret")).await.status(), 200);
        for wrong in ["Bearer wrong", "secret", "Basic secret", ""] {
            let answer =
                ask(request("GET", "/api/v1/jobs").header(AUTHORIZATION, wrong).header(COOKIE, cookie())).await;
            assert_eq!(answer.status(), 401, "{wrong}");
        }
        assert_eq!(ask(request("GET", "/api/v1/jobs")).await.status(), 401);
        assert_eq!(ask(request("GET", "/livez")).await.status(), 200);
    }

    #[tokio::test]
    async fn the_address_with_the_token_is_exchanged_for_a_cookie_on_pages_only() {
        let answer = ask(request("GET", "/jobs/1?a=b&token=secret")).await;
        assert_eq!((answer.status().as_u16(), &answer.headers()[LOCATION]), (303, &"/jobs/1?a=b".parse().unwrap()));
        let cookie = answer.headers()[SET_COOKIE].to_str().unwrap();
        assert!(cookie.starts_with("cgda_session_8080=") && !cookie.contains("secret"), "{cookie}");
        assert!(cookie.contains("HttpOnly") && cookie.contains("SameSite=Strict"));
        assert_eq!(ask(request("GET", "//evil.example?token=secret")).await.headers()[LOCATION], "/evil.example");
        assert_eq!(ask(request("GET", "/?token=wrong")).await.status(), 401);
        assert_eq!(ask(request("GET", "/api/v1/jobs?token=secret")).await.status(), 401);
    }

    #[tokio::test]
    async fn a_cookie_reads_from_own_hosts_and_writes_from_own_pages_only() {
        let read = |host: &str| Request::builder().uri("/api/v1/jobs").header(HOST, host).header(COOKIE, cookie());
        for (host, status) in [
            ("127.0.0.1:8080", 200),
            ("[::1]:8080", 200),
            ("localhost", 200),
            ("LAB.example:1", 200),
            ("evil.example", 403),
        ] {
            assert_eq!(ask(read(host)).await.status(), status, "{host}");
        }
        assert_eq!(ask(read("localhost").header("sec-fetch-site", "cross-site")).await.status(), 403);
        let write = || request("POST", "/api/v1/jobs").header(COOKIE, cookie());
        assert_eq!(ask(write()).await.status(), 403);
        assert_eq!(ask(write().header(ORIGIN, "http://127.0.0.1:8080")).await.status(), 200);
        assert_eq!(ask(write().header(ORIGIN, "http://evil.example")).await.status(), 403);
        assert_eq!(ask(write().header(ORIGIN, "http://127.0.0.1:9999")).await.status(), 403);
        assert_eq!(ask(write().header("sec-fetch-site", "same-origin")).await.status(), 200);
    }
}
