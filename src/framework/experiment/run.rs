//! One run of a plan from start to end: a pure function of plan and id.

use super::{Plan, RunId, RunRow};
use crate::execution::{self, Problem, ProblemError, RunResult};

/// Reasons why a run has no row.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The plan has no such run.
    #[error("the plan has no repetition {} of cell {}", id.repetition, id.cell)]
    Unplanned {
        /// Id of the run.
        id: RunId,
    },
    /// The problem cannot be executed.
    #[error("{action}, {setting} with seed {seed}")]
    Problem {
        /// Action of the cell.
        action: String,
        /// Setting of the cell.
        setting: String,
        /// Seed of the run.
        seed: u64,
        /// Underlying error.
        source: Box<ProblemError>,
    },
}

/// Executes run `id` of `plan` in its simulated world.
///
/// # Errors
/// [`RunError`] names the cell and seed.
pub fn run(plan: &Plan, id: RunId) -> Result<RunRow, RunError> {
    result(plan, id).map(|result| RunRow::of(id, &result))
}

/// Like [`run`]; `None` if `go_on` returns false before the end. Calling `go_on` does not change a bit of the row.
///
/// # Errors
/// As for [`run`].
pub fn run_while(plan: &Plan, id: RunId, go_on: impl Fn() -> bool) -> Result<Option<RunRow>, RunError> {
    let found = execute(plan, id, |problem, seed| execution::run_while(problem, seed, go_on))?;
    Ok(found.map(|result| RunRow::of(id, &result)))
}

/// Like [`run`], with every goal's joints and observation.
///
/// # Errors
/// As for [`run`].
pub fn result(plan: &Plan, id: RunId) -> Result<RunResult, RunError> {
    execute(plan, id, execution::run)
}

fn execute<T>(
    plan: &Plan,
    id: RunId,
    work: impl FnOnce(&Problem, u64) -> Result<T, ProblemError>,
) -> Result<T, RunError> {
    let cell = plan.cell(id).ok_or(RunError::Unplanned { id })?;
    let seed = plan.seed_of(id);
    work(&cell.problem, seed).map_err(|source| RunError::Problem {
        action: cell.spec.action.clone(),
        setting: cell.spec.setting.clone(),
        seed,
        source: Box::new(source),
    })
}

impl RunRow {
    /// The row of a finished run.
    #[must_use]
    pub fn of(id: RunId, result: &RunResult) -> Self {
        Self {
            id,
            seed: result.seed,
            evaluations: result.evaluations,
            discrepancy: result.discrepancy,
            true_discrepancy: result.true_discrepancy,
            painted_percent: result.painted_percent,
            invalid: !result.valid,
            evaluations_per_goal: result.goals.iter().map(|goal| goal.evaluations).collect(),
            provenance: result.tally,
            digest: result.digest.clone(),
        }
    }
}
