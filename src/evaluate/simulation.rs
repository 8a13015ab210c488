//! Evaluation in a simulated world, in slices on the threads for blocking work.

use crate::framework::execution::{Iet, IetState, Problem, ProblemError, Progress, RunResult, simulate};
use crate::framework::method::whole_run::Trial;
use crate::framework::robot::Chain;
use crate::framework::world::World;

/// One run in its world.
pub struct Simulation {
    iet: Iet,
    world: Box<dyn World>,
}

impl Simulation {
    /// A run from its seed.
    ///
    /// # Errors
    /// [`ProblemError`] says what is wrong with the problem.
    pub fn start(problem: &Problem, seed: u64) -> Result<Self, ProblemError> {
        Self::with(Iet::new(problem, seed)?)
    }

    /// A run from where it was saved.
    ///
    /// # Errors
    /// [`ProblemError`] when the state is not one of this problem.
    pub fn resume(problem: &Problem, state: IetState) -> Result<Self, ProblemError> {
        Self::with(Iet::resume(problem, state)?)
    }

    fn with(iet: Iet) -> Result<Self, ProblemError> {
        let world = iet.world()?;
        Ok(Self { iet, world })
    }

    /// Makes up to `budget` evaluations; blocks its thread.
    ///
    /// # Errors
    /// [`ProblemError`] when a goal ends without any executed candidate.
    pub fn advance(&mut self, budget: u64) -> Result<Progress, ProblemError> {
        simulate(&mut self.iet, self.world.as_mut(), budget)
    }

    /// Where the run stands, to be saved.
    #[must_use]
    pub fn state(&self) -> IetState {
        self.iet.state()
    }

    /// Where the run stands, to be shown.
    #[must_use]
    pub fn progress(&self) -> Progress {
        self.iet.progress()
    }

    /// Every trial so far of a method that remembers them.
    #[must_use]
    pub fn trials(&self) -> &[Trial] {
        self.iet.log()
    }

    /// The chain that moves.
    #[must_use]
    pub fn chain(&self) -> &Chain {
        self.iet.chain()
    }

    /// The finished run.
    ///
    /// # Errors
    /// [`ProblemError::Unfinished`] before the last goal has ended.
    pub fn finish(self) -> Result<RunResult, ProblemError> {
        self.iet.finish()
    }
}
