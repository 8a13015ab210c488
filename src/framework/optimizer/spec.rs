//! Methods and their parameters as users write them; `name` picks one. Defaults are the algorithm as its literature
//! defines it; each quirk of the published runs is a named option, on only in the `paper-*` presets.

use super::bounds::BoundsRule;
use super::swarm::{AffgPsoSpec, FiPsoSpec, PsoSpec};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// An optimisation method with its parameters.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(tag = "name", rename_all = "snake_case")]
pub enum MethodSpec {
    /// Steady-state tournament.
    Sst(SstSpec),
    /// Particle swarm.
    Pso(PsoSpec),
    /// Particle swarm with fitness inheritance.
    FiPso(FiPsoSpec),
    /// Particle swarm with adaptive fuzzy fitness granulation.
    AffgPso(AffgPsoSpec),
}

impl MethodSpec {
    /// Names of all methods.
    pub const NAMES: [&'static str; 4] = ["sst", "pso", "fi_pso", "affg_pso"];

    /// The method of that name with its defaults.
    #[must_use]
    pub fn by_name(name: &str) -> Option<Self> {
        Some(match name {
            "sst" => Self::Sst(SstSpec::default()),
            "pso" => Self::Pso(PsoSpec::default()),
            "fi_pso" => Self::FiPso(FiPsoSpec::default()),
            "affg_pso" => Self::AffgPso(AffgPsoSpec::default()),
            _ => return None,
        })
    }

    /// The method's name, as written in presets and on the command line.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Sst(_) => "sst",
            Self::Pso(_) => "pso",
            Self::FiPso(_) => "fi_pso",
            Self::AffgPso(_) => "affg_pso",
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
