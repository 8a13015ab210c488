//! Parameters of PARTICLE-IET.

use crate::method::contract::{Effects, Method, Profile, SimulatorUse};
use crate::method::parameters::parameters;

parameters! {
    /// Parameters of PARTICLE-IET.
    pub struct ParticleSpec {
        /// The run gives up after this many evaluations; if absent, after 4 per cell of the surface, at least 400 and at most
        /// 10000.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub max_evaluations: Option<u32> = None, in 1..=100_000;
        /// Draws of the robot.
        pub particles: u32 = 80, in 1..=1024;
        /// Poses to choose from, spread evenly over the joints' ranges; poses aimed at open cells are added to them.
        pub poses: u32 = 1024, in 1..=8192;
        /// Standard deviation of a link's relative length.
        pub link_share: f64 = 0.046, in 0.0..=0.5;
        /// Standard deviation of each coordinate of the base.
        pub base_shift_m: f64 = 0.03, in 0.0..=10.0, unit "m";
        /// Largest step of a joint from one trial to the next (of 180 degrees per stroke for prismatic joints); any step if
        /// absent.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub max_step_deg: Option<f64> = None, in 0.1..=1e4, unit "degrees";
    }
}

impl Method for ParticleSpec {
    fn profile(&self) -> Profile {
        Profile::whole_run(Effects::Accumulating, SimulatorUse::Required)
    }
}
