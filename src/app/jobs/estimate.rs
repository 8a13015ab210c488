//! What a job will cost: first repetitions are run for a short while, and what they took is scaled up.

use super::resolve::Resolved;
use super::{CostEstimate, Work};
use crate::app::ports::Clock;
use crate::app::{AppError, chain_text};
use crate::framework::execution::{Iet, Problem, simulate};
use std::time::Duration;

/// Evaluations of a trial: enough for most problems to end.
const TRIAL_EVALUATIONS: u64 = 50_000;
/// Time for all trials of one estimate.
const TRIAL_TIME: Duration = Duration::from_millis(500);
/// A trial on a robot, as far as an estimate knows.
const ROBOT_TRIAL_S: f64 = 15.0;

/// Where the first repetition of a problem came in its time.
struct Trial {
    evaluations: u64,
    goals: usize,
    goal_index: usize,
    finished: bool,
    took_s: f64,
}

impl Trial {
    /// Evaluations of the whole repetition, as far as can be told.
    fn whole(&self) -> f64 {
        let evaluations = self.evaluations as f64;
        if self.finished { evaluations } else { evaluations * self.goals as f64 / (self.goal_index as f64 + 0.5) }
    }
}

/// The cost of a resolved job.
pub(super) fn estimate(resolved: &Resolved, clock: &dyn Clock) -> Result<CostEstimate, AppError> {
    match (&resolved.work, &resolved.experiment) {
        (Work::Execution(work), _) => {
            let trial = try_out(&work.problem, work.seed, TRIAL_TIME, clock)?;
            let basis = if trial.finished {
                "the first repetition, simulated to its end".to_owned()
            } else {
                format!("{} of {} goals of the first repetition, simulated", trial.goal_index, trial.goals)
            };
            let evaluations = trial.whole() * f64::from(work.repetitions);
            let paced_s = work.max_evaluations_per_s.map_or(0.0, |rate| evaluations / rate);
            Ok(cost(evaluations, &[trial], paced_s, basis))
        }
        (Work::Experiment { .. }, Some((_, plan))) => {
            let time = TRIAL_TIME / u32::try_from(plan.cells.len()).unwrap_or(u32::MAX).max(1);
            let trials = plan.cells.iter().map(|cell| try_out(&cell.problem, plan.seed, time, clock));
            let trials = trials.collect::<Result<Vec<_>, _>>()?;
            let evaluations = trials.iter().map(Trial::whole).sum::<f64>() * f64::from(plan.repetitions);
            let ended = trials.iter().filter(|trial| trial.finished).count();
            let basis = format!(
                "the first repetition of each of {} cells, of which {ended} were simulated to their end; one core",
                trials.len()
            );
            Ok(cost(evaluations, &trials, 0.0, basis))
        }
        _ => {
            let basis = "a generalization evaluates nothing".to_owned();
            Ok(CostEstimate { evaluations: 0, simulated_s: 0.1, robot_s: 0.0, basis })
        }
    }
}

fn cost(evaluations: f64, trials: &[Trial], least_s: f64, basis: String) -> CostEstimate {
    let tried = trials.iter().map(|trial| trial.evaluations).sum::<u64>().max(1);
    let per_evaluation_s = trials.iter().map(|trial| trial.took_s).sum::<f64>() / tried as f64;
    CostEstimate {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count of evaluations, >= 0")]
        evaluations: evaluations as u64,
        simulated_s: (evaluations * per_evaluation_s).max(least_s),
        robot_s: evaluations * ROBOT_TRIAL_S,
        basis,
    }
}

fn try_out(problem: &Problem, seed: u64, time: Duration, clock: &dyn Clock) -> Result<Trial, AppError> {
    let wrong =
        |error: &(dyn std::error::Error + 'static)| AppError::field("/execution", "invalid_problem", chain_text(error));
    let mut iet = Iet::new(problem, seed).map_err(|error| wrong(&error))?;
    let mut place = iet.world().map_err(|error| wrong(&error))?;
    let started = clock.elapsed();
    let elapsed = || clock.elapsed().saturating_sub(started);
    let mut progress = iet.progress();
    while !progress.finished && progress.evaluations < TRIAL_EVALUATIONS && elapsed() < time {
        progress = simulate(&mut iet, place.as_mut(), 1000).map_err(|error| wrong(&error))?;
    }
    Ok(Trial {
        evaluations: progress.evaluations,
        goals: progress.goals,
        goal_index: progress.goal_index,
        finished: progress.finished,
        took_s: elapsed().as_secs_f64(),
    })
}
