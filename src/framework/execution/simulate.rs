//! Runs an execution in a simulated world, slice by slice.

use super::error::ProblemError;
use super::iet::Iet;
use super::observations::Observations;
use super::result::{Progress, RunResult};
use super::spec::Problem;
use crate::method::per_goal::{Batch, Provenance};
use crate::robot::Chain;
use crate::world::{self, World};

/// The simulated world of a run of `problem` with `chain` and `seed`, as described or disturbed (`reality` of the
/// problem).
///
/// # Errors
/// [`ProblemError::World`] if the world cannot be built.
pub fn simulated_world(problem: &Problem, chain: &Chain, seed: u64) -> Result<Box<dyn World>, ProblemError> {
    Ok(world::simulated(&problem.world, problem.execution.reality.as_ref(), chain, seed)?)
}

/// Number of candidates requested at once.
const BATCH: u64 = 64;

/// Makes up to `budget` evaluations of `iet` in `world`, which is first brought to the run's prefix. Callers may slice
/// a run to save it, cancel it or report on it: the result is the same to the last bit.
///
/// # Errors
/// [`ProblemError`] if a goal ends without any executed candidate.
pub fn simulate(iet: &mut Iet, world: &mut dyn World, budget: u64) -> Result<Progress, ProblemError> {
    let (genes, features) = (iet.chain().len(), iet.world_features());
    let mut batch = Batch::new(genes, 0);
    let mut observations = Observations::new(genes, features, Provenance::Simulated);
    let mut scratch = vec![0.0; features];
    world.reset();
    let mut committed = 0;
    let mut left = budget;
    while left > 0 && !iet.is_finished() {
        for joints in iet.prefix().skip(committed) {
            world.commit(joints, &mut scratch);
            committed += 1;
        }
        batch.clear(usize::try_from(left.min(BATCH)).unwrap_or(1));
        iet.ask(&mut batch);
        observations.clear();
        for (id, joints) in batch.iter() {
            world.observe(joints, observations.observed(id, joints));
        }
        left -= (batch.len() as u64).min(left).max(1);
        iet.tell(&observations)?;
    }
    Ok(iet.progress())
}

/// Number of evaluations between two calls of `go_on`.
const SLICE: u64 = 1024;

/// Executes a whole run as [`run`] does; `None` if `go_on` returns false before the end.
///
/// # Errors
/// As for [`run`].
pub fn run_while(problem: &Problem, seed: u64, go_on: impl Fn() -> bool) -> Result<Option<RunResult>, ProblemError> {
    let mut iet = Iet::new(problem, seed)?;
    let mut world = iet.world()?;
    while go_on() {
        if simulate(&mut iet, world.as_mut(), SLICE)?.finished {
            return iet.finish().map(Some);
        }
    }
    Ok(None)
}

/// Executes a whole run of `problem` in its world.
///
/// # Errors
/// As for [`Iet::new`] and [`simulate`].
pub fn run(problem: &Problem, seed: u64) -> Result<RunResult, ProblemError> {
    let mut iet = Iet::new(problem, seed)?;
    let mut world = iet.world()?;
    simulate(&mut iet, world.as_mut(), u64::MAX)?;
    iet.finish()
}
