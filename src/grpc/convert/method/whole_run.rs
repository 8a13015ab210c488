//! Methods that plan all goals at once.

use super::{number, number_or_none};
use crate::app::model::AppError;
use crate::framework::method::whole_run::{BroydenSpec, CoverSpec, ModelSpec, ParticleSpec, Prior};
use crate::grpc::convert::enumeration::Enumeration as _;
use crate::grpc::proto;

pub(super) fn broyden(at: &str, message: proto::BroydenMethod) -> Result<BroydenSpec, AppError> {
    let proto::BroydenMethod { max_tries, restarts, identification_deg, longest_step_deg, max_step_deg } = message;
    let default = BroydenSpec::default();
    Ok(BroydenSpec {
        max_tries: max_tries.unwrap_or(default.max_tries),
        restarts: restarts.unwrap_or(default.restarts),
        identification_deg: number(at, "identification_deg", identification_deg, default.identification_deg)?,
        longest_step_deg: number(at, "longest_step_deg", longest_step_deg, default.longest_step_deg)?,
        max_step_deg: number_or_none(at, "max_step_deg", max_step_deg, default.max_step_deg)?,
    })
}

pub(super) fn model(at: &str, message: proto::ModelIet) -> Result<ModelSpec, AppError> {
    let proto::ModelIet { noise, max_tries, identification_deg, max_step_deg, prior, restarts } = message;
    let default = ModelSpec::default();
    Ok(ModelSpec {
        noise: number(at, "noise", noise, default.noise)?,
        max_tries: max_tries.unwrap_or(default.max_tries),
        identification_deg: number(at, "identification_deg", identification_deg, default.identification_deg)?,
        max_step_deg: number_or_none(at, "max_step_deg", max_step_deg, default.max_step_deg)?,
        restarts,
        prior: Prior::read(&format!("{at}/prior"), prior)?.unwrap_or(default.prior),
    })
}

pub(super) fn particle(at: &str, message: proto::ParticleIet) -> Result<ParticleSpec, AppError> {
    let proto::ParticleIet { max_evaluations, particles, poses, link_share, base_shift_m, max_step_deg } = message;
    let default = ParticleSpec::default();
    Ok(ParticleSpec {
        max_evaluations: max_evaluations.or(default.max_evaluations),
        particles: particles.unwrap_or(default.particles),
        poses: poses.unwrap_or(default.poses),
        link_share: number(at, "link_share", link_share, default.link_share)?,
        base_shift_m: number(at, "base_shift_m", base_shift_m, default.base_shift_m)?,
        max_step_deg: number_or_none(at, "max_step_deg", max_step_deg, default.max_step_deg)?,
    })
}

pub(super) fn search(at: &str, message: proto::SearchIet) -> Result<CoverSpec, AppError> {
    let proto::SearchIet { max_evaluations, poses, max_step_deg } = message;
    let default = CoverSpec::default();
    Ok(CoverSpec {
        max_evaluations: max_evaluations.or(default.max_evaluations),
        poses: poses.unwrap_or(default.poses),
        max_step_deg: number_or_none(at, "max_step_deg", max_step_deg, default.max_step_deg)?,
    })
}

impl From<BroydenSpec> for proto::BroydenMethod {
    fn from(spec: BroydenSpec) -> Self {
        let BroydenSpec { max_tries, restarts, identification_deg, longest_step_deg, max_step_deg } = spec;
        Self {
            max_tries: Some(max_tries),
            restarts: Some(restarts),
            identification_deg: Some(identification_deg),
            longest_step_deg: Some(longest_step_deg),
            max_step_deg,
        }
    }
}

impl From<ModelSpec> for proto::ModelIet {
    fn from(spec: ModelSpec) -> Self {
        let ModelSpec { noise, max_tries, identification_deg, max_step_deg, restarts, prior } = spec;
        Self {
            noise: Some(noise),
            max_tries: Some(max_tries),
            identification_deg: Some(identification_deg),
            max_step_deg,
            restarts,
            prior: prior.number(),
        }
    }
}

impl From<ParticleSpec> for proto::ParticleIet {
    fn from(spec: ParticleSpec) -> Self {
        let ParticleSpec { max_evaluations, particles, poses, link_share, base_shift_m, max_step_deg } = spec;
        Self {
            max_evaluations,
            particles: Some(particles),
            poses: Some(poses),
            link_share: Some(link_share),
            base_shift_m: Some(base_shift_m),
            max_step_deg,
        }
    }
}

impl From<CoverSpec> for proto::SearchIet {
    fn from(spec: CoverSpec) -> Self {
        let CoverSpec { max_evaluations, poses, max_step_deg } = spec;
        Self { max_evaluations, poses: Some(poses), max_step_deg }
    }
}
