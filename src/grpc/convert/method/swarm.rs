//! Particle swarms.

use super::per_goal::bounds_rule;
use super::{number, number_or_none};
use crate::app::model::AppError;
use crate::framework::method::per_goal::{AffgPsoSpec, FiPsoSpec, Leader, PsoSpec, SwarmSpec, VelocityClamp};
use crate::grpc::convert::enumeration::Enumeration as _;
use crate::grpc::proto;

pub(super) fn pso(at: &str, message: proto::ParticleSwarm) -> Result<PsoSpec, AppError> {
    let proto::ParticleSwarm { swarm } = message;
    Ok(PsoSpec { swarm: self::swarm(at, swarm, PsoSpec::default().swarm)? })
}

pub(super) fn fi_pso(at: &str, message: proto::InheritingSwarm) -> Result<FiPsoSpec, AppError> {
    let proto::InheritingSwarm { swarm, inheritance_probability, unexecuted_may_win } = message;
    let default = FiPsoSpec::default();
    let probability = number(at, "inheritance_probability", inheritance_probability, default.inheritance_probability)?;
    Ok(FiPsoSpec {
        swarm: self::swarm(at, swarm, default.swarm)?,
        inheritance_probability: probability,
        unexecuted_may_win: unexecuted_may_win.unwrap_or(default.unexecuted_may_win),
    })
}

pub(super) fn affg_pso(at: &str, message: proto::GranulatingSwarm) -> Result<AffgPsoSpec, AppError> {
    let proto::GranulatingSwarm { swarm, alpha, beta, omega, life_gain, granules, zero_rule, unexecuted_may_win } =
        message;
    let default = AffgPsoSpec::default();
    Ok(AffgPsoSpec {
        swarm: self::swarm(at, swarm, default.swarm)?,
        alpha: number(at, "alpha", alpha, default.alpha)?,
        beta: number(at, "beta", beta, default.beta)?,
        omega: number(at, "omega", omega, default.omega)?,
        life_gain: life_gain.unwrap_or(default.life_gain),
        granules: granules.unwrap_or(default.granules),
        zero_rule: zero_rule.unwrap_or(default.zero_rule),
        unexecuted_may_win: unexecuted_may_win.unwrap_or(default.unexecuted_may_win),
    })
}

fn swarm(at: &str, message: Option<proto::Swarm>, default: SwarmSpec) -> Result<SwarmSpec, AppError> {
    let Some(message) = message else { return Ok(default) };
    let proto::Swarm {
        population,
        stagnation,
        inertia,
        cognitive,
        social,
        max_velocity,
        velocity_clamp,
        bounds,
        leader,
        one_random_pair,
        ecf_memory_quirk,
        ecf_velocity_quirk,
        ecf_target_at_generation_end,
    } = message;
    let at = &format!("{at}/swarm");
    let clamp = VelocityClamp::read(&format!("{at}/velocity_clamp"), velocity_clamp)?;
    Ok(SwarmSpec {
        population: population.unwrap_or(default.population),
        stagnation: stagnation.unwrap_or(default.stagnation),
        inertia: number(at, "inertia", inertia, default.inertia)?,
        cognitive: number(at, "cognitive", cognitive, default.cognitive)?,
        social: number(at, "social", social, default.social)?,
        max_velocity: number_or_none(at, "max_velocity", max_velocity, default.max_velocity)?,
        velocity_clamp: clamp.unwrap_or(default.velocity_clamp),
        bounds: bounds_rule(at, bounds, default.bounds)?,
        leader: Leader::read(&format!("{at}/leader"), leader)?.unwrap_or(default.leader),
        one_random_pair: one_random_pair.unwrap_or(default.one_random_pair),
        ecf_memory_quirk: ecf_memory_quirk.unwrap_or(default.ecf_memory_quirk),
        ecf_velocity_quirk: ecf_velocity_quirk.unwrap_or(default.ecf_velocity_quirk),
        ecf_target_at_generation_end: ecf_target_at_generation_end.unwrap_or(default.ecf_target_at_generation_end),
    })
}

impl From<PsoSpec> for proto::ParticleSwarm {
    fn from(spec: PsoSpec) -> Self {
        let PsoSpec { swarm } = spec;
        Self { swarm: Some(swarm.into()) }
    }
}

impl From<FiPsoSpec> for proto::InheritingSwarm {
    fn from(spec: FiPsoSpec) -> Self {
        let FiPsoSpec { swarm, inheritance_probability, unexecuted_may_win } = spec;
        Self {
            swarm: Some(swarm.into()),
            inheritance_probability: Some(inheritance_probability),
            unexecuted_may_win: Some(unexecuted_may_win),
        }
    }
}

impl From<AffgPsoSpec> for proto::GranulatingSwarm {
    fn from(spec: AffgPsoSpec) -> Self {
        let AffgPsoSpec { swarm, alpha, beta, omega, life_gain, granules, zero_rule, unexecuted_may_win } = spec;
        Self {
            swarm: Some(swarm.into()),
            alpha: Some(alpha),
            beta: Some(beta),
            omega: Some(omega),
            life_gain: Some(life_gain),
            granules: Some(granules),
            zero_rule: Some(zero_rule),
            unexecuted_may_win: Some(unexecuted_may_win),
        }
    }
}

impl From<SwarmSpec> for proto::Swarm {
    fn from(spec: SwarmSpec) -> Self {
        let SwarmSpec {
            population,
            stagnation,
            inertia,
            cognitive,
            social,
            max_velocity,
            velocity_clamp,
            bounds,
            leader,
            one_random_pair,
            ecf_memory_quirk,
            ecf_velocity_quirk,
            ecf_target_at_generation_end,
        } = spec;
        Self {
            population: Some(population),
            stagnation: Some(stagnation),
            inertia: Some(inertia),
            cognitive: Some(cognitive),
            social: Some(social),
            max_velocity,
            velocity_clamp: velocity_clamp.number(),
            bounds: bounds.number(),
            leader: leader.number(),
            one_random_pair: Some(one_random_pair),
            ecf_memory_quirk: Some(ecf_memory_quirk),
            ecf_velocity_quirk: Some(ecf_velocity_quirk),
            ecf_target_at_generation_end: Some(ecf_target_at_generation_end),
        }
    }
}
