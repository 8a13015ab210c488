//! Methods and their parameters as users write them; `name` picks one. Defaults are the algorithm as its literature
//! defines it; each quirk of the published runs is a named option, on only in the `paper-*` presets.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// An optimisation method with its parameters.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(tag = "name", rename_all = "snake_case")]
pub enum MethodSpec {
    /// Steady-state tournament.
    Sst(SstSpec),
}

impl MethodSpec {
    /// The method's name, as written in presets and on the command line.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Sst(_) => "sst",
        }
    }
}

/// What happens to a gene that an operator puts outside its limits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum BoundsRule {
    /// It is put on the nearest limit: every candidate can be executed.
    #[default]
    Clamp,
    /// Nothing, as in the published runs: a pose may be found that the robot cannot take.
    Open,
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
            ecf_target_at_generation_end: false,
        }
    }
}
