//! Errors: each is a problem with a stable code and its place, with the same meaning over both protocols.

use super::clients::{Grpc, Http, send};
use super::server::Server;
use super::work::{upload, world};
use cgda::app::model::ErrorKind;
use cgda::grpc::proto;
use reqwest::Method;
use serde_json::{Value, json};
use tonic::Code;
use tonic_types::StatusExt as _;

#[test]
fn every_kind_of_error_means_the_same_over_both_protocols() {
    let table = [
        (ErrorKind::Malformed, 400, Code::InvalidArgument),
        (ErrorKind::Invalid, 422, Code::InvalidArgument),
        (ErrorKind::NotFound, 404, Code::NotFound),
        (ErrorKind::Conflict, 409, Code::FailedPrecondition),
        (ErrorKind::Precondition, 412, Code::Aborted),
        (ErrorKind::TooLarge, 413, Code::ResourceExhausted),
        (ErrorKind::Unauthenticated, 401, Code::Unauthenticated),
        (ErrorKind::Forbidden, 403, Code::PermissionDenied),
        (ErrorKind::Exhausted, 429, Code::ResourceExhausted),
        (ErrorKind::StorageFull, 507, Code::ResourceExhausted),
        (ErrorKind::Unavailable, 503, Code::Unavailable),
        (ErrorKind::Internal, 500, Code::Internal),
    ];
    for kind in ErrorKind::ALL {
        let row = table.iter().find(|row| row.0 == kind);
        let found = (kind, cgda::http::error::status(kind).as_u16(), cgda::grpc::error::code(kind));
        assert_eq!(row, Some(&found));
    }
}

