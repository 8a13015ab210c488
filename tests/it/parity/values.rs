//! Parity of the answers: every read of the REST description is asked for over both protocols, and the whole documents
//! are compared.

use super::descriptions::rpc_name;
use super::messages::{json_of, pool, rpcs};
use super::rest::{Operation, Rest};
use super::rules::{FIELDS_APART, LEFT_OUT, RENAMED_PARAMETERS, REST_ONLY_OPERATIONS};
use crate::clients::{Grpc, Http};
use crate::events::read_events;
use crate::server::Server;
use crate::work::{Made, finished, prepare};
use prost_reflect::{DynamicMessage, Kind, MethodDescriptor, Value as Field};
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// Reads that are compared elsewhere: events below, files byte by byte.
const OTHERWISE: &[&str] = &["watchJob"];

/// Collects the differences of two documents, by place.
pub fn differences(place: &str, rest: &Value, grpc: &Value, found: &mut Vec<String>) {
    match (rest, grpc) {
        (Value::Object(rest), Value::Object(grpc)) => {
            let keys: BTreeSet<&String> = rest.keys().chain(grpc.keys()).collect();
            for key in keys {
                let below = format!("{place}/{key}");
                match (rest.get(key), grpc.get(key)) {
                    (Some(rest), Some(grpc)) => differences(&below, rest, grpc, found),
                    (Some(rest), None) if rest.is_null() || is_apart("REST only", key) => {}
                    (None, Some(grpc)) if is_absent(key, grpc) || is_apart("gRPC only", key) => {}
                    (rest, grpc) => found.push(format!("{below}: {rest:?} over REST, {grpc:?} over gRPC")),
                }
            }
        }
        (Value::Array(rest), Value::Array(grpc)) if rest.len() == grpc.len() => {
            for (index, (rest, grpc)) in rest.iter().zip(grpc).enumerate() {
                differences(&format!("{place}/{index}"), rest, grpc, found);
            }
        }
        (Value::Number(rest), Value::Number(grpc)) if rest.as_f64() == grpc.as_f64() => {}
        // A lost list: absent over REST, empty over gRPC.
        (Value::Null, grpc) if is_absent("", grpc) => {}
        (rest, grpc) if rest == grpc => {}
        (rest, grpc) => found.push(format!("{place}: {rest} over REST, {grpc} over gRPC")),
    }
}

/// Whether this value of a message means that there is none.
fn is_absent(key: &str, value: &Value) -> bool {
    let empty = match value {
        Value::Null => true,
        Value::Bool(value) => !value,
        Value::Number(number) => number.as_f64() == Some(0.0),
        Value::String(text) => text.is_empty(),
        Value::Array(items) => items.is_empty(),
        Value::Object(members) => members.is_empty(),
    };
    empty || LEFT_OUT.iter().any(|(name, default)| *name == key && value == default)
}

fn is_apart(side: &str, key: &str) -> bool {
    FIELDS_APART.iter().any(|(place, _)| place.starts_with(side) && place.ends_with(&format!(".{key}")))
}

/// Fails unless the documents are the same.
pub fn assert_alike(place: &str, rest: &Value, grpc: &Value) {
    let mut found = Vec::new();
    differences(place, rest, grpc, &mut found);
    assert!(found.is_empty(), "{found:#?}");
}

/// An operation's parameters by name.
type Parameters = BTreeMap<&'static str, String>;

/// The message of a rpc with these parameters.
fn request(rpc: &MethodDescriptor, parameters: &Parameters) -> DynamicMessage {
    let mut message = DynamicMessage::new(rpc.input());
    for (name, text) in parameters {
        let renamed = RENAMED_PARAMETERS.iter().find(|(rest, _)| rest == name).map_or(*name, |(_, grpc)| grpc);
        let field = rpc.input().get_field_by_name(renamed).unwrap_or_else(|| panic!("{renamed} of {}", rpc.name()));
        let value = match field.kind() {
            Kind::String => Field::String(text.clone()),
            Kind::Uint32 => Field::U32(text.parse().unwrap()),
            Kind::Double => Field::F64(text.parse().unwrap()),
            Kind::Enum(names) => {
                let value = names.values().find(|v| v.name().to_lowercase().ends_with(&text.to_lowercase()));
                Field::EnumNumber(value.unwrap().number())
            }
            other => panic!("{renamed} is {other:?}"),
        };
        let value = if field.is_list() { Field::List(vec![value]) } else { value };
        message.set_field(&field, value);
    }
    message
}

