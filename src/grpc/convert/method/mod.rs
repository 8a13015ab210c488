//! Methods and their parameters. Absent parameters have the method's defaults.

mod per_goal;
mod swarm;
mod whole_run;

use super::{finite, required};
use crate::app::model::AppError;
use crate::framework::method::{AutoSpec, MethodSpec};
use crate::grpc::proto;
use proto::method_spec::Name;

/// A method with its parameters; `at` is its JSON pointer.
///
/// # Errors
/// `Invalid` below `at` for a message without a method or a number that is not finite.
pub fn method(at: &str, message: proto::MethodSpec) -> Result<MethodSpec, AppError> {
    let proto::MethodSpec { name } = message;
    match required(&format!("{at}/name"), name)? {
        Name::Auto(message) => auto(at, message).map(MethodSpec::Auto),
        Name::Sst(message) => per_goal::sst(at, message).map(MethodSpec::Sst),
        Name::Pso(message) => swarm::pso(at, message).map(MethodSpec::Pso),
        Name::FiPso(message) => swarm::fi_pso(at, message).map(MethodSpec::FiPso),
        Name::AffgPso(message) => swarm::affg_pso(at, message).map(MethodSpec::AffgPso),
        Name::CmaEs(message) => per_goal::cma_es(at, message).map(MethodSpec::CmaEs),
        Name::De(message) => per_goal::de(at, message).map(MethodSpec::De),
        Name::Broyden(message) => whole_run::broyden(at, message).map(MethodSpec::Broyden),
        Name::Model(message) => whole_run::model(at, message).map(MethodSpec::Model),
        Name::Particle(message) => whole_run::particle(at, message).map(MethodSpec::Particle),
        Name::Search(message) => whole_run::search(at, message).map(MethodSpec::Search),
    }
}

/// The method of that name with its defaults.
///
/// # Errors
/// `Invalid` at `pointer` for a name without a method.
pub fn named(pointer: &str, name: &str) -> Result<MethodSpec, AppError> {
    MethodSpec::by_name(name).ok_or_else(|| {
        let detail = format!("{name:?} is not a method: the methods are {}", MethodSpec::NAMES.join(", "));
        AppError::field(pointer, "invalid_value", detail)
    })
}

fn auto(at: &str, message: proto::AutoMethod) -> Result<AutoSpec, AppError> {
    let proto::AutoMethod { simulator, free_evaluations, noise } = message;
    let default = AutoSpec::default();
    Ok(AutoSpec {
        simulator: simulator.unwrap_or(default.simulator),
        free_evaluations: free_evaluations.unwrap_or(default.free_evaluations),
        noise: number(at, "noise", noise, default.noise)?,
    })
}

/// A finite number, or the default if it is absent.
fn number(at: &str, field: &str, value: Option<f64>, default: f64) -> Result<f64, AppError> {
    finite(&format!("{at}/{field}"), value.unwrap_or(default))
}

/// A finite number, or what the default is if it is absent.
fn number_or_none(at: &str, field: &str, value: Option<f64>, default: Option<f64>) -> Result<Option<f64>, AppError> {
    value.or(default).map(|value| finite(&format!("{at}/{field}"), value)).transpose()
}

impl From<MethodSpec> for proto::MethodSpec {
    fn from(spec: MethodSpec) -> Self {
        let name = match spec {
            MethodSpec::Auto(spec) => Name::Auto(spec.into()),
            MethodSpec::Sst(spec) => Name::Sst(spec.into()),
            MethodSpec::Pso(spec) => Name::Pso(spec.into()),
            MethodSpec::FiPso(spec) => Name::FiPso(spec.into()),
            MethodSpec::AffgPso(spec) => Name::AffgPso(spec.into()),
            MethodSpec::CmaEs(spec) => Name::CmaEs(spec.into()),
            MethodSpec::De(spec) => Name::De(spec.into()),
            MethodSpec::Broyden(spec) => Name::Broyden(spec.into()),
            MethodSpec::Model(spec) => Name::Model(spec.into()),
            MethodSpec::Particle(spec) => Name::Particle(spec.into()),
            MethodSpec::Search(spec) => Name::Search(spec.into()),
        };
        Self { name: Some(name) }
    }
}

