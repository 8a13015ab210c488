//! Evaluation in the problem's simulated world.

use crate::app::ports::{Evaluator, EvaluatorError, Evaluators, RunContext, Trials};
use crate::framework::execution::{Observations, simulated_world};
use crate::framework::method::per_goal::Provenance;
use crate::framework::world::World;
use async_trait::async_trait;

/// Maximum number of candidates per call; the cost of a call is negligible beside theirs.
const BATCH: usize = 64;

/// The simulated world of one run.
pub struct Simulation {
    world: Box<dyn World>,
    /// Number of poses of the prefix that the world has executed.
    committed: usize,
    scratch: Vec<f64>,
}

impl Simulation {
    /// Builds the world of `run`; no pose has been executed in it.
    ///
    /// # Errors
    /// [`EvaluatorError::Problem`] if the world cannot be built.
    pub fn new(run: RunContext<'_>) -> Result<Self, EvaluatorError> {
        let world = simulated_world(run.problem, run.chain, run.seed)?;
        let scratch = vec![0.0; world.features().len()];
        Ok(Self { world, committed: 0, scratch })
    }
}

#[async_trait]
impl Evaluator for Simulation {
    fn provenance(&self) -> Provenance {
        Provenance::Simulated
    }

    fn most_at_once(&self) -> usize {
        BATCH
    }

    async fn evaluate(&mut self, trials: Trials<'_>, seen: &mut Observations) -> Result<(), EvaluatorError> {
        for joints in trials.prefix.iter().skip(self.committed) {
            self.world.commit(joints, &mut self.scratch);
        }
        self.committed = trials.prefix.len();
        for (id, joints) in trials.batch.iter() {
            self.world.observe(joints, seen.observed(id, joints));
        }
        Ok(())
    }
}

/// Opens the simulated world of every problem.
#[derive(Debug, Clone, Copy, Default)]
pub struct Simulations;

#[async_trait]
impl Evaluators for Simulations {
    async fn open(&self, run: RunContext<'_>) -> Result<Box<dyn Evaluator>, EvaluatorError> {
        Ok(Box::new(Simulation::new(run)?))
    }
}