/// The path of an operation with these parameters.
fn path(operation: &Operation, parameters: &Parameters) -> String {
    let id = parameters.get("id").map_or("", String::as_str);
    let path = operation.path.strip_prefix("/api/v1").unwrap().replace("{id}", id);
    let query: Vec<String> =
        parameters.iter().filter(|(name, _)| **name != "id").map(|(name, text)| format!("{name}={text}")).collect();
    if query.is_empty() { path } else { format!("{path}?{}", query.join("&")) }
}

/// Everything there is to read, made once.
struct Everything {
    made: Made,
    job: String,
    run: String,
    trials: String,
    trajectory: String,
    experiment: String,
}

async fn everything(http: &Http) -> Everything {
    let made = prepare(http).await;
    let execution = |execution: Value| {
        json!({"kind": "execution", "action": made.action, "robot": made.robot, "world": made.world, "seed": 21,
            "execution": execution})
    };
    let region = json!({"kind": "region", "side": "outside", "geometry": {"shape": "sphere", "center_m": [9, 9, 9],
        "radius_m": 0.1}});
    let constrained = json!({"method": {"name": "fi_pso", "swarm": {"population": 6, "stagnation": 1}},
        "constraints": [region], "max_evaluations_per_goal": 40,
        "handling": {"strategy": "penalty", "penalty": {"kind": "static", "weight": 2.5}}, "on_infeasible": "append"});
    let job = http.post("/jobs", &execution(constrained)).await.expect(202).text("/id").to_owned();
    let modelled = json!({"method": {"name": "auto", "simulator": true}, "tolerance": 30,
        "reality": {"lost_share": 0.3, "sensor_noise": 1.0, "seed": 3}, "max_evaluations_per_goal": 4});
    let model = http.post("/jobs", &execution(modelled)).await.expect(202).text("/id").to_owned();
    let few = json!({"execution": {"max_evaluations_per_goal": 3}});
    let cell = |setting: &str| json!({"action": "wax", "setting": setting, "preset": "wax", "overrides": few});
    let experiment = json!({"repetitions": 2, "seed": 7, "cells": [cell("a"), cell("b")]});
    let experiment = http.post("/experiments", &experiment).await.expect(202);
    let run = finished(http, &job).await.text("/result/runs/0").to_owned();
    let trials = finished(http, &model).await.text("/result/runs/0").to_owned();
    finished(http, experiment.text("/id")).await;
    let trajectory = http.get(&format!("/runs/{run}")).await.expect(200).text("/trajectory").to_owned();
    let experiment = experiment.text("/result/experiment").to_owned();
    Everything { made, job, run, trials, trajectory, experiment }
}

