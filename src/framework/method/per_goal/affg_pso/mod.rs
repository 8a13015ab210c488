//! AFFG-PSO, adaptive fuzzy fitness granulation: a moved particle similar enough to an executed one takes its fitness.
//!
//! When a generation begins, every granule's life falls by 1 and the threshold is set to
//! `T = alpha mean(f) / min(f)` over the swarm's finite fitness values (100000 if the least is 0): a swarm that
//! agrees on its fitness trusts its granules more. A moved particle whose most similar granule has s > T takes that
//! granule's fitness without an evaluation; else it is executed and becomes a granule. Granules, similarity and
//! source: the `granules` module.
//!
//! The best fitness of a swarm may then belong to a particle that took it from a granule, never executed; it wins only
//! with `unexecuted_may_win`, and its goal then reports both its value and the true one.

mod granules;
mod spec;

pub use spec::AffgPsoSpec;

use super::swarm::{Estimator, Flight, Swarm, SwarmState};
use super::{Optimizer, OptimizerError, OptimizerState, PerGoalMethod, Provenance, SearchSpace};
use crate::random::RandomStream;
use granules::Granules;
use serde::{Deserialize, Serialize};

/// Threshold if the least fitness is 0: no similarity reaches it.
const UNREACHABLE: f64 = 100_000.0;

/// A saved swarm with its granules.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AffgState {
    swarm: SwarmState,
    granules: Granules,
    threshold: f64,
}

#[derive(Debug)]
struct Granulation {
    spec: AffgPsoSpec,
    granules: Granules,
    threshold: f64,
}

impl Estimator for Granulation {
    const METHOD: &'static str = AffgPsoSpec::NAME;
    const PROVENANCE: Provenance = Provenance::Granule;

    fn depends_on_order(&self) -> bool {
        true
    }
    fn may_win(&self) -> bool {
        self.spec.unexecuted_may_win
    }
    fn begin(&mut self, fitness: &[f64]) {
        self.granules.age();
        self.threshold = threshold(self.spec.alpha, fitness);
    }
    fn estimate(&mut self, flight: &Flight<'_>, _: &mut RandomStream) -> Option<f64> {
        self.granules.stand_in(&self.spec, flight.x, self.threshold)
    }
    fn executed(&mut self, x: &[f64], fitness: f64) {
        self.granules.add(&self.spec, x, fitness);
    }
    fn save(&self, swarm: SwarmState) -> OptimizerState {
        OptimizerState::of(
            Self::METHOD,
            &AffgState { swarm, granules: self.granules.clone(), threshold: self.threshold },
        )
    }
}

fn threshold(alpha: f64, fitness: &[f64]) -> f64 {
    let finite = || fitness.iter().copied().filter(|f| f.is_finite());
    let least = finite().fold(f64::INFINITY, f64::min);
    if least == 0.0 || least.is_infinite() {
        return UNREACHABLE;
    }
    alpha * (finite().sum::<f64>() / finite().count() as f64) / least
}

impl PerGoalMethod for AffgPsoSpec {
    fn start(&self, space: SearchSpace, seed: u64, goal: u64) -> Result<Box<dyn Optimizer>, OptimizerError> {
        OptimizerError::check(Self::NAME, self)?;
        let granulation = Granulation { spec: self.clone(), granules: Granules::default(), threshold: UNREACHABLE };
        Ok(Box::new(Swarm::new(&self.swarm, granulation, space, seed, goal)?))
    }

    fn resume(&self, space: SearchSpace, state: OptimizerState) -> Result<Box<dyn Optimizer>, OptimizerError> {
        OptimizerError::check(Self::NAME, self)?;
        let state: AffgState = state.read(Self::NAME)?;
        if !state.granules.fit(space.lower.len()) {
            let expected = space.lower.len();
            return Err(OptimizerError::Shape { method: Self::NAME, what: "granule genes", found: 0, expected });
        }
        let granulation = Granulation { spec: self.clone(), granules: state.granules, threshold: state.threshold };
        Ok(Box::new(Swarm::resume(&self.swarm, granulation, space, state.swarm)?))
    }

    fn unexecuted_may_win(&self) -> bool {
        self.unexecuted_may_win
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_threshold_is_the_mean_over_the_least() {
        assert!((threshold(0.2, &[1.0, 2.0, 6.0]) - 0.6).abs() < 1e-15);
        assert!((threshold(0.2, &[1.0, 3.0, f64::INFINITY]) - 0.4).abs() < 1e-15);
        assert_eq!(threshold(0.2, &[0.0, 2.0]).to_bits(), UNREACHABLE.to_bits());
        assert_eq!(threshold(0.2, &[f64::INFINITY]).to_bits(), UNREACHABLE.to_bits());
    }
}
