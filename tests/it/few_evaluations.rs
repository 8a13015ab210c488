//! A job of a few-evaluation method: method by name, trials, goals out of reach, earlier runs.

use super::clients::{Grpc, Http};
use super::server::Server;
use super::work::{Made, digests, finished, prepare};
use cgda::grpc::proto;
use serde_json::{Value, json};

fn model(made: &Made, earlier_runs: Option<Value>) -> Value {
    let mut request = json!({"kind": "execution", "action": made.action, "robot": made.robot, "world": made.world,
        "execution": {"method": "model", "tolerance": 27.4}, "seed": 5});
    if let Some(runs) = earlier_runs {
        request["earlier_runs"] = runs;
    }
    request
}

async fn made(http: &Http, request: &Value) -> Value {
    let id = http.post("/jobs", request).await.expect(202).text("/id").to_owned();
    finished(http, &id).await.json
}

async fn trials(http: &Http, job: &Value) -> Vec<Value> {
    let run = job["result"]["runs"][0].as_str().unwrap();
    http.get(&format!("/runs/{run}/trials")).await.expect(200).json["trials"].as_array().unwrap().clone()
}

#[tokio::test]
async fn a_model_job_by_its_name_gives_the_same_over_http_and_grpc() {
    let server = Server::start();
    let (http, mut grpc) = (Http::new(&server), Grpc::new(&server).await);
    let inputs = prepare(&http).await;
    let first = made(&http, &model(&inputs, Some(json!([])))).await;
    assert_eq!(first["request"]["execution"]["method"]["name"], "model");
    let trials = trials(&http, &first).await;
    let evaluations = first["progress"]["evaluations"].as_u64().unwrap();
    assert!(evaluations < 40 && trials.len() as u64 == evaluations, "{evaluations} evaluations");
    assert_eq!(first["progress"]["trials"].as_array().unwrap().len(), trials.len());

    let run = first["result"]["runs"][0].as_str().unwrap();
    let goals = http.get(&format!("/runs/{run}/goals")).await.expect(200).json["goals"].as_array().unwrap().clone();
    for goal in &goals {
        let residual = goal["residual"].as_f64().unwrap();
        assert_eq!(goal["stop_reason"] == "out_of_reach", residual > 27.4, "{goal}");
        let verdict = if residual > 27.4 { "out_of_reach" } else { "reached" };
        assert_eq!(goal["judgement"], json!({"verdict": verdict, "distance": residual, "tolerance": 27.4}), "{goal}");
    }
    assert!(goals.iter().any(|goal| goal["stop_reason"] == "out_of_reach"), "the arm cannot reach every goal");

    let execution = proto::Execution {
        action: inputs.action.clone(),
        robot: inputs.robot.clone(),
        world: inputs.world.clone(),
        execution: Some(proto::ExecutionSpec {
            method_choice: Some(proto::execution_spec::MethodChoice::MethodName("model".to_owned())),
            tolerance: Some(27.4),
            ..Default::default()
        }),
        seed: Some(5),
        earlier_runs: Some(proto::EarlierRuns::default()),
        ..Default::default()
    };
    let work = proto::Work { kind: Some(proto::work::Kind::Execution(Box::new(execution))) };
    let request = proto::CreateJobRequest { work: Some(work), ..Default::default() };
    let id = grpc.jobs.create_job(request).await.unwrap().into_inner().id;
    finished(&http, &id).await;
    assert_eq!(digests(&http, &id).await, digests(&http, first["id"].as_str().unwrap()).await);
    let run = grpc.jobs.get_job(proto::GetJobRequest { id }).await.unwrap().into_inner().result.unwrap().runs.remove(0);
    let over_grpc = grpc.runs.get_run_trials(proto::GetRunTrialsRequest { id: run.clone() }).await.unwrap();
    let found: Vec<Value> = over_grpc
        .get_ref()
        .trials
        .iter()
        .inspect(|trial| assert!(trial.observed && trial.cells.is_empty(), "{trial:?}"))
        .map(|trial| json!({"joints": trial.joints, "observation": trial.observation, "cells": null, "goal": trial.goal}))
        .collect();
    assert_eq!(found, trials);
    let goals_again = grpc.runs.get_run_goals(proto::GetRunGoalsRequest { id: run }).await.unwrap().into_inner();
    let residuals: Vec<Option<f64>> = goals_again.goals.iter().map(|goal| goal.residual).collect();
    assert_eq!(json!(residuals), json!(goals.iter().map(|goal| goal["residual"].clone()).collect::<Vec<_>>()));
}

