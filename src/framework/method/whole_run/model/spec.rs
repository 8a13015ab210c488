//! Parameters of MODEL-IET.

use crate::method::contract::{Effects, Knowledge, Method, Profile, SimulatorUse};
use crate::method::parameters::{Choice, parameters};
use serde::{Deserialize, Serialize};

/// Belief before the first trial.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Prior {
    /// Nothing: identification moves come first.
    #[default]
    None,
    /// The problem's robot and world as described, which the real ones need not match.
    Simulator,
}

impl Choice for Prior {
    const ALL: &'static [Self] = &[Self::None, Self::Simulator];
}

parameters! {
    /// Parameters of MODEL-IET.
    pub struct ModelSpec {
        /// Standard deviation of one observed feature; 0 for a world that is exact.
        pub noise: f64 = 0.0, in 0.0..=1e6, unit "features' unit";
        /// A goal is given up after this many trials of its own.
        pub max_tries: u32 = 15, in 1..=10_000;
        /// Size of the identification moves (of 180 degrees per stroke for prismatic joints).
        pub identification_deg: f64 = 45.0, in 0.1..=180.0, unit "degrees";
        /// Largest step of a joint from one trial to the next (of 180 degrees per stroke for prismatic joints); any step if
        /// absent.
        pub max_step_deg: Option<f64> = None, in 0.1..=1e4, unit "degrees";
        /// How many trials from another region of the joint space must bring a goal no nearer before it is called out of
        /// reach; 1 if absent, with 0 none is.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub restarts: Option<u32> = None, in 0..=100;
        /// Belief before the first trial.
        pub prior: Prior = Prior::None;
    }
}

impl Method for ModelSpec {
    fn profile(&self) -> Profile {
        let profile = Profile::whole_run(Effects::Smooth, SimulatorUse::Optional);
        Profile { learns_from_earlier_runs: true, ..profile }
    }
    fn assume(&mut self, known: &Knowledge) {
        let prior = known.simulator.map(|may_use| if may_use { Prior::Simulator } else { Prior::None });
        self.prior = prior.unwrap_or(self.prior);
        self.noise = known.noise.unwrap_or(self.noise);
    }
}

impl ModelSpec {
    /// Number of restarts that must agree before a goal is out of reach; 0 if none is to be.
    pub(super) fn restarts(&self) -> usize {
        self.restarts.map_or(1, |restarts| restarts as usize)
    }
}
