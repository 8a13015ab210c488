//! Conversion of a job's work: requests in both directions.

use super::enumeration::{Enumeration as _, or_default};
use super::{
    constraint, experiment, finite, finite_or_none, list, method, planning, reference, references, required, text,
};
use crate::app::model::{AppError, CreateJob, EarlierRun, ExecutionRequest, GeneralizationRequest};
use crate::framework::constraint::HandlingSpec;
use crate::framework::execution::{Chosen, ExecutionSpec};
use crate::framework::world::DisturbanceSpec;
use crate::grpc::proto;
use proto::execution_spec::MethodChoice;
use proto::work::Kind;

/// The work of a request.
///
/// # Errors
/// `Invalid` at the JSON pointer that the field has over HTTP.
pub fn work(work: Option<proto::Work>) -> Result<CreateJob, AppError> {
    match required("/kind", work.and_then(|proto::Work { kind }| kind))? {
        Kind::Generalization(work) => generalization(work).map(CreateJob::Generalization),
        Kind::Execution(work) => execution(*work).map(|work| CreateJob::Execution(Box::new(work))),
        Kind::Experiment(work) => experiment::request(work).map(CreateJob::Experiment),
    }
}

/// A generalization.
///
/// # Errors
/// As [`work`].
pub fn generalization(work: proto::Generalization) -> Result<GeneralizationRequest, AppError> {
    let proto::Generalization { name, demonstrations, t_min_s, weighting, features, metric } = work;
    Ok(GeneralizationRequest {
        name,
        demonstrations: references("/demonstrations", &demonstrations)?,
        t_min_s: finite("/t_min_s", t_min_s)?,
        weighting: or_default("/weighting", weighting)?,
        features: list(features),
        metric: or_default("/metric", metric)?,
    })
}

fn execution(work: proto::Execution) -> Result<ExecutionRequest, AppError> {
    let proto::Execution {
        name,
        action,
        robot,
        world,
        execution,
        seed,
        repetitions,
        max_evaluations_per_s,
        earlier_runs,
        planning,
        avoid_collisions,
    } = work;
    Ok(ExecutionRequest {
        name: name.and_then(text),
        action: reference("/action", &action)?,
        robot: reference("/robot", &robot)?,
        world: reference("/world", &world)?,
        execution: spec(required("/execution", execution)?)?,
        seed,
        repetitions: if repetitions == 0 { 1 } else { repetitions },
        max_evaluations_per_s: finite_or_none("/max_evaluations_per_s", max_evaluations_per_s)?,
        earlier_runs: earlier_runs.map(earlier).transpose()?,
        planning: planning.map(planning::spec).transpose()?,
        avoid_collisions,
    })
}

fn earlier(earlier: proto::EarlierRuns) -> Result<Vec<EarlierRun>, AppError> {
    let run = |(index, proto::EarlierRun { run, job, trials }): (usize, proto::EarlierRun)| {
        let pointer = |field: &str| format!("/earlier_runs/{index}/{field}");
        let job = text(job).map(|job| reference(&pointer("job"), &job)).transpose()?;
        Ok(EarlierRun { run: reference(&pointer("run"), &run)?, job, trials })
    };
    let proto::EarlierRuns { runs } = earlier;
    runs.into_iter().enumerate().map(run).collect()
}

fn spec(spec: proto::ExecutionSpec) -> Result<ExecutionSpec, AppError> {
    let proto::ExecutionSpec {
        method_choice,
        metric,
        target_discrepancy,
        tolerance,
        max_evaluations_per_goal,
        rounding_noise,
        chosen,
        constraints,
        handling,
        on_infeasible,
        reality,
    } = spec;
    let constraint = |(index, message)| constraint::constraint(&format!("/execution/constraints/{index}"), message);
    Ok(ExecutionSpec {
        method: match required("/execution/method", method_choice)? {
            MethodChoice::Method(message) => method::method("/execution/method", message)?,
            MethodChoice::MethodName(name) => method::named("/execution/method_name", &name)?,
        },
        chosen: chosen.map(|proto::ChosenMethod { method, reason }| Chosen { method, reason }),
        constraints: constraints.into_iter().enumerate().map(constraint).collect::<Result<_, _>>()?,
        handling: match handling {
            None => HandlingSpec::default(),
            Some(message) => constraint::handling("/execution/handling", message)?,
        },
        on_infeasible: or_default("/execution/on_infeasible", on_infeasible)?,
        metric: or_default("/execution/metric", metric)?,
        target_discrepancy: finite_or_none("/execution/target_discrepancy", target_discrepancy)?,
        tolerance: finite_or_none("/execution/tolerance", tolerance)?,
        max_evaluations_per_goal,
        rounding_noise: finite("/execution/rounding_noise", rounding_noise)?,
        reality: reality.map(self::reality).transpose()?,
    })
}

