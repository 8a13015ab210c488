//! The same use case behaves the same over HTTP and gRPC: by the two descriptions, by every read, and in this file by
//! writes over gRPC.

mod descriptions;
mod limits;
pub mod messages;
mod rest;
mod rules;
mod shape;
mod values;

use super::clients::{Grpc, Http};
use super::server::Server;
use super::work::{Made, demonstrations, digests, finished, job, prepare, robot, world};
use cgda::grpc::proto;
use futures_util::stream::iter;
use messages::document;
use proto::upload_request::Part;
use serde_json::{Value, json};
use tonic::Code;
use values::assert_alike;

/// Creates the main job's inputs over gRPC.
async fn prepare_over_grpc(grpc: &mut Grpc) -> Made {
    let mut ids = Vec::new();
    for (name, bytes) in demonstrations() {
        let header = proto::UploadHeader { name: name.clone(), ..Default::default() };
        let mut parts = vec![Part::Header(header), Part::FileName(name)];
        parts.extend(bytes.chunks(1000).map(|chunk| Part::Content(chunk.to_vec())));
        let parts = parts.into_iter().map(|part| proto::UploadRequest { part: Some(part) });
        let made = grpc.demonstrations.upload(iter(parts.collect::<Vec<_>>())).await.unwrap().into_inner();
        ids.push(made.id);
    }
    let generalization = proto::Generalization {
        name: "wax".to_owned(),
        demonstrations: ids.clone(),
        t_min_s: 1.0,
        ..Default::default()
    };
    let request = proto::CreateActionRequest { generalization: Some(generalization), ..Default::default() };
    let job = grpc.actions.create_action(request).await.unwrap().into_inner();
    let action = wait(grpc, &job.id).await.result.unwrap().action.unwrap();

    let described = robot();
    let numbers = |field: &str| {
        let map = described["spec"][field].as_object().unwrap();
        map.iter().map(|(joint, value)| (joint.clone(), value.as_f64().unwrap())).collect()
    };
    let spec =
        proto::RobotSpec { fixed: numbers("fixed"), acceleration: numbers("acceleration"), ..Default::default() };
    let text = |field: &str| described[field].as_str().unwrap().to_owned();
    let request = proto::CreateRobotRequest { name: text("name"), urdf: text("urdf"), spec: Some(spec) };
    let robot = grpc.robots.create_robot(request).await.unwrap().into_inner().id;
    let kind = proto::world_spec::Kind::ToolPosition(proto::ToolPositionWorld { unit: "mm".to_owned() });
    let name = world()["name"].as_str().unwrap().to_owned();
    let request = proto::CreateWorldRequest { name, spec: Some(proto::WorldSpec { kind: Some(kind) }) };
    let world = grpc.worlds.create_world(request).await.unwrap().into_inner().id;
    Made { demonstrations: ids, action, robot, world }
}

async fn wait(grpc: &mut Grpc, id: &str) -> proto::Job {
    let mut after_seq = 0;
    loop {
        let request = proto::WaitJobRequest { id: id.to_owned(), after_seq, timeout_ms: 5000 };
        let job = grpc.jobs.wait_job(request).await.unwrap().into_inner();
        if job.finished_at.is_some() {
            assert_eq!(job.state(), proto::JobState::Succeeded, "{:?}", job.failure);
            return job;
        }
        after_seq = job.last_seq;
    }
}

fn work(made: &Made, seed: u64) -> proto::Work {
    let sst = proto::SteadyStateTournament { population: Some(10), stagnation: Some(2), ..Default::default() };
    let method = proto::MethodSpec { name: Some(proto::method_spec::Name::Sst(sst)) };
    let method_choice = Some(proto::execution_spec::MethodChoice::Method(method));
    let execution = proto::Execution {
        action: made.action.clone(),
        robot: made.robot.clone(),
        world: made.world.clone(),
        execution: Some(proto::ExecutionSpec { method_choice, ..Default::default() }),
        seed: Some(seed),
        ..Default::default()
    };
    proto::Work { kind: Some(proto::work::Kind::Execution(Box::new(execution))) }
}

