//! `auto`: the wishes by which a method is chosen for a problem.

use super::contract::{Effects, Knowledge, Method, Needs, Profile, Scope, SimulatorUse};
use super::parameters::parameters;

parameters! {
    /// Wishes by which a method is chosen, beyond the problem itself.
    pub struct AutoSpec {
        /// The description of robot and world may be used as a simulator, which need not be right.
        pub simulator: bool = false;
        /// Evaluations cost nothing, as in simulation: the best result counts instead of few evaluations.
        pub free_evaluations: bool = false;
        /// Standard deviation of one observed feature, for methods that take noise into account.
        pub noise: f64 = 0.0, in 0.0..=1e6, unit "features' unit";
    }
}

impl Method for AutoSpec {
    fn profile(&self) -> Profile {
        Profile {
            scope: Scope::Chosen,
            few_evaluations: false,
            learns_from_earlier_runs: false,
            needs: Needs { effects: Effects::Any, reset: false, simulator: SimulatorUse::Optional },
        }
    }

    fn assume(&mut self, known: &Knowledge) {
        self.simulator = known.simulator.unwrap_or(self.simulator);
        self.noise = known.noise.unwrap_or(self.noise);
    }
}
