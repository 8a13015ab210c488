//! Parameters of SST. Defaults are the algorithm itself; each quirk of the published runs is an option, on only in the
//! `paper-*` presets.

use crate::method::contract::{Method, Profile};
use crate::method::parameters::parameters;
use crate::method::per_goal::BoundsRule;

parameters! {
    /// Parameters of the steady-state tournament (ECF's `SteadyStateTournament`, tournament of 3).
    pub struct SstSpec {
        /// Individuals P.
        pub population: u32 = 50, in 3..=100_000;
        /// S: a goal ends after S + 1 generations without strict improvement.
        pub stagnation: u32 = 3;
        /// Probability that a child is mutated after crossover.
        pub mutation_probability: f64 = 0.6, in 0.0..=1.0;
        /// Treatment of genes outside their limits.
        pub bounds: BoundsRule = BoundsRule::Clamp;
        /// Four crossover operators leave gene 0 as it was in the overwritten individual, as ECF did in the published runs.
        pub ecf_gene0_quirk: bool = false;
        /// A parent that is the overwritten individual itself is at distance 0 from the child, as in the published runs,
        /// where both shared their memory: such a child satisfies every velocity limit of the population.
        pub ecf_shared_parent_quirk: bool = false;
        /// The target discrepancy is looked for only at the end of each generation, as ECF did in the published runs,
        /// instead of after each evaluation.
        pub ecf_target_at_generation_end: bool = false;
    }
}

impl Method for SstSpec {
    fn profile(&self) -> Profile {
        Profile::PER_GOAL
    }
}