#[tokio::test]
async fn the_main_job_over_grpc_gives_the_bits_it_gives_over_http() {
    let server = Server::start();
    let (http, mut grpc) = (Http::new(&server), Grpc::new(&server).await);
    let over_http = prepare(&http).await;
    let over_grpc = prepare_over_grpc(&mut grpc).await;
    assert_eq!(over_grpc.demonstrations.len(), over_http.demonstrations.len());
    same_goals(&http, &mut grpc, &over_http, &over_grpc).await;

    let first = http.post("/jobs", &job(&over_http, 21, 1)).await.expect(202).text("/id").to_owned();
    finished(&http, &first).await;
    let request = proto::CreateJobRequest { work: Some(work(&over_grpc, 21)), idempotency_key: "p".to_owned() };
    let second = grpc.jobs.create_job(request.clone()).await.unwrap().into_inner();
    assert_eq!(grpc.jobs.create_job(request).await.unwrap().into_inner().id, second.id);
    let watch = proto::WatchJobRequest { id: second.id.clone(), after_seq: 0 };
    let mut events = grpc.jobs.watch_job(watch).await.unwrap().into_inner();
    let (mut seq, mut digest) = (0, String::new());
    while let Some(event) = events.message().await.unwrap() {
        assert_eq!(event.seq, seq + 1);
        seq = event.seq;
        if let Some(proto::job_event::Data::Run(run)) = event.data {
            digest = run.digest;
        }
    }
    let done = wait(&mut grpc, &second.id).await;
    assert_eq!(done.last_seq, seq);
    assert_eq!(vec![digest], digests(&http, &first).await);
    same_job(&http, &done).await;
    same_trajectory(&http, &mut grpc, &done.result.unwrap().runs[0]).await;
}

async fn same_goals(http: &Http, grpc: &mut Grpc, over_http: &Made, over_grpc: &Made) {
    let mut expected = http.get(&format!("/actions/{}/goals", over_http.action)).await.expect(200).json;
    let request = proto::GetActionGoalsRequest { id: over_grpc.action.clone() };
    let goals = grpc.actions.get_action_goals(request).await.unwrap().into_inner();
    expected["action"] = json!(over_grpc.action);
    assert_alike("goals", &expected, &document("ActionGoals", &goals));
}

async fn same_job(http: &Http, job: &proto::Job) {
    let view = http.get(&format!("/jobs/{}", job.id)).await.expect(200).json;
    assert_alike("job", &view, &document("Job", job));
}

async fn same_trajectory(http: &Http, grpc: &mut Grpc, run: &str) {
    let run = grpc.runs.get_run(proto::GetRunRequest { id: run.to_owned() }).await.unwrap().into_inner();
    let id = run.trajectory.unwrap();
    let view = http.get(&format!("/trajectories/{id}")).await.expect(200).json;
    let points = view["points"].as_array().unwrap();
    let head = grpc.trajectories.get_trajectory(proto::GetTrajectoryRequest { id: id.clone() }).await.unwrap();
    assert_eq!(head.get_ref().point_count, points.len() as u64);
    let request = proto::StreamTrajectoryRequest { id, from_index: 1, batch: 3 };
    let mut chunks = grpc.trajectories.stream_trajectory(request).await.unwrap().into_inner();
    let mut streamed = Vec::new();
    while let Some(chunk) = chunks.message().await.unwrap() {
        assert_eq!(chunk.first_index, 1 + streamed.len() as u64);
        streamed.extend(chunk.points.iter().map(|point| document("TrajectoryPoint", point)));
    }
    assert_alike("points", &json!(points[1..]), &json!(streamed));
}

#[tokio::test]
async fn recognition_answers_alike_and_online_as_at_once() {
    let server = Server::start();
    let (http, mut grpc) = (Http::new(&server), Grpc::new(&server).await);
    let made = prepare(&http).await;
    let goals = http.get(&format!("/actions/{}/goals", made.action)).await.expect(200).json;
    let observed = json!({"kind": "rows", "features": goals["features"], "rows": goals["goals"]});
    let question = json!({"observed": observed, "metric": "sum_of_features", "threshold": 1.0});
    let answer = http.post("/recognitions", &question).await.expect(200).json;
    assert_eq!(answer["recognized"], made.action);

    let features: Vec<proto::Feature> =
        ["x", "y", "z"].map(|name| proto::Feature { name: name.to_owned(), unit: "mm".to_owned() }).to_vec();
    let row =
        |row: &Value| proto::Row { values: row.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect() };
    let rows: Vec<proto::Row> = goals["goals"].as_array().unwrap().iter().map(row).collect();
    let question = proto::RecognitionQuestion {
        metric: proto::Metric::SumOfFeatures as i32,
        threshold: Some(1.0),
        ..Default::default()
    };
    let start = proto::RecognizeOnlineStart { question: Some(question.clone()), features: features.clone() };
    let mut parts = vec![proto::recognize_online_request::Part::Start(start)];
    let samples = |rows: &[proto::Row]| proto::RecognizeOnlineSamples { rows: rows.to_vec() };
    parts.extend(rows.chunks(4).map(|rows| proto::recognize_online_request::Part::Samples(samples(rows))));
    let parts = parts.into_iter().map(|part| proto::RecognizeOnlineRequest { part: Some(part) });
    let mut updates = grpc.recognition.recognize_online(iter(parts.collect::<Vec<_>>())).await.unwrap().into_inner();
    let mut last = None;
    while let Some(update) = updates.message().await.unwrap() {
        last = Some(update);
    }
    let observed = proto::recognize_request::Observed::Rows(proto::ObservedRows { features, rows });
    let request = proto::RecognizeRequest { question: Some(question), observed: Some(observed) };
    let at_once = grpc.recognition.recognize(request).await.unwrap().into_inner();
    assert_eq!(last.as_ref(), Some(&at_once));
    assert_eq!(at_once.recognized.as_ref(), Some(&made.action));
    assert_alike("recognition", &answer, &document("Recognition", &at_once));

    let other = proto::Feature { name: "x".to_owned(), unit: "furlong".to_owned() };
    let rows = proto::ObservedRows { features: vec![other], rows: vec![vec![1.0].into()] };
    let observed = Some(proto::recognize_request::Observed::Rows(rows));
    let request = proto::RecognizeRequest { question: None, observed };
    let none = grpc.recognition.recognize(request).await.unwrap().into_inner();
    assert_eq!((none.recognized, none.candidates.len()), (None, 0));
    let reason = &none.incomparable[0];
    assert_eq!((reason.action.as_str(), reason.observed_unit.as_deref()), (made.action.as_str(), Some("furlong")));
    assert_eq!(reason.feature.as_ref().unwrap().unit, "mm");
}

