//! Parameters of CMA-ES as users write them. Lengths are shares of a joint's range.

use crate::method::contract::{Method, Profile};
use crate::method::parameters::parameters;
use crate::method::per_goal::BoundsRule;
use crate::range::above;

parameters! {
    /// Parameters of CMA-ES.
    pub struct CmaEsSpec {
        /// Candidates lambda of a generation; 4 + 3 ln(joints) if absent.
        pub population: Option<u32> = None, in 4..=100_000;
        /// Step size of a search that begins anywhere, as a share of each joint's range.
        pub step: f64 = 0.3, in above(0.0).up_to(1.0);
        /// Step size of a search that begins at the previous goal's result, as a share of each joint's range; if absent,
        /// every goal's search begins anywhere.
        pub warm_step: Option<f64> = Some(0.1), in above(0.0).up_to(1.0);
        /// A goal ends when the largest standard deviation is below this share of a joint's range.
        pub precision: f64 = 0.02, in above(0.0).up_to(1.0);
        /// S: a search is restarted when more than S generations brought no strict improvement before it got that
        /// precise, or when a whole generation had one fitness.
        pub stagnation: u32 = 10;
        /// Restarts of a goal, each anywhere and with `restart_growth` times the candidates; then the goal ends.
        pub restarts: u32 = 9, in 0..=100;
        /// Factor of lambda at each restart.
        pub restart_growth: f64 = 2.0, in 1.0..=10.0;
        /// Treatment of genes outside their limits.
        pub bounds: BoundsRule = BoundsRule::Clamp;
    }
}

impl Method for CmaEsSpec {
    fn profile(&self) -> Profile {
        Profile::PER_GOAL
    }
}

/// Most candidates of a generation, restarts included.
const MOST: u32 = 100_000;

impl CmaEsSpec {
    /// lambda after so many restarts, for n joints.
    pub(super) fn lambda(&self, n: usize, restarts: u32) -> usize {
        let first = self.population.map_or_else(|| 4.0 + (3.0 * (n as f64).ln()).floor(), f64::from);
        let grown = first * self.restart_growth.powf(f64::from(restarts));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "4 to 100000")]
        let lambda = grown.min(f64::from(MOST)) as usize;
        lambda
    }
}
