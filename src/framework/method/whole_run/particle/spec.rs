//! Parameters of PARTICLE-IET.

use crate::method::contract::{Effects, Method, Profile, SimulatorUse};
use crate::method::parameters::{Parameters, parameters};
use crate::range::{OutOfRange, Range};
use crate::world::WorldProperties;

/// Most times a pose is compared with a cell when robots are drawn: a second of work.
const MOST_COMPARISONS: f64 = 67_108_864.0;

parameters! {
    /// Parameters of PARTICLE-IET.
    pub struct ParticleSpec {
        /// The run gives up after this many evaluations.
        pub max_evaluations: u32 = 400, in 1..=100_000;
        /// Draws of the robot.
        pub particles: u32 = 80, in 1..=1024;
        /// Poses to choose from.
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

    fn check(&self, world: &WorldProperties) -> Result<(), OutOfRange> {
        self.check_ranges()?;
        let cells = world.surface.map_or(1, |surface| surface.cells());
        let comparisons = f64::from(self.poses) * f64::from(self.particles) * cells as f64;
        Range::from(1.0..=MOST_COMPARISONS).check("poses x particles x cells", None, comparisons)
    }
}
