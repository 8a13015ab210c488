//! Methods and their parameters as users write them; `name` picks one. Defaults are the algorithm as its literature
//! defines it; each quirk of the published runs is a named option, on only in the `paper-*` presets.

use super::bounds::BoundsRule;
use super::cma_es::CmaEsSpec;
use super::swarm::{AffgPsoSpec, FiPsoSpec, PsoSpec};
use crate::method::whole_run::{BroydenSpec, CoverSpec, ModelSpec};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// An optimisation method with its parameters.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(tag = "name", rename_all = "snake_case")]
pub enum MethodSpec {
    /// Whichever of the others suits the problem: it is put in this one's place, and why is said.
    Auto(AutoSpec),
    /// Steady-state tournament.
    Sst(SstSpec),
    /// Particle swarm.
    Pso(PsoSpec),
    /// Particle swarm with fitness inheritance.
    FiPso(FiPsoSpec),
    /// Particle swarm with adaptive fuzzy fitness granulation.
    AffgPso(AffgPsoSpec),
    /// Covariance matrix adaptation, each goal's search begun at the previous goal's result.
    CmaEs(CmaEsSpec),
    /// Gauss-Newton with Broyden's Jacobian, carried over from goal to goal: few evaluations, bad tails.
    Broyden(BroydenSpec),
    /// MODEL-IET: a Gaussian process of the feature map owns the whole run; a dozen evaluations.
    Model(ModelSpec),
    /// PARTICLE-IET: a coverage world with the described robot as an uncertain prior.
    Particle(ParticleSpec),
    /// SEARCH-IET: a coverage world with nothing known.
    Search(CoverSpec),
}

/// What a method is chosen by, beyond the problem itself.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields, default)]
pub struct AutoSpec {
    /// The robot and world as described may be used as a simulator, which need not be right.
    pub simulator: bool,
    /// Evaluations cost nothing, as in simulation: the best result counts instead of few evaluations.
    pub free_evaluations: bool,
    /// Standard deviation of one observed feature, features' unit, for a method that can be told.
    pub noise: f64,
}

/// Parameters of PARTICLE-IET.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ParticleSpec {
    /// The run gives up after this many evaluations.
    pub max_evaluations: u32,
    /// Draws of the robot (1 to 1024).
    pub particles: u32,
    /// Poses to choose from (1 to 8192).
    pub poses: u32,
    /// Standard deviation of a link's relative length.
    pub link_share: f64,
    /// Standard deviation of each coordinate of the base, metres.
    pub base_shift_m: f64,
    /// Largest step of a joint from one trial to the next, degrees (of 180 a stroke for prismatic joints); none where
    /// the robot needs none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_step_deg: Option<f64>,
}

impl Default for ParticleSpec {
    fn default() -> Self {
        Self {
            max_evaluations: 400,
            particles: 80,
            poses: 1024,
            link_share: 0.046,
            base_shift_m: 0.03,
            max_step_deg: None,
        }
    }
}

impl MethodSpec {
    /// Names of all methods.
    pub const NAMES: [&'static str; 10] =
        ["auto", "sst", "pso", "fi_pso", "affg_pso", "cma_es", "broyden", "model", "particle", "search"];

    /// The method of that name with its defaults.
    #[must_use]
    pub fn by_name(name: &str) -> Option<Self> {
        Some(match name {
            "auto" => Self::Auto(AutoSpec::default()),
            "sst" => Self::Sst(SstSpec::default()),
            "pso" => Self::Pso(PsoSpec::default()),
            "fi_pso" => Self::FiPso(FiPsoSpec::default()),
            "affg_pso" => Self::AffgPso(AffgPsoSpec::default()),
            "cma_es" => Self::CmaEs(CmaEsSpec::default()),
            "broyden" => Self::Broyden(BroydenSpec::default()),
            "model" => Self::Model(ModelSpec::default()),
            "particle" => Self::Particle(ParticleSpec::default()),
            "search" => Self::Search(CoverSpec::default()),
            _ => return None,
        })
    }

    /// Whether the method owns a whole run, instead of searching goal by goal.
    #[must_use]
    pub fn owns_the_run(&self) -> bool {
        matches!(self, Self::Broyden(_) | Self::Model(_) | Self::Particle(_) | Self::Search(_))
    }

    /// Largest step of a joint from one trial to the next, degrees, where a method that owns the run is given one.
    #[must_use]
    pub fn max_step_deg(&self) -> Option<f64> {
        match self {
            Self::Broyden(spec) => spec.max_step_deg,
            Self::Model(spec) => spec.max_step_deg,
            Self::Particle(spec) => spec.max_step_deg,
            Self::Search(spec) => spec.max_step_deg,
            _ => None,
        }
    }

    /// The method's name, as written in presets and on the command line.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Auto(_) => "auto",
            Self::Sst(_) => "sst",
            Self::Pso(_) => "pso",
            Self::FiPso(_) => "fi_pso",
            Self::AffgPso(_) => "affg_pso",
            Self::CmaEs(_) => "cma_es",
            Self::Broyden(_) => "broyden",
            Self::Model(_) => "model",
            Self::Particle(_) => "particle",
            Self::Search(_) => "search",
        }
    }
}

/// Steady-state tournament (ECF's `SteadyStateTournament`, tournament of 3).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SstSpec {
    /// Individuals P (at least 3).
    pub population: u32,
    /// S: a goal ends after S + 1 generations without strict improvement.
    pub stagnation: u32,
    /// Probability that a child is mutated after crossover.
    pub mutation_probability: f64,
    /// What happens to genes outside their limits.
    pub bounds: BoundsRule,
    /// Four crossover operators leave gene 0 as it was in the overwritten individual, as ECF did in the published runs.
    pub ecf_gene0_quirk: bool,
    /// A parent that is the overwritten individual itself is at distance 0 from the child, as in the published runs,
    /// where both shared their memory: such a child satisfies every velocity limit of the population.
    pub ecf_shared_parent_quirk: bool,
    /// The target discrepancy is looked for only at the end of each generation, as ECF did in the published runs,
    /// instead of after each evaluation.
    pub ecf_target_at_generation_end: bool,
}

impl Default for SstSpec {
    fn default() -> Self {
        Self {
            population: 50,
            stagnation: 3,
            mutation_probability: 0.6,
            bounds: BoundsRule::Clamp,
            ecf_gene0_quirk: false,
            ecf_shared_parent_quirk: false,
            ecf_target_at_generation_end: false,
        }
    }
}
