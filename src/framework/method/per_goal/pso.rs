//! PSO, particle swarm optimisation: every moved particle is executed.
//!
//! The published runs used ECF's swarm with w = 1.2, |v| <= 5 degrees per generation, open positions, C1 = C2 = 2, one
//! random pair per particle, the currently best particle as leader, and memories that begin at random near 0: all named
//! options of [`SwarmSpec`]. Movement and sources: the swarm's `movement` module.

use super::swarm::{Estimator, Flight, Swarm, SwarmSpec, SwarmState};
use super::{Optimizer, OptimizerError, OptimizerState, PerGoalMethod, Provenance, SearchSpace};
use crate::method::contract::{Method, Profile};
use crate::method::parameters::parameters;
use crate::random::RandomStream;

parameters! {
    /// Parameters of PSO, particle swarm optimisation.
    pub struct PsoSpec {
        /// Parameters of the swarm itself.
        pub swarm: SwarmSpec = SwarmSpec::default();
    }
}

impl Method for PsoSpec {
    fn profile(&self) -> Profile {
        Profile::PER_GOAL
    }
}

/// Estimates nothing.
#[derive(Debug)]
struct Execute;

impl Estimator for Execute {
    const METHOD: &'static str = PsoSpec::NAME;
    const PROVENANCE: Provenance = Provenance::Inherited;

    fn depends_on_order(&self) -> bool {
        false
    }
    fn may_win(&self) -> bool {
        false
    }
    fn begin(&mut self, _: &[f64]) {}
    fn estimate(&mut self, _: &Flight<'_>, _: &mut RandomStream) -> Option<f64> {
        None
    }
    fn executed(&mut self, _: &[f64], _: f64) {}
    fn save(&self, swarm: SwarmState) -> OptimizerState {
        OptimizerState::of(PsoSpec::NAME, &swarm)
    }
}

impl PerGoalMethod for PsoSpec {
    fn start(&self, space: SearchSpace, seed: u64, goal: u64) -> Result<Box<dyn Optimizer>, OptimizerError> {
        Ok(Box::new(Swarm::new(&self.swarm, Execute, space, seed, goal)?))
    }

    fn resume(&self, space: SearchSpace, state: OptimizerState) -> Result<Box<dyn Optimizer>, OptimizerError> {
        Ok(Box::new(Swarm::resume(&self.swarm, Execute, space, state.read(Self::NAME)?)?))
    }
}
