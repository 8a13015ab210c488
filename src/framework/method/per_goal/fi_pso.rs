//! FI-PSO, fitness inheritance by the flight formula: a moved particle inherits with some probability.
//!
//! Symbols: fitness f before the move, of the own memory f_p, of the leader's memory f_g; a = c1 R1, b = c2 R2 of the
//! move (means over the genes). Inherited: `f + (a (f_p - f) + b (f_g - f)) / (1 + a + b)`, a convex combination: it is
//! never below the best of the three, so an inherited particle is never strictly better than the executed ones. It
//! takes no evaluation. If one of the three is not finite, the particle is executed.
//!
//! Source: M. Reyes-Sierra, C. A. Coello Coello, "Fitness inheritance in multi-objective particle swarm optimization",
//! IEEE Swarm Intelligence Symposium 2005, 116-123 (flight formula in objective space).

use super::swarm::{Estimator, Flight, Swarm, SwarmSpec, SwarmState};
use super::{Optimizer, OptimizerError, OptimizerState, PerGoalMethod, Provenance, SearchSpace};
use crate::method::contract::{Method, Profile};
use crate::method::parameters::parameters;
use crate::random::RandomStream;

parameters! {
    /// Parameters of FI-PSO, a particle swarm whose particles inherit some of their fitness.
    pub struct FiPsoSpec {
        /// Parameters of the swarm itself.
        pub swarm: SwarmSpec = SwarmSpec::default();
        /// Probability that a moved particle inherits its fitness instead of being executed.
        pub inheritance_probability: f64 = 0.55, in 0.0..=1.0;
        /// A particle whose fitness was inherited may be a goal's result, as in the published runs.
        pub unexecuted_may_win: bool = false;
    }
}

impl Method for FiPsoSpec {
    fn profile(&self) -> Profile {
        Profile::PER_GOAL
    }
}

/// Inherits with that probability.
#[derive(Debug)]
struct Inheritance {
    probability: f64,
    may_win: bool,
}

impl Estimator for Inheritance {
    const METHOD: &'static str = FiPsoSpec::NAME;
    const PROVENANCE: Provenance = Provenance::Inherited;

    fn depends_on_order(&self) -> bool {
        false
    }
    fn may_win(&self) -> bool {
        self.may_win
    }
    fn begin(&mut self, _: &[f64]) {}
    fn estimate(&mut self, flight: &Flight<'_>, rng: &mut RandomStream) -> Option<f64> {
        if rng.unit() >= self.probability {
            return None;
        }
        let inherited = inherited(flight);
        inherited.is_finite().then_some(inherited)
    }
    fn executed(&mut self, _: &[f64], _: f64) {}
    fn save(&self, swarm: SwarmState) -> OptimizerState {
        OptimizerState::of(FiPsoSpec::NAME, &swarm)
    }
}

fn inherited(flight: &Flight<'_>) -> f64 {
    let [own, leader] = flight.weights;
    let towards = own * (flight.memory - flight.fitness) + leader * (flight.leader - flight.fitness);
    flight.fitness + towards / (1.0 + own + leader)
}

fn estimator(spec: &FiPsoSpec) -> Result<Inheritance, OptimizerError> {
    OptimizerError::check(FiPsoSpec::NAME, spec)?;
    Ok(Inheritance { probability: spec.inheritance_probability, may_win: spec.unexecuted_may_win })
}

impl PerGoalMethod for FiPsoSpec {
    fn start(&self, space: SearchSpace, seed: u64, goal: u64) -> Result<Box<dyn Optimizer>, OptimizerError> {
        Ok(Box::new(Swarm::new(&self.swarm, estimator(self)?, space, seed, goal)?))
    }

    fn resume(&self, space: SearchSpace, state: OptimizerState) -> Result<Box<dyn Optimizer>, OptimizerError> {
        Ok(Box::new(Swarm::resume(&self.swarm, estimator(self)?, space, state.read(Self::NAME)?)?))
    }

    fn unexecuted_may_win(&self) -> bool {
        self.unexecuted_may_win
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn flight(fitness: f64, memory: f64, leader: f64, weights: [f64; 2]) -> Flight<'static> {
        Flight { x: &[], fitness, memory, leader, weights }
    }

    #[test]
    fn follows_the_formula() {
        // 10 + (1 (4 - 10) + 2 (2 - 10)) / 4
        assert!((inherited(&flight(10.0, 4.0, 2.0, [1.0, 2.0])) - 4.5).abs() < 1e-12);
        let mut always = Inheritance { probability: 1.0, may_win: false };
        let unknown = flight(f64::INFINITY, 4.0, 2.0, [1.0, 2.0]);
        assert_eq!(always.estimate(&unknown, &mut RandomStream::new(1, 0)), None, "nothing to inherit from");
    }

    proptest! {
        #[test]
        fn lies_between_what_it_is_made_of(
            f in 0.0..1e3_f64, own in 0.0..1e3_f64, leader in 0.0..1e3_f64, a in 0.0..2.0_f64, b in 0.0..2.0_f64,
        ) {
            let found = inherited(&flight(f, own, leader, [a, b]));
            prop_assert!(found >= f.min(own).min(leader) - 1e-9 && found <= f.max(own).max(leader) + 1e-9);
        }
    }
}
