//! The problem's robot and world as described, as MODEL-IET's prior.

use crate::method::whole_run::planner::{FeatureMap, RunSetup};
use crate::world::{self, World, WorldError};

/// A simulated world that shows the features of the goals.
pub(super) struct SimulatedWorld {
    world: Box<dyn World>,
    /// For each feature of the goals, its index among the world's.
    select: Vec<usize>,
    shown: Vec<f64>,
}

impl SimulatedWorld {
    /// # Errors
    /// [`WorldError`] if the world cannot be built.
    pub fn new(run: &RunSetup<'_>) -> Result<Self, WorldError> {
        let world = world::build(run.world, run.chain)?;
        let shown = vec![0.0; world.features().len()];
        Ok(Self { world, select: run.select.to_vec(), shown })
    }
}

impl FeatureMap for SimulatedWorld {
    fn predict(&mut self, joints: &[f64], features: &mut [f64]) {
        self.world.observe(joints, &mut self.shown);
        for (value, &source) in features.iter_mut().zip(&self.select) {
            *value = self.shown[source];
        }
    }
}