impl From<AutoSpec> for proto::AutoMethod {
    fn from(spec: AutoSpec) -> Self {
        let AutoSpec { simulator, free_evaluations, noise } = spec;
        Self { simulator: Some(simulator), free_evaluations: Some(free_evaluations), noise: Some(noise) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};

    fn spec(json: &Value) -> MethodSpec {
        serde_json::from_value(json.clone()).unwrap()
    }

    #[test]
    fn every_method_survives_the_wire_with_its_defaults_and_with_others() {
        let swarm = json!({"population": 7, "stagnation": 8, "inertia": 0.1, "cognitive": 0.2, "social": 0.3,
            "max_velocity": 0.4, "velocity_clamp": "upper_only", "bounds": "open", "leader": "current_best",
            "one_random_pair": true, "ecf_memory_quirk": true, "ecf_velocity_quirk": true,
            "ecf_target_at_generation_end": true});
        let others = [
            json!({"name": "auto", "simulator": true, "free_evaluations": true, "noise": 0.5}),
            json!({"name": "sst", "population": 9, "stagnation": 8, "mutation_probability": 0.1, "bounds": "reflect",
                "ecf_gene0_quirk": true, "ecf_shared_parent_quirk": true, "ecf_target_at_generation_end": true}),
            json!({"name": "pso", "swarm": swarm}),
            json!({"name": "fi_pso", "swarm": swarm, "inheritance_probability": 0.25, "unexecuted_may_win": true}),
            json!({"name": "affg_pso", "swarm": swarm, "alpha": 0.1, "beta": 0.2, "omega": 0.3, "life_gain": 4,
                "granules": 5, "zero_rule": false, "unexecuted_may_win": true}),
            json!({"name": "cma_es", "population": 9, "step": 0.1, "warm_step": 0.2, "precision": 0.3, "stagnation": 4,
                "restarts": 5, "restart_growth": 1.5, "bounds": "reflect"}),
            json!({"name": "cma_es", "warm_step": null}),
            json!({"name": "broyden", "max_tries": 3, "restarts": 4, "identification_deg": 5.0, "longest_step_deg": 6.0,
                "max_step_deg": 7.0}),
            json!({"name": "model", "noise": 0.1, "max_tries": 3, "identification_deg": 4.0, "max_step_deg": 5.0,
                "prior": "simulator"}),
            json!({"name": "particle", "max_evaluations": 3, "particles": 4, "poses": 5, "link_share": 0.1,
                "base_shift_m": 0.2, "max_step_deg": 6.0}),
            json!({"name": "de", "population": 9, "stagnation": 4, "weight": 0.6, "crossover": 0.5, "bounds": "clamp"}),
            json!({"name": "search", "max_evaluations": 3, "poses": 4, "max_step_deg": 5.0}),
        ];
        let defaults = MethodSpec::NAMES.map(|name| json!({"name": name}));
        for json in others.iter().chain(&defaults) {
            let before = spec(json);
            assert_eq!(method("", before.clone().into()).unwrap(), before, "{json}");
        }
    }

    #[test]
    fn an_empty_message_is_the_method_with_its_defaults() {
        let empty = [
            Name::Auto(proto::AutoMethod::default()),
            Name::Sst(proto::SteadyStateTournament::default()),
            Name::Pso(proto::ParticleSwarm::default()),
            Name::FiPso(proto::InheritingSwarm::default()),
            Name::AffgPso(proto::GranulatingSwarm::default()),
            Name::CmaEs(proto::CovarianceAdaptation::default()),
            Name::De(proto::DifferentialEvolution::default()),
            Name::Broyden(proto::BroydenMethod::default()),
            Name::Model(proto::ModelIet::default()),
            Name::Particle(proto::ParticleIet::default()),
            Name::Search(proto::SearchIet::default()),
        ];
        assert_eq!(empty.len(), MethodSpec::NAMES.len());
        for name in empty {
            let read = method("", proto::MethodSpec { name: Some(name) }).unwrap();
            assert_eq!(read, named("", read.name()).unwrap());
        }
    }

    #[test]
    fn a_wrong_parameter_is_named_by_its_pointer() {
        let at = "/execution/method";
        let pointer =
            |name: Name| method(at, proto::MethodSpec { name: Some(name) }).unwrap_err().details[0].pointer.clone();
        let swarm = proto::Swarm { inertia: Some(f64::NAN), ..Default::default() };
        let pso = proto::ParticleSwarm { swarm: Some(swarm) };
        assert_eq!(pointer(Name::Pso(pso)), format!("{at}/swarm/inertia"));
        let sst = proto::SteadyStateTournament { bounds: 9, ..Default::default() };
        assert_eq!(pointer(Name::Sst(sst)), format!("{at}/bounds"));
        let broyden = proto::BroydenMethod { max_step_deg: Some(f64::INFINITY), ..Default::default() };
        assert_eq!(pointer(Name::Broyden(broyden)), format!("{at}/max_step_deg"));
        let error = method(at, proto::MethodSpec::default()).unwrap_err();
        assert_eq!(error.details[0].pointer, format!("{at}/name"));
        assert!(named(at, "magic").unwrap_err().message.contains("cma_es"));
    }
}
