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
    /// Four crossover operators leave gene 0 as it was in the overwritten individual, as ECF did in the published runs.
    pub ecf_gene0_quirk: bool,
}

impl Default for SstSpec {
    fn default() -> Self {
        Self { population: 50, stagnation: 3, mutation_probability: 0.6, ecf_gene0_quirk: false }
    }
}