fn reality(message: proto::RealitySpec) -> Result<DisturbanceSpec, AppError> {
    let proto::RealitySpec {
        link_share,
        base_shift_m,
        sensor_noise,
        joint_noise_deg,
        lost_share,
        latency_s,
        settle_s,
        seed,
    } = message;
    let number = |field: &str, value: f64| finite(&format!("/execution/reality/{field}"), value);
    Ok(DisturbanceSpec {
        link_share: number("link_share", link_share)?,
        base_shift_m: number("base_shift_m", base_shift_m)?,
        sensor_noise: number("sensor_noise", sensor_noise)?,
        joint_noise_deg: number("joint_noise_deg", joint_noise_deg)?,
        lost_share: number("lost_share", lost_share)?,
        latency_s: number("latency_s", latency_s)?,
        settle_s: number("settle_s", settle_s)?,
        seed,
    })
}

impl From<CreateJob> for proto::Work {
    fn from(work: CreateJob) -> Self {
        let kind = match work {
            CreateJob::Generalization(work) => Kind::Generalization(work.into()),
            CreateJob::Execution(work) => Kind::Execution(Box::new((*work).into())),
            CreateJob::Experiment(work) => Kind::Experiment(work.into()),
        };
        Self { kind: Some(kind) }
    }
}

impl From<GeneralizationRequest> for proto::Generalization {
    fn from(work: GeneralizationRequest) -> Self {
        let GeneralizationRequest { name, demonstrations, t_min_s, weighting, features, metric } = work;
        Self {
            name,
            demonstrations: demonstrations.into_iter().map(String::from).collect(),
            t_min_s,
            weighting: weighting.number(),
            features: features.unwrap_or_default(),
            metric: metric.number(),
        }
    }
}

impl From<ExecutionRequest> for proto::Execution {
    fn from(work: ExecutionRequest) -> Self {
        let ExecutionRequest {
            name,
            action,
            robot,
            world,
            execution,
            seed,
            repetitions,
            max_evaluations_per_s,
            earlier_runs,
            planning,
            avoid_collisions,
        } = work;
        Self {
            name,
            action: action.into(),
            robot: robot.into(),
            world: world.into(),
            execution: Some(execution.into()),
            seed,
            repetitions,
            max_evaluations_per_s,
            earlier_runs: earlier_runs.map(|runs| proto::EarlierRuns { runs: super::all(runs) }),
            planning: planning.map(Into::into),
            avoid_collisions,
        }
    }
}

impl From<EarlierRun> for proto::EarlierRun {
    fn from(earlier: EarlierRun) -> Self {
        let EarlierRun { run, job, trials } = earlier;
        Self { run: run.into(), job: job.map(String::from).unwrap_or_default(), trials }
    }
}

impl From<Chosen> for proto::ChosenMethod {
    fn from(chosen: Chosen) -> Self {
        let Chosen { method, reason } = chosen;
        Self { method, reason }
    }
}

impl From<ExecutionSpec> for proto::ExecutionSpec {
    fn from(spec: ExecutionSpec) -> Self {
        let ExecutionSpec {
            method,
            chosen,
            metric,
            target_discrepancy,
            tolerance,
            max_evaluations_per_goal,
            rounding_noise,
            reality,
            constraints,
            handling,
            on_infeasible,
        } = spec;
        Self {
            method_choice: Some(MethodChoice::Method(method.into())),
            chosen: chosen.map(Into::into),
            constraints: super::all(constraints),
            handling: (handling != HandlingSpec::default()).then(|| handling.into()),
            on_infeasible: on_infeasible.number(),
            metric: metric.number(),
            target_discrepancy,
            tolerance,
            max_evaluations_per_goal,
            rounding_noise,
            reality: reality.map(Into::into),
        }
    }
}