#[tokio::test]
async fn wrong_requests_are_problems() {
    let server = Server::start_with(&[("CGDA_LIMITS__UPLOAD_BYTES", "100000")]);
    let http = Http::new(&server);
    let post = |path: &str| http.request(Method::POST, path).header("content-type", "application/json");

    send(post("/worlds").body("{")).await.expect_problem(400, "invalid_json");
    let wrong = send(post("/worlds").body(r#"{"name": "w", "spec": {"kind": "moon"}}"#)).await;
    assert_eq!(wrong.expect_problem(422, "invalid_request").text("/errors/0/pointer"), "/spec/kind");
    let wrong = send(post("/worlds").body(r#"{"name": "w", "specs": {}}"#)).await;
    assert_eq!(wrong.expect_problem(422, "invalid_request").text("/errors/0/pointer"), "/specs");
    let grid = json!({"kind": "coverage", "origin_m": [0, 0, 0], "column_step_m": [1, 0, 0], "row_step_m": [0, 1, 0],
        "columns": 65535, "rows": 65535, "radius_m": 1});
    let huge = http.post("/worlds", &json!({"name": "w", "spec": grid})).await.expect_problem(422, "invalid_request");
    assert!(huge.text("/detail").contains("4294836225 cells"), "{}", huge.text);
    let twice = r#"{"name": "r", "urdf": "", "spec": {"fixed": {"j": 1, "j": 2}}}"#;
    let wrong = send(post("/robots").body(twice)).await.expect_problem(422, "invalid_request");
    assert_eq!(wrong.text("/errors/0/pointer"), "/spec/fixed");
    let wrong = send(post("/worlds").body(r#"["w", {"kind": "tool_position", "unit": "mm"}]"#)).await;
    assert!(wrong.expect_problem(422, "invalid_request").text("/detail").starts_with("the body is a list"));
    let text = http.request(Method::POST, "/worlds").header("content-type", "text/plain").body("x");
    send(text).await.expect_problem(415, "unsupported_media_type");

    let nobody = "0".repeat(32);
    http.get(&format!("/jobs/job_{nobody}")).await.expect_problem(404, "not_found");
    http.get("/jobs/nobody").await.expect_problem(404, "not_found");
    http.get("/nowhere").await.expect_problem(404, "no_such_route");
    http.get(&format!("/jobs/job_{nobody}/@pause")).await.expect_problem(404, "no_such_route");
    let put = send(http.request(Method::PUT, "/jobs")).await.expect_problem(405, "method_not_allowed");
    assert!(put.headers["allow"].to_str().unwrap().contains("POST"));
    http.get("/jobs?page_size=x").await.expect_problem(400, "invalid_query");
    http.get("/jobs?nonsense=1").await.expect_problem(400, "invalid_query");

    let large = upload(&http, "large.csv", vec![b'1'; 100_001]).await;
    large.expect_problem(413, "body_too_large");
    let chunks = futures_util::stream::iter((0..200).map(|_| Ok::<_, std::io::Error>(vec![b'1'; 1000])));
    let lying = http.request(Method::POST, "/demonstrations").body(reqwest::Body::wrap_stream(chunks));
    send(lying).await.expect_problem(413, "body_too_large");
}

/// Wrong leaves of every body and object whose type is named by a member of its own.
#[tokio::test]
async fn a_wrong_value_inside_a_tagged_object_has_its_own_pointer() {
    let server = Server::start();
    let http = Http::new(&server);
    let ids = ["act", "rob", "wld"].map(|prefix| format!("{prefix}_{}", "0".repeat(32)));
    let execution = |execution: Value| {
        let [action, robot, world] = &ids;
        json!({"kind": "execution", "action": action, "robot": robot, "world": world, "execution": execution})
    };
    let constrained = |constraint: Value| execution(json!({"method": "model", "constraints": [constraint]}));
    let region = |geometry: Value| constrained(json!({"kind": "region", "geometry": geometry}));
    let cube = json!({"shape": "box", "lower_m": [0, 0, 0], "upper_m": [1, 1, 1]});
    let at = |point: Value| constrained(json!({"kind": "region", "geometry": cube, "point": point}));
    let handled = |handling: Value| execution(json!({"method": "sst", "handling": handling}));
    let penalty = |penalty: Value| handled(json!({"strategy": "penalty", "penalty": penalty}));
    let placed = |spec: Value| json!({"name": "w", "spec": spec});
    let surface = json!({"kind": "coverage", "origin_m": [0, 0, 0], "column_step_m": [0, "far", 0],
        "row_step_m": [0, 0, 1], "columns": 4, "rows": 4, "radius_m": 0.1});
    let x = json!([{"name": "x", "unit": "mm"}]);
    let observed = |rows: Value| json!({"observed": {"kind": "rows", "features": x, "rows": rows}});
    for (path, body, pointer) in [
        ("/jobs", json!({"kind": "walk"}), "/kind"),
        (
            "/jobs",
            json!({"kind": "generalization", "name": "a", "demonstrations": [3], "t_min_s": 1}),
            "/demonstrations/0",
        ),
        ("/jobs", json!({"kind": "experiment", "repetitions": -1}), "/repetitions"),
        ("/jobs", json!({"kind": "experiment", "cells": [{"action": "a", "setting": 1}]}), "/cells/0/setting"),
        ("/jobs", execution(json!({"method": {"name": "sst", "population": -1}})), "/execution/method/population"),
        ("/jobs", execution(json!({"method": {"name": "sst", "nose": 1}})), "/execution/method/nose"),
        ("/jobs", execution(json!({"method": {"name": "sts"}})), "/execution/method/name"),
        ("/jobs", execution(json!({"method": "sts"})), "/execution/method"),
        ("/jobs", execution(json!({"method": "sst", "tolerance": "near"})), "/execution/tolerance"),
        ("/jobs", constrained(json!({"kind": "wall"})), "/execution/constraints/0/kind"),
        ("/jobs", constrained(json!({"kind": "joint_step", "limit_rad": [1]})), "/execution/constraints/0/limit_rad"),
        ("/jobs", region(json!({"shape": "cone"})), "/execution/constraints/0/geometry/shape"),
        (
            "/jobs",
            region(json!({"shape": "sphere", "center_m": [0, 0, "top"], "radius_m": 1})),
            "/execution/constraints/0/geometry/center_m/2",
        ),
        (
            "/jobs",
            region(json!({"shape": "polyhedron", "half_spaces": [{"normal": [0, 0, 1], "offset_m": true}]})),
            "/execution/constraints/0/geometry/half_spaces/0/offset_m",
        ),
        ("/jobs", at(json!({"at": "link", "link": 7})), "/execution/constraints/0/point/link"),
        ("/jobs", handled(json!({"strategy": "repairing", "max_attempts": 0.5})), "/execution/handling/max_attempts"),
        ("/jobs", penalty(json!({"kind": "static", "weight": "much"})), "/execution/handling/penalty/weight"),
        ("/jobs:validate", execution(json!({"method": {"name": "model", "prior": 1.5}})), "/execution/method/prior"),
        ("/worlds", placed(surface), "/spec/column_step_m/1"),
        ("/worlds", placed(json!({"kind": "tool_distance", "point_m": [0, 0], "unit": "m"})), "/spec/point_m"),
        ("/recognitions", observed(json!([[0], ["x"]])), "/observed/rows/1/0"),
        ("/recognitions", observed(json!([[0], []])), "/observed/rows/1"),
        ("/experiments", json!({"paper_table": "7"}), "/paper_table"),
        ("/jobs", execution(json!({"method": {"name": "sst", "kind": "pso"}})), "/execution/method/kind"),
        ("/jobs", at(json!({"at": "tool", "link": "hand"})), "/execution/constraints/0/point/link"),
    ] {
        let problem = http.post(path, &body).await.expect_problem(422, "invalid_request");
        assert_eq!(problem.text("/errors/0/pointer"), pointer, "{body}: {}", problem.text);
    }
}

#[tokio::test]
async fn a_bad_file_is_refused_with_row_and_column_over_both_protocols() {
    let server = Server::start();
    let http = Http::new(&server);
    let csv = b"time_s,x,y\n0.0,1.0,2.0\n0.1,nan,2.0\n0.2,1.0,2.0\n".to_vec();
    let refused = upload(&http, "bad.csv", csv.clone()).await.expect(422);
    let place = refused.json["errors"][0].clone();
    let pointer = place["pointer"].as_str().unwrap();
    assert!(pointer.contains("/rows/3") && pointer.ends_with("/x"), "{pointer}");

    let mut grpc = Grpc::new(&server).await;
    let part = |part| proto::UploadRequest { part: Some(part) };
    let parts = [
        part(proto::upload_request::Part::Header(proto::UploadHeader::default())),
        part(proto::upload_request::Part::FileName("bad.csv".to_owned())),
        part(proto::upload_request::Part::Content(csv)),
    ];
    let status = grpc.demonstrations.upload(futures_util::stream::iter(parts)).await.unwrap_err();
    assert_eq!(status.code(), Code::InvalidArgument);
    let details = status.get_error_details();
    assert_eq!(details.error_info().unwrap().reason, refused.text("/code"));
    let violation = &details.bad_request().unwrap().field_violations[0];
    assert_eq!(json!([violation.field, violation.reason]), json!([place["pointer"], place["code"]]));
    assert!(http.get("/demonstrations").await.json["items"].as_array().unwrap().is_empty());
}

#[tokio::test]
async fn a_body_above_the_limit_of_json_is_too_large() {
    let server = Server::start();
    let http = Http::new(&server);
    let mut body = world();
    body["name"] = json!("x".repeat(17 << 20));
    http.post("/worlds", &body).await.expect_problem(413, "body_too_large");
}