#[tokio::test]
async fn what_is_refused_over_http_is_refused_over_grpc_with_the_same_code() {
    use tonic_types::StatusExt as _;
    let server = Server::start();
    let (http, mut grpc) = (Http::new(&server), Grpc::new(&server).await);
    let nobody = format!("job_{}", "0".repeat(32));
    for id in [nobody.as_str(), "nobody"] {
        let problem = http.get(&format!("/jobs/{id}")).await.expect(404);
        let status = grpc.jobs.get_job(proto::GetJobRequest { id: id.to_owned() }).await.unwrap_err();
        assert_eq!(status.code(), Code::NotFound);
        assert_eq!(status.get_error_details().error_info().unwrap().reason, problem.text("/code"));
    }
    let request = json!({"name": "", "spec": {"kind": "tool_position", "unit": "furlong"}});
    let problem = http.post("/worlds", &request).await.expect(422);
    let kind = proto::world_spec::Kind::ToolPosition(proto::ToolPositionWorld { unit: "furlong".to_owned() });
    let spec = Some(proto::WorldSpec { kind: Some(kind) });
    let status = grpc.worlds.create_world(proto::CreateWorldRequest { name: String::new(), spec }).await.unwrap_err();
    assert_eq!(status.code(), Code::InvalidArgument);
    let details = status.get_error_details();
    let violations = &details.bad_request().unwrap().field_violations;
    let places: Vec<&str> = violations.iter().map(|violation| violation.field.as_str()).collect();
    let pointers: Vec<&str> =
        problem.json["errors"].as_array().unwrap().iter().map(|error| error["pointer"].as_str().unwrap()).collect();
    assert_eq!(places, pointers);

    let ids = ["act", "rob", "wld"].map(|prefix| format!("{prefix}_{}", "0".repeat(32)));
    let cma = proto::CovarianceAdaptation { step: Some(f64::NAN), ..Default::default() };
    let method = proto::MethodSpec { name: Some(proto::method_spec::Name::CmaEs(cma)) };
    let method_choice = Some(proto::execution_spec::MethodChoice::Method(method));
    let execution = Some(proto::ExecutionSpec { method_choice, ..Default::default() });
    let [action, robot, world] = ids;
    let execution = proto::Execution { action, robot, world, execution, ..Default::default() };
    let work = Some(proto::Work { kind: Some(proto::work::Kind::Execution(Box::new(execution))) });
    let request = proto::CreateJobRequest { work, ..Default::default() };
    let details = grpc.jobs.create_job(request).await.unwrap_err().get_error_details();
    assert_eq!(details.bad_request().unwrap().field_violations[0].field, "/execution/method/step");
}