#[tokio::test]
async fn a_second_job_begins_with_the_trials_of_the_first_unless_it_is_told_not_to() {
    let server = Server::start();
    let http = Http::new(&server);
    let inputs = prepare(&http).await;
    let first = made(&http, &model(&inputs, None)).await;
    assert_eq!(first["request"]["earlier_runs"], json!([]), "there was none to begin with");
    let count = trials(&http, &first).await.len();

    let second = made(&http, &model(&inputs, None)).await;
    let told = &second["request"]["earlier_runs"];
    let run = first["result"]["runs"][0].clone();
    assert_eq!(*told, json!([{"run": run, "job": first["id"], "trials": count}]));
    let evaluations = |job: &Value| job["progress"]["evaluations"].as_u64().unwrap();
    assert!(evaluations(&second) < evaluations(&first), "{} after {}", evaluations(&second), evaluations(&first));

    let named = made(&http, &model(&inputs, Some(json!([{"run": run}])))).await;
    assert_eq!(named["request"]["earlier_runs"], *told);
    let digest = async |job: &Value| digests(&http, job["id"].as_str().unwrap()).await;
    assert_eq!(digest(&named).await, digest(&second).await, "what a job begins with is all in its request");
    let without = made(&http, &model(&inputs, Some(json!([])))).await;
    assert_eq!(digest(&without).await, digest(&first).await);

    let mut other = model(&inputs, Some(json!([{"run": run}])));
    other["execution"]["reality"] = json!({"link_share": 0.05});
    let problem = http.post("/jobs", &other).await.expect(422);
    assert_eq!(problem.json["errors"][0]["pointer"], "/earlier_runs/0/run", "{}", problem.text);
    assert_eq!(problem.json["errors"][0]["code"], "other_robot");
    other["earlier_runs"] = json!(null);
    let drawn = made(&http, &other).await;
    assert_eq!(drawn["request"]["earlier_runs"], json!([]), "another robot has no earlier trials");
}

#[tokio::test]
async fn only_the_service_tells_why_a_method_was_chosen_and_forms_only_serde_knows_are_refused() {
    let server = Server::start();
    let http = Http::new(&server);
    let inputs = prepare(&http).await;
    let mut forged = model(&inputs, Some(json!([])));
    forged["execution"]["chosen"] = json!({"method": "model", "reason": "forged"});
    let job = http.post("/jobs", &forged).await.expect(202);
    assert_eq!(job.json["request"]["execution"].get("chosen"), None, "{}", job.text);
    let mut auto = forged.clone();
    auto["execution"]["method"] = json!("auto");
    let job = http.post("/jobs", &auto).await.expect(202);
    let chosen = job.json["request"]["execution"]["chosen"].clone();
    assert!(chosen["reason"].as_str().unwrap().len() > 20 && chosen["reason"] != "forged", "{chosen}");
    let again = http.post(&format!("/jobs/{}:clone", job.text("/id")), &json!({})).await.expect(202);
    assert_eq!(again.json["request"]["execution"]["chosen"], chosen);

    for (execution, pointer) in [
        (json!(["model"]), "/execution"),
        (json!({"method": {"name": 3}}), "/execution/method/name"),
        (json!({"method": "model", "reality": [0.5]}), "/execution/reality"),
    ] {
        let mut request = model(&inputs, None);
        request["execution"] = execution;
        let problem = http.post("/jobs", &request).await.expect_problem(422, "invalid_request");
        assert_eq!(problem.text("/errors/0/pointer"), pointer);
    }
}
