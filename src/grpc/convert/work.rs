//! What a job does: the request, in and out.

use super::{finite, finite_or_none, list, metric, reference, references, required, text};
use crate::app::model::{AppError, CreateJob, EarlierRun, ExecutionRequest, GeneralizationRequest};
use crate::app::shape;
use crate::framework::constraint::{ConstraintSpec, HandlingSpec, OnInfeasible};
use crate::framework::execution::{Chosen, ExecutionSpec};
use crate::framework::generalization::Weighting;
use crate::framework::method::per_goal::{BoundsRule, MethodSpec, SstSpec, method_or_name};
use crate::grpc::proto;
use proto::execution_spec::Method;
use proto::work::Kind;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

/// The work of a request.
pub fn work(work: Option<proto::Work>) -> Result<CreateJob, AppError> {
    match required("/kind", work.and_then(|work| work.kind))? {
        Kind::Generalization(work) => generalization(work).map(CreateJob::Generalization),
        Kind::Execution(work) => execution(*work).map(|work| CreateJob::Execution(Box::new(work))),
        Kind::ExperimentJson(json) => document("/experiment_json", &json).map(CreateJob::Experiment),
    }
}

/// A generalization.
pub fn generalization(work: proto::Generalization) -> Result<GeneralizationRequest, AppError> {
    Ok(GeneralizationRequest {
        name: work.name,
        demonstrations: references("/demonstrations", &work.demonstrations)?,
        t_min_s: finite("/t_min_s", work.t_min_s)?,
        weighting: weighting(work.weighting)?,
        features: list(work.features),
        metric: metric("/metric", work.metric)?,
    })
}

fn execution(work: proto::Execution) -> Result<ExecutionRequest, AppError> {
    Ok(ExecutionRequest {
        name: work.name.and_then(text),
        action: reference("/action", &work.action)?,
        robot: reference("/robot", &work.robot)?,
        world: reference("/world", &work.world)?,
        execution: spec(required("/execution", work.execution)?)?,
        seed: work.seed,
        repetitions: if work.repetitions == 0 { 1 } else { work.repetitions },
        max_evaluations_per_s: finite_or_none("/max_evaluations_per_s", work.max_evaluations_per_s)?,
        earlier_runs: work.earlier_runs.map(earlier).transpose()?,
    })
}

fn earlier(earlier: proto::EarlierRuns) -> Result<Vec<EarlierRun>, AppError> {
    let run = |(index, earlier): (usize, proto::EarlierRun)| {
        let pointer = |field: &str| format!("/earlier_runs/{index}/{field}");
        let job = text(earlier.job).map(|job| reference(&pointer("job"), &job)).transpose()?;
        Ok(EarlierRun { run: reference(&pointer("run"), &earlier.run)?, job, trials: earlier.trials })
    };
    earlier.runs.into_iter().enumerate().map(run).collect()
}

fn spec(spec: proto::ExecutionSpec) -> Result<ExecutionSpec, AppError> {
    let method = match required("/execution/method", spec.method)? {
        Method::Sst(sst) => MethodSpec::Sst(tournament(&sst)?),
        Method::MethodJson(json) => document::<NamedMethod>("/execution/method_json", &json)?.0,
        Method::MethodName(name) => MethodSpec::by_name(&name).ok_or_else(|| {
            let detail = format!("{name:?} is no method: the methods are {}", MethodSpec::NAMES.join(", "));
            AppError::field("/execution/method_name", "invalid_value", detail)
        })?,
    };
    let constrained: Constrained = match spec.constraints_json.as_str() {
        "" => Constrained::default(),
        json => document("/execution/constraints_json", json)?,
    };
    Ok(ExecutionSpec {
        method,
        chosen: spec.chosen.map(|chosen| Chosen { method: chosen.method, reason: chosen.reason }),
        constraints: constrained.constraints,
        handling: constrained.handling,
        on_infeasible: constrained.on_infeasible,
        metric: metric("/execution/metric", spec.metric)?,
        target_discrepancy: finite_or_none("/execution/target_discrepancy", spec.target_discrepancy)?,
        tolerance: finite_or_none("/execution/tolerance", spec.tolerance)?,
        max_evaluations_per_goal: spec.max_evaluations_per_goal,
        rounding_noise: finite("/execution/rounding_noise", spec.rounding_noise)?,
        reality: match spec.reality_json.as_str() {
            "" => None,
            json => Some(document("/execution/reality_json", json)?),
        },
    })
}

/// The part of an execution that travels as a JSON document.
#[derive(Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Constrained {
    constraints: Vec<ConstraintSpec>,
    handling: HandlingSpec,
    on_infeasible: OnInfeasible,
}

fn document<T: DeserializeOwned + Serialize>(pointer: &str, json: &str) -> Result<T, AppError> {
    let refuse = |error: serde_json::Error| AppError::field(pointer, "invalid_value", error.to_string());
    let value = serde_json::from_str(json).map_err(refuse)?;
    let sent = serde_json::from_str(json).map_err(refuse)?;
    shape::check(pointer, &sent, &serde_json::to_value(&value).map_err(AppError::internal)?)?;
    Ok(value)
}

