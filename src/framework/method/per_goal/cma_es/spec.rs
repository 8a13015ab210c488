//! Parameters of CMA-ES as users write them. Lengths are shares of a joint's range.

use crate::method::per_goal::{BoundsRule, OptimizerError};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Parameters of CMA-ES.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CmaEsSpec {
    /// Candidates lambda of a generation (at least 4); 4 + 3 ln(joints) when absent.
    pub population: Option<u32>,
    /// Step size of a search that begins anywhere, as a share of each joint's range.
    pub step: f64,
    /// Step size of a search that begins at the previous goal's result; absent, every goal's search begins anywhere.
    pub warm_step: Option<f64>,
    /// A goal ends when the largest standard deviation is below this share of a joint's range.
    pub precision: f64,
    /// S: a search is restarted when more than S generations brought no strict improvement before it got that precise,
    /// or when a whole generation had one fitness.
    pub stagnation: u32,
    /// Restarts of a goal, each anywhere and with `restart_growth` times the candidates; then the goal ends.
    pub restarts: u32,
    /// Factor of lambda at each restart (1 to 10).
    pub restart_growth: f64,
    /// What happens to genes outside their limits.
    pub bounds: BoundsRule,
}

impl Default for CmaEsSpec {
    fn default() -> Self {
        Self {
            population: None,
            step: 0.3,
            warm_step: Some(0.1),
            precision: 0.02,
            stagnation: 10,
            restarts: 9,
            restart_growth: 2.0,
            bounds: BoundsRule::Clamp,
        }
    }
}

/// Most candidates of a generation, restarts included.
const MOST: u32 = 100_000;

impl CmaEsSpec {
    /// # Errors
    /// [`OptimizerError::Parameter`] for a parameter out of its range.
    pub(super) fn check(&self) -> Result<(), OptimizerError> {
        let out = |parameter, value, expected| {
            Err(OptimizerError::Parameter { method: "cma_es", parameter, value, expected })
        };
        if let Some(population) = self.population.filter(|p| !(4..=MOST).contains(p)) {
            return out("population", f64::from(population), "4 to 100000 are allowed");
        }
        let shares =
            [("step", self.step), ("warm_step", self.warm_step.unwrap_or(self.step)), ("precision", self.precision)];
        for (parameter, value) in shares {
            if !(value > 0.0 && value <= 1.0) {
                return out(parameter, value, "a share above 0 and up to 1 is allowed");
            }
        }
        if !(1.0..=10.0).contains(&self.restart_growth) {
            return out("restart_growth", self.restart_growth, "1 to 10 are allowed");
        }
        if self.restarts > 100 {
            return out("restarts", f64::from(self.restarts), "0 to 100 are allowed");
        }
        Ok(())
    }

    /// lambda after so many restarts, for n joints.
    pub(super) fn lambda(&self, n: usize, restarts: u32) -> usize {
        let first = self.population.map_or_else(|| 4.0 + (3.0 * (n as f64).ln()).floor(), f64::from);
        let grown = first * self.restart_growth.powf(f64::from(restarts));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "4 to 100000")]
        let lambda = grown.min(f64::from(MOST)) as usize;
        lambda
    }
}