/// The calls that read with one operation.
fn calls(operation: &Operation, all: &Everything) -> Vec<Parameters> {
    let resource = operation.path.trim_start_matches("/api/v1/").split(['/', ':']).next().unwrap();
    let ids = match resource {
        "actions" => vec![&all.made.action],
        "demonstrations" => vec![&all.made.demonstrations[0]],
        "experiments" => vec![&all.experiment],
        "jobs" => vec![&all.job],
        "robots" => vec![&all.made.robot],
        "runs" => vec![&all.run, &all.trials],
        "trajectories" => vec![&all.trajectory],
        "worlds" => vec![&all.made.world],
        _ => Vec::new(),
    };
    let with = |pairs: &[(&'static str, &str)]| {
        let pairs: Parameters = pairs.iter().map(|(name, text)| (*name, (*text).to_owned())).collect();
        let named = |id: &&String| pairs.clone().into_iter().chain([("id", (*id).clone())]).collect();
        if operation.path.contains("{id}") { ids.iter().map(named).collect() } else { vec![pairs] }
    };
    match operation.id.as_str() {
        "compareExperiment" => with(&[("first", "0"), ("second", "1"), ("quantity", "discrepancy")]),
        "getDemonstrationSamples" => with(&[("features", "x"), ("from", "0.5"), ("to", "4"), ("max_points", "8")]),
        "getRunConvergence" => with(&[("max_points", "5")]),
        "interpolateAction" => with(&[("n", "7")]),
        "listExperimentRows" => with(&[("cell", "1"), ("page_size", "1")]),
        "listJobs" => with(&[("kind", "execution"), ("state", "SUCCEEDED"), ("page_size", "1")]),
        "listRuns" => with(&[("job", &all.job)]),
        id if id.starts_with("export") => with(&[("format", "csv")]),
        _ => with(&[]),
    }
}

#[tokio::test]
async fn every_read_answers_alike_over_both_protocols() {
    let server = Server::start();
    let (http, mut grpc) = (Http::new(&server), Grpc::new(&server).await);
    let all = everything(&http).await;
    let rpcs = rpcs(&pool());
    let mut compared = 0;
    for operation in Rest::read().operations().into_iter().filter(|operation| operation.method == "get") {
        let apart = REST_ONLY_OPERATIONS.iter().any(|(id, _)| *id == operation.id);
        if apart || OTHERWISE.contains(&operation.id.as_str()) {
            continue;
        }
        let rpc = rpcs.iter().find(|rpc| rpc.name() == rpc_name(&operation.id)).unwrap();
        for parameters in calls(&operation, &all) {
            let rest = http.get(&path(&operation, &parameters)).await;
            let answer = grpc.call(rpc, request(rpc, &parameters)).await;
            compared += 1;
            let messages = match answer {
                Ok(messages) => messages,
                Err(status) => {
                    assert_eq!(rest.json["detail"], status.message(), "{}", operation.id);
                    continue;
                }
            };
            let rest = rest.expect(200);
            if rpc.is_server_streaming() {
                same_file(&operation.id, rest.text.as_bytes(), &messages);
            } else if rest.json.is_null() {
                assert_eq!(json_of(&messages[0])["urdf"], rest.text, "{}", operation.id);
            } else {
                assert_alike(&operation.id, &rest.json, &json_of(&messages[0]));
            }
        }
    }
    assert!(compared > 25, "only {compared} reads were compared");
    same_events(&http, &mut grpc, &all.job).await;
}

fn same_file(id: &str, rest: &[u8], messages: &[DynamicMessage]) {
    let mut file = Vec::new();
    for message in messages {
        if let Field::Bytes(content) = message.get_field_by_name("content").unwrap().as_ref() {
            file.extend_from_slice(content);
        }
    }
    assert!(!file.is_empty() && file == rest, "{id} gives another file over gRPC");
}

async fn same_events(http: &Http, grpc: &mut Grpc, job: &str) {
    let over_rest = read_events(http, job, None).await;
    let pool = pool();
    let rpc = rpcs(&pool).into_iter().find(|rpc| rpc.name() == "WatchJob").unwrap();
    let over_grpc = grpc.call(&rpc, request(&rpc, &[("id", job.to_owned())].into())).await.unwrap();
    assert_eq!(over_rest.len(), over_grpc.len());
    for (rest, grpc) in over_rest.iter().zip(&over_grpc) {
        assert_alike(&format!("event {}", rest.id), &rest.data, &json_of(grpc));
    }
}

#[test]
fn a_lost_field_is_seen() {
    let found = |rest: Value, grpc: Value| {
        let mut found = Vec::new();
        differences("", &rest, &grpc, &mut found);
        found.len()
    };
    assert_eq!(found(json!({"valid": true, "name": null}), json!({"valid": true})), 0);
    assert_eq!(found(json!({"valid": true}), json!({})), 1);
    assert_eq!(found(json!({"valid": false}), json!({"valid": true})), 1);
    assert_eq!(found(json!({}), json!({"notes": ["a"]})), 1);
    assert_eq!(found(json!({"goals": [1.0, 2]}), json!({"goals": [1, 2.5]})), 1);
    assert_eq!(found(json!({"goals": [[1]]}), json!({"goals": [[1], [2]]})), 1);
    assert_eq!(found(json!({}), json!({"overrides": {}})), 0);
}