#[tokio::test]
async fn the_method_auto_stands_for_and_the_cost_in_words_are_told_alike() {
    let server = Server::start();
    let (http, mut grpc) = (Http::new(&server), Grpc::new(&server).await);
    let made = prepare(&http).await;
    let mut request = job(&made, 21, 1);
    request["execution"]["method"] = json!({"name": "auto", "simulator": true});
    let dry = http.post("/jobs:validate?robot_trial_s=30", &request).await.expect(200);
    assert_eq!(dry.text("/chosen/method"), "model", "{}", dry.text);
    assert!(dry.text("/estimate/text").contains("at 30 s each"), "{}", dry.text);
    let mut work = work(&made, 21);
    let Some(proto::work::Kind::Execution(execution)) = &mut work.kind else { panic!("an execution is asked for") };
    let auto = proto::AutoMethod { simulator: Some(true), ..Default::default() };
    let method = proto::MethodSpec { name: Some(proto::method_spec::Name::Auto(auto)) };
    let method_choice = Some(proto::execution_spec::MethodChoice::Method(method));
    let metric = proto::Metric::Multivariate as i32;
    execution.execution = Some(proto::ExecutionSpec { method_choice, metric, ..Default::default() });
    let validate = proto::ValidateJobRequest { work: Some(work), robot_trial_s: Some(30.0) };
    let told = grpc.jobs.validate_job(validate.clone()).await.unwrap().into_inner();
    let mut told = document("JobValidation", &told);
    // Measured again by each dry run.
    for measured in ["simulated_s", "basis"] {
        told["estimate"][measured] = dry.json["estimate"][measured].clone();
    }
    assert_alike("validation", &dry.json, &told);
    let refused = proto::ValidateJobRequest { robot_trial_s: Some(0.0), ..validate };
    assert_eq!(grpc.jobs.validate_job(refused).await.unwrap().into_inner().errors[0].pointer, "/robot_trial_s");

    let id = http.post("/jobs", &request).await.expect(202).text("/id").to_owned();
    let shown = finished(&http, &id).await;
    assert_eq!(shown.text("/request/execution/method/name"), "model");
    let over_grpc = grpc.jobs.get_job(proto::GetJobRequest { id }).await.unwrap().into_inner();
    same_job(&http, &over_grpc).await;
}

#[tokio::test]
async fn what_is_changed_over_grpc_is_changed_over_http() {
    let server = Server::start();
    let (http, mut grpc) = (Http::new(&server), Grpc::new(&server).await);
    let made = prepare_over_grpc(&mut grpc).await;
    let id = made.demonstrations[0].clone();
    let change = proto::PatchDemonstrationRequest {
        id: id.clone(),
        name: Some("renamed".to_owned()),
        excluded: None,
        revision: Some(1),
    };
    let changed = grpc.demonstrations.patch_demonstration(change.clone()).await.unwrap().into_inner();
    let view = http.get(&format!("/demonstrations/{id}")).await.expect(200);
    assert_eq!(view.text("/name"), "renamed");
    assert_alike("demonstration", &view.json, &document("Demonstration", &changed));
    let stale = grpc.demonstrations.patch_demonstration(change).await.unwrap_err();
    assert_eq!(stale.code(), Code::Aborted);
    let stale = proto::DeleteDemonstrationRequest { id: id.clone(), revision: Some(1) };
    assert_eq!(grpc.demonstrations.delete_demonstration(stale).await.unwrap_err().code(), Code::Aborted);
    let delete = proto::DeleteDemonstrationRequest { id: id.clone(), revision: None };
    grpc.demonstrations.delete_demonstration(delete).await.unwrap();
    http.get(&format!("/demonstrations/{id}")).await.expect(404);

    grpc.robots.delete_robot(proto::DeleteRobotRequest { id: made.robot.clone() }).await.unwrap();
    http.get(&format!("/robots/{}", made.robot)).await.expect(404);
    grpc.worlds.delete_world(proto::DeleteWorldRequest { id: made.world.clone() }).await.unwrap();
    let gone = grpc.worlds.delete_world(proto::DeleteWorldRequest { id: made.world }).await.unwrap_err();
    assert_eq!(gone.code(), Code::NotFound);
}

#[tokio::test]
async fn an_experiment_asked_for_over_grpc_is_the_one_of_http() {
    let server = Server::start();
    let (http, mut grpc) = (Http::new(&server), Grpc::new(&server).await);
    let experiment = proto::ExperimentSpec {
        paper_table: proto::PaperTable::PaperTable1 as i32,
        seed: Some(7),
        // Enough to be running still when it is cancelled.
        repetitions: 1_000,
        ..Default::default()
    };
    let wanted = proto::CreateExperimentRequest { experiment: Some(experiment), idempotency_key: "p".to_owned() };
    let job = grpc.experiments.create_experiment(wanted.clone()).await.unwrap().into_inner();
    assert_eq!(grpc.experiments.create_experiment(wanted).await.unwrap().into_inner().id, job.id);
    let view = http.get(&format!("/jobs/{}", job.id)).await.expect(200);
    assert_eq!(view.json["request"]["paper_table"], 1);
    assert_eq!(view.json["result"]["experiment"], json!(job.result.unwrap().experiment));
    assert_alike("request", &view.json["request"], &document("Work", &job.request.unwrap()));
    grpc.jobs.cancel_job(proto::CancelJobRequest { id: job.id }).await.unwrap();
    let comparing = proto::CompareExperimentRequest::default();
    assert_eq!(grpc.experiments.compare_experiment(comparing).await.unwrap_err().code(), Code::NotFound);
    let refused = grpc.experiments.create_experiment(proto::CreateExperimentRequest::default()).await.unwrap_err();
    assert_eq!(refused.code(), Code::InvalidArgument);
}
