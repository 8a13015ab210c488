//! Methods that search goal by goal, but for the swarms.

use super::{number, number_or_none};
use crate::app::model::AppError;
use crate::framework::method::per_goal::{BoundsRule, CmaEsSpec, DeSpec, SstSpec};
use crate::grpc::convert::enumeration::Enumeration as _;
use crate::grpc::proto;

pub(super) fn sst(at: &str, message: proto::SteadyStateTournament) -> Result<SstSpec, AppError> {
    let proto::SteadyStateTournament {
        population,
        stagnation,
        mutation_probability,
        ecf_gene0_quirk,
        ecf_target_at_generation_end,
        ecf_shared_parent_quirk,
        bounds,
    } = message;
    let default = SstSpec::default();
    let probability = number(at, "mutation_probability", mutation_probability, default.mutation_probability)?;
    Ok(SstSpec {
        population: population.unwrap_or(default.population),
        stagnation: stagnation.unwrap_or(default.stagnation),
        mutation_probability: probability,
        bounds: bounds_rule(at, bounds, default.bounds)?,
        ecf_gene0_quirk: ecf_gene0_quirk.unwrap_or(default.ecf_gene0_quirk),
        ecf_shared_parent_quirk: ecf_shared_parent_quirk.unwrap_or(default.ecf_shared_parent_quirk),
        ecf_target_at_generation_end: ecf_target_at_generation_end.unwrap_or(default.ecf_target_at_generation_end),
    })
}

pub(super) fn cma_es(at: &str, message: proto::CovarianceAdaptation) -> Result<CmaEsSpec, AppError> {
    let proto::CovarianceAdaptation {
        population,
        step,
        warm_step,
        cold_start,
        precision,
        stagnation,
        restarts,
        restart_growth,
        bounds,
    } = message;
    let default = CmaEsSpec::default();
    let warm_step = number_or_none(at, "warm_step", warm_step, default.warm_step)?;
    Ok(CmaEsSpec {
        population: population.or(default.population),
        step: number(at, "step", step, default.step)?,
        warm_step: if cold_start { None } else { warm_step },
        precision: number(at, "precision", precision, default.precision)?,
        stagnation: stagnation.unwrap_or(default.stagnation),
        restarts: restarts.unwrap_or(default.restarts),
        restart_growth: number(at, "restart_growth", restart_growth, default.restart_growth)?,
        bounds: bounds_rule(at, bounds, default.bounds)?,
    })
}

pub(super) fn de(at: &str, message: proto::DifferentialEvolution) -> Result<DeSpec, AppError> {
    let proto::DifferentialEvolution { population, stagnation, weight, crossover, bounds } = message;
    let default = DeSpec::default();
    Ok(DeSpec {
        population: population.unwrap_or(default.population),
        stagnation: stagnation.unwrap_or(default.stagnation),
        weight: number(at, "weight", weight, default.weight)?,
        crossover: number(at, "crossover", crossover, default.crossover)?,
        bounds: bounds_rule(at, bounds, default.bounds)?,
    })
}

/// The rule, or the method's default if it is unspecified.
pub(super) fn bounds_rule(at: &str, number: i32, default: BoundsRule) -> Result<BoundsRule, AppError> {
    Ok(BoundsRule::read(&format!("{at}/bounds"), number)?.unwrap_or(default))
}

impl From<SstSpec> for proto::SteadyStateTournament {
    fn from(spec: SstSpec) -> Self {
        let SstSpec {
            population,
            stagnation,
            mutation_probability,
            bounds,
            ecf_gene0_quirk,
            ecf_shared_parent_quirk,
            ecf_target_at_generation_end,
        } = spec;
        Self {
            population: Some(population),
            stagnation: Some(stagnation),
            mutation_probability: Some(mutation_probability),
            bounds: bounds.number(),
            ecf_gene0_quirk: Some(ecf_gene0_quirk),
            ecf_shared_parent_quirk: Some(ecf_shared_parent_quirk),
            ecf_target_at_generation_end: Some(ecf_target_at_generation_end),
        }
    }
}

impl From<CmaEsSpec> for proto::CovarianceAdaptation {
    fn from(spec: CmaEsSpec) -> Self {
        let CmaEsSpec { population, step, warm_step, precision, stagnation, restarts, restart_growth, bounds } = spec;
        Self {
            population,
            step: Some(step),
            warm_step,
            cold_start: warm_step.is_none(),
            precision: Some(precision),
            stagnation: Some(stagnation),
            restarts: Some(restarts),
            restart_growth: Some(restart_growth),
            bounds: bounds.number(),
        }
    }
}

impl From<DeSpec> for proto::DifferentialEvolution {
    fn from(spec: DeSpec) -> Self {
        let DeSpec { population, stagnation, weight, crossover, bounds } = spec;
        Self {
            population: Some(population),
            stagnation: Some(stagnation),
            weight: Some(weight),
            crossover: Some(crossover),
            bounds: bounds.number(),
        }
    }
}