/// A method that travels as a JSON document: an object, or its name alone.
#[derive(Serialize, Deserialize)]
struct NamedMethod(#[serde(deserialize_with = "method_or_name")] MethodSpec);

/// JSON of a value type, which always has one.
fn json(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap_or_default()
}

fn tournament(sst: &proto::SteadyStateTournament) -> Result<SstSpec, AppError> {
    let default = SstSpec::default();
    let probability = sst.mutation_probability.unwrap_or(default.mutation_probability);
    Ok(SstSpec {
        population: sst.population.unwrap_or(default.population),
        stagnation: sst.stagnation.unwrap_or(default.stagnation),
        mutation_probability: finite("/execution/method/mutation_probability", probability)?,
        ecf_gene0_quirk: sst.ecf_gene0_quirk.unwrap_or(default.ecf_gene0_quirk),
        ecf_shared_parent_quirk: sst.ecf_shared_parent_quirk.unwrap_or(default.ecf_shared_parent_quirk),
        bounds: if sst.open_bounds.unwrap_or(false) { BoundsRule::Open } else { BoundsRule::Clamp },
        ecf_target_at_generation_end: sst.ecf_target_at_generation_end.unwrap_or(default.ecf_target_at_generation_end),
    })
}

fn weighting(value: i32) -> Result<Weighting, AppError> {
    match proto::Weighting::try_from(value) {
        Ok(proto::Weighting::Unspecified | proto::Weighting::PerDemonstration) => Ok(Weighting::PerDemonstration),
        Ok(proto::Weighting::PerSample) => Ok(Weighting::PerSample),
        Err(_) => Err(AppError::field("/weighting", "invalid_value", format!("{value} is no weighting"))),
    }
}

/// The same weighting.
pub fn weighting_message(weighting: Weighting) -> proto::Weighting {
    match weighting {
        Weighting::PerSample => proto::Weighting::PerSample,
        Weighting::PerDemonstration => proto::Weighting::PerDemonstration,
    }
}

impl From<CreateJob> for proto::Work {
    fn from(work: CreateJob) -> Self {
        let kind = match work {
            CreateJob::Generalization(work) => Kind::Generalization(work.into()),
            CreateJob::Execution(work) => Kind::Execution(Box::new((*work).into())),
            CreateJob::Experiment(work) => Kind::ExperimentJson(json(&work)),
        };
        Self { kind: Some(kind) }
    }
}

impl From<GeneralizationRequest> for proto::Generalization {
    fn from(work: GeneralizationRequest) -> Self {
        Self {
            name: work.name,
            demonstrations: work.demonstrations.into_iter().map(String::from).collect(),
            t_min_s: work.t_min_s,
            weighting: weighting_message(work.weighting) as i32,
            features: work.features.unwrap_or_default(),
            metric: proto::Metric::from(work.metric) as i32,
        }
    }
}

impl From<ExecutionRequest> for proto::Execution {
    fn from(work: ExecutionRequest) -> Self {
        Self {
            name: work.name,
            action: work.action.into(),
            robot: work.robot.into(),
            world: work.world.into(),
            execution: Some(work.execution.into()),
            seed: work.seed,
            repetitions: work.repetitions,
            max_evaluations_per_s: work.max_evaluations_per_s,
            earlier_runs: work
                .earlier_runs
                .map(|runs| proto::EarlierRuns { runs: runs.into_iter().map(Into::into).collect() }),
        }
    }
}

impl From<EarlierRun> for proto::EarlierRun {
    fn from(earlier: EarlierRun) -> Self {
        Self { run: earlier.run.into(), job: earlier.job.map(String::from).unwrap_or_default(), trials: earlier.trials }
    }
}

impl From<Chosen> for proto::ChosenMethod {
    fn from(chosen: Chosen) -> Self {
        Self { method: chosen.method, reason: chosen.reason }
    }
}

impl From<ExecutionSpec> for proto::ExecutionSpec {
    fn from(spec: ExecutionSpec) -> Self {
        let method = match spec.method {
            MethodSpec::Sst(sst) if sst.bounds != BoundsRule::Reflect => Method::Sst(proto::SteadyStateTournament {
                population: Some(sst.population),
                stagnation: Some(sst.stagnation),
                mutation_probability: Some(sst.mutation_probability),
                ecf_gene0_quirk: Some(sst.ecf_gene0_quirk),
                ecf_shared_parent_quirk: Some(sst.ecf_shared_parent_quirk),
                open_bounds: Some(sst.bounds == BoundsRule::Open),
                ecf_target_at_generation_end: Some(sst.ecf_target_at_generation_end),
            }),
            method => Method::MethodJson(json(&method)),
        };
        let constrained =
            Constrained { constraints: spec.constraints, handling: spec.handling, on_infeasible: spec.on_infeasible };
        Self {
            method: Some(method),
            chosen: spec.chosen.map(Into::into),
            constraints_json: if constrained == Constrained::default() { String::new() } else { json(&constrained) },
            metric: proto::Metric::from(spec.metric) as i32,
            target_discrepancy: spec.target_discrepancy,
            tolerance: spec.tolerance,
            max_evaluations_per_goal: spec.max_evaluations_per_goal,
            rounding_noise: spec.rounding_noise,
            reality_json: spec.reality.as_ref().map_or_else(String::new, json),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::model::ErrorKind;

    fn request(json: serde_json::Value) -> CreateJob {
        serde_json::from_value(json).unwrap()
    }

    #[test]
    fn a_request_survives_the_wire() {
        let id = "0".repeat(32);
        for json in [
            serde_json::json!({"kind": "generalization", "name": "wax", "demonstrations": [format!("dem_{id}")],
                "t_min_s": 2.5, "weighting": "per_sample", "features": ["x"], "metric": "aquila"}),
            serde_json::json!({"kind": "execution", "action": format!("act_{id}"), "robot": format!("rob_{id}"),
                "world": format!("wld_{id}"), "seed": 7, "repetitions": 3, "execution": {"tolerance": 5.0,
                "method": {"name": "sst", "population": 10, "stagnation": 4, "ecf_gene0_quirk": true}}}),
            serde_json::json!({"kind": "experiment", "paper_table": "all", "repetitions": 3, "seed": 7}),
            serde_json::json!({"kind": "execution", "action": format!("act_{id}"), "robot": format!("rob_{id}"),
                "world": format!("wld_{id}"), "seed": 7, "execution": {
                "method": {"name": "fi_pso", "swarm": {"population": 10}, "inheritance_probability": 0.25},
                "constraints": [{"kind": "region", "geometry": {"shape": "sphere", "center_m": [0.5, 0, 0], "radius_m": 0.4}}],
                "handling": {"strategy": "penalty", "penalty": {"kind": "dynamic", "weight": 2.5}},
                "on_infeasible": "append"}}),
            serde_json::json!({"kind": "execution", "action": format!("act_{id}"), "robot": format!("rob_{id}"),
                "world": format!("wld_{id}"), "seed": 7, "execution": {"method": "model", "chosen": {"method": "model", "reason": "why"},
                "reality": {"link_share": 0.05, "base_shift_m": 0.02}}, "earlier_runs": [{"run": format!("run_{id}"),
                "job": format!("job_{id}"), "trials": 12}]}),
        ] {
            let before = request(json);
            assert_eq!(work(Some(before.clone().into())).unwrap(), before);
        }
    }

    #[test]
    fn absent_fields_have_the_same_defaults_as_in_json() {
        let id = "0".repeat(32);
        let (action, robot, world) = (format!("act_{id}"), format!("rob_{id}"), format!("wld_{id}"));
        let json = request(serde_json::json!({"kind": "execution", "action": action, "robot": robot, "world": world,
            "execution": {"method": {"name": "sst"}}}));
        let sst = Method::Sst(proto::SteadyStateTournament::default());
        let spec = proto::ExecutionSpec { method: Some(sst), ..Default::default() };
        let message = proto::Execution { action, robot, world, execution: Some(spec), ..Default::default() };
        assert_eq!(work(Some(proto::Work { kind: Some(Kind::Execution(Box::new(message))) })).unwrap(), json);
    }

    #[test]
    fn json_documents_are_read_as_over_http() {
        let read = |method: &str, reality: &str| {
            let method = Some(Method::MethodJson(method.to_owned()));
            spec(proto::ExecutionSpec { method, reality_json: reality.to_owned(), ..Default::default() })
        };
        assert_eq!(read("\"model\"", "").unwrap().method, MethodSpec::by_name("model").unwrap());
        assert_eq!(read("{\"name\": \"model\"}", "").unwrap(), read("\"model\"", "").unwrap());
        let place = |error: AppError| error.details[0].pointer.clone();
        assert_eq!(place(read("{\"name\": 3}", "").unwrap_err()), "/execution/method_json");
        assert_eq!(place(read("\"model\"", "[0.5]").unwrap_err()), "/execution/reality_json");
    }

    #[test]
    fn what_is_missing_or_wrong_is_named() {
        let error = work(None).unwrap_err();
        assert_eq!((error.kind, error.details[0].pointer.as_str()), (ErrorKind::Invalid, "/kind"));
        let wrong = proto::Generalization { t_min_s: f64::NAN, ..Default::default() };
        assert_eq!(generalization(wrong).unwrap_err().details[0].pointer, "/t_min_s");
        let wrong = proto::Generalization { weighting: 9, ..Default::default() };
        assert_eq!(generalization(wrong).unwrap_err().details[0].pointer, "/weighting");
    }
}
