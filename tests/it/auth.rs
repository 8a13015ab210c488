//! Authentication over both protocols.

use super::clients::{Grpc, Http, send};
use super::parity::messages::{pool, rpcs};
use super::server::Server;
use prost_reflect::DynamicMessage;
use reqwest::Method;
use tonic::Code;

#[tokio::test]
async fn every_address_of_the_document_but_three_needs_the_token() {
    let server = Server::start();
    let http = Http::new(&server);
    let document = send(http.bare(Method::GET, "/openapi.json")).await.expect(200);
    assert_eq!(document.text("/openapi"), "3.1.0");
    let mut refused = 0;
    for (path, item) in document.json["paths"].as_object().unwrap() {
        let concrete = path.replace("{id}", &format!("job_{}", "0".repeat(32)));
        for method in item.as_object().unwrap().keys() {
            let method = Method::from_bytes(method.to_uppercase().as_bytes()).unwrap();
            let answer = send(http.bare(method.clone(), &concrete)).await;
            if ["/livez", "/readyz", "/openapi.json"].contains(&path.as_str()) {
                answer.expect(200);
            } else {
                answer.expect_problem(401, "unauthenticated");
                refused += 1;
                let wrong = http.bare(method, &concrete).bearer_auth("wrong");
                send(wrong).await.expect_problem(401, "unauthenticated");
            }
        }
    }
    assert!(refused > 30, "{refused}");
}

#[tokio::test]
async fn the_printed_address_opens_the_dashboard_with_a_cookie() {
    let server = Server::start();
    let http = Http::new(&server);
    let opened = send(http.bare(Method::GET, &format!("/?token={}", server.token))).await.expect(303);
    assert_eq!(opened.headers["location"], "/");
    let cookie = opened.headers["set-cookie"].to_str().unwrap();
    assert!(cookie.contains("HttpOnly") && cookie.contains("SameSite=Strict") && !cookie.contains(&server.token));
    let cookie = cookie.split(';').next().unwrap().to_owned();
    let with = |method: Method, path: &str| http.bare(method, path).header("cookie", &cookie);
    let page = send(with(Method::GET, "/").header("accept", "text/html")).await;
    assert!([200, 503].contains(&page.status), "the dashboard, or how to build it");
    assert!(page.text.to_lowercase().contains("<!doctype html>"));
    send(with(Method::GET, "/api/v1/jobs")).await.expect(200);
    send(with(Method::GET, "/api/v1/jobs").header("host", "evil.example")).await.expect_problem(403, "unknown_host");
    send(with(Method::POST, "/api/v1/worlds").json(&super::work::world())).await.expect_problem(403, "cross_origin");
    let own = with(Method::POST, "/api/v1/worlds").header("origin", format!("http://{}", server.address));
    send(own.json(&super::work::world())).await.expect(201);
}

#[tokio::test]
async fn grpc_needs_the_token_too_and_unknown_methods_are_unimplemented() {
    let server = Server::start();
    let (owner, stranger) = (Grpc::new(&server).await, Grpc::with_token(&server, "wrong").await);
    for rpc in rpcs(&pool()) {
        let empty = || DynamicMessage::new(rpc.input());
        let code = stranger.call(&rpc, empty()).await.unwrap_err().code();
        assert_eq!(code, Code::Unauthenticated, "{}", rpc.full_name());
        let code = owner.call(&rpc, empty()).await.map_or_else(|status| status.code(), |_| Code::Ok);
        assert_ne!(code, Code::Unimplemented, "{}", rpc.full_name());
    }
    let http = Http::new(&server);
    for (token, expected) in [("wrong", "16"), (server.token.as_str(), "12")] {
        let call = http.bare(Method::POST, "/cgda.v1.NoService/Call").header("content-type", "application/grpc");
        let answer = send(call.bearer_auth(token)).await.expect(200);
        assert_eq!(answer.headers["grpc-status"], expected);
    }
}