impl From<DisturbanceSpec> for proto::RealitySpec {
    fn from(spec: DisturbanceSpec) -> Self {
        let DisturbanceSpec {
            link_share,
            base_shift_m,
            sensor_noise,
            joint_noise_deg,
            lost_share,
            latency_s,
            settle_s,
            seed,
        } = spec;
        Self { link_share, base_shift_m, sensor_noise, joint_noise_deg, lost_share, latency_s, settle_s, seed }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::model::ErrorKind;
    use serde_json::{Value, json};

    fn request(json: Value) -> CreateJob {
        serde_json::from_value(json).unwrap()
    }

    fn executing(execution: &Value) -> Value {
        let id = "0".repeat(32);
        json!({"kind": "execution", "action": format!("act_{id}"), "robot": format!("rob_{id}"),
            "world": format!("wld_{id}"), "execution": execution})
    }

    #[test]
    fn a_request_survives_the_wire() {
        let id = "0".repeat(32);
        let mut full = executing(&json!({"method": {"name": "fi_pso", "inheritance_probability": 0.25},
            "chosen": {"method": "fi_pso", "reason": "why"}, "metric": "aquila", "target_discrepancy": 1.5,
            "tolerance": 5.0, "max_evaluations_per_goal": 40, "rounding_noise": 1e-13,
            "constraints": [{"kind": "joint_step", "limit_rad": 0.2}],
            "handling": {"strategy": "penalty", "penalty": {"kind": "dynamic", "weight": 2.5}},
            "on_infeasible": "append",
            "reality": {"link_share": 0.05, "base_shift_m": 0.02, "sensor_noise": 0.1, "joint_noise_deg": 0.2,
                "lost_share": 0.3, "latency_s": 0.4, "settle_s": 0.5, "seed": 6}}));
        full["name"] = json!("night");
        full["seed"] = json!(7);
        full["repetitions"] = json!(3);
        full["max_evaluations_per_s"] = json!(10.5);
        full["planning"] = json!({"speed": 0.25, "acceleration": 0.75, "dwell_s": 0.0, "blend": true,
            "timing": "demonstration", "sample_s": 0.01, "joint_limits": {"elbow": {"velocity": 1.5, "jerk": 30.0}}});
        full["earlier_runs"] = json!([{"run": format!("run_{id}"), "job": format!("job_{id}"), "trials": 12}]);
        for json in [
            json!({"kind": "generalization", "name": "wax", "demonstrations": [format!("dem_{id}")],
                "t_min_s": 2.5, "weighting": "per_sample", "features": ["x"], "metric": "aquila"}),
            json!({"kind": "experiment", "paper_table": "all", "repetitions": 3, "seed": 7}),
            executing(&json!({"method": "model"})),
            full,
        ] {
            let before = request(json);
            assert_eq!(work(Some(before.clone().into())).unwrap(), before);
        }
    }

    #[test]
    fn absent_fields_have_the_same_defaults_as_in_json() {
        let id = "0".repeat(32);
        let method_choice = Some(MethodChoice::MethodName("sst".to_owned()));
        let message = proto::Execution {
            action: format!("act_{id}"),
            robot: format!("rob_{id}"),
            world: format!("wld_{id}"),
            execution: Some(proto::ExecutionSpec { method_choice, ..Default::default() }),
            ..Default::default()
        };
        let message = proto::Work { kind: Some(Kind::Execution(Box::new(message))) };
        assert_eq!(work(Some(message)).unwrap(), request(executing(&json!({"method": {"name": "sst"}}))));
    }

    #[test]
    fn what_is_missing_or_wrong_is_named() {
        let pointer = |error: AppError| error.details[0].pointer.clone();
        let error = work(None).unwrap_err();
        assert_eq!((error.kind, pointer(error).as_str()), (ErrorKind::Invalid, "/kind"));
        let wrong = proto::Generalization { t_min_s: f64::NAN, ..Default::default() };
        assert_eq!(pointer(generalization(wrong).unwrap_err()), "/t_min_s");
        let wrong = proto::Generalization { weighting: 9, ..Default::default() };
        assert_eq!(pointer(generalization(wrong).unwrap_err()), "/weighting");
        assert_eq!(pointer(spec(proto::ExecutionSpec::default()).unwrap_err()), "/execution/method");
        let wrong = proto::RealitySpec { lost_share: f64::NAN, ..Default::default() };
        assert_eq!(pointer(reality(wrong).unwrap_err()), "/execution/reality/lost_share");
    }
}
