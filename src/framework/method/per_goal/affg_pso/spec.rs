//! Parameters of AFFG-PSO. Lengths are genes: rad (or m).

use crate::method::contract::{Method, Profile};
use crate::method::parameters::parameters;
use crate::method::per_goal::swarm::SwarmSpec;
use crate::range::above;

parameters! {
    /// Parameters of AFFG-PSO, a particle swarm with adaptive fuzzy fitness granulation.
    pub struct AffgPsoSpec {
        /// Parameters of the swarm itself.
        pub swarm: SwarmSpec = SwarmSpec::default();
        /// alpha: threshold T = alpha mean(f) / min(f) of the swarm.
        pub alpha: f64 = 0.2, in 0.0..;
        /// beta: a granule's width grows with its fitness, omega exp(beta f).
        pub beta: f64 = 0.0;
        /// omega: width of a granule of fitness 0.
        pub omega: f64 = 5.0_f64.to_radians(), in above(0.0), unit "rad or m";
        /// M: generations a granule lives longer each time it is used.
        pub life_gain: u32 = 1;
        /// N: granules kept.
        pub granules: u32 = 3, in 1..=10_000;
        /// A granule of fitness 0 is similar to nothing, so that a goal is never taken for reached without executing.
        pub zero_rule: bool = true;
        /// A particle whose fitness was taken from a granule may be a goal's result, as in the published runs.
        pub unexecuted_may_win: bool = false;
    }
}

impl Method for AffgPsoSpec {
    fn profile(&self) -> Profile {
        Profile::PER_GOAL
    }
}
