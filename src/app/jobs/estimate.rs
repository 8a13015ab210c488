//! Cost estimates: simulates first repetitions for a short time and extrapolates.

use super::resolved::Resolved;
use crate::app::chain_text;
use crate::app::model::{AppError, CostEstimate, Work};
use crate::app::ports::Clock;
use crate::framework::execution::{Preview, Problem, in_words};
use std::time::Duration;

/// Time for all previews of one estimate.
const PREVIEW_TIME: Duration = Duration::from_millis(500);

/// A preview and the time it took.
struct Timed {
    preview: Preview,
    took_s: f64,
}

/// Cost of a resolved job if a trial on a robot takes `robot_trial_s` seconds.
pub(super) fn estimate(resolved: &Resolved, robot_trial_s: f64, clock: &dyn Clock) -> Result<CostEstimate, AppError> {
    match (&resolved.work, &resolved.experiment) {
        (Work::Execution(work), _) => {
            let first = try_out(&work.problem, work.seed, PREVIEW_TIME, clock)?;
            let basis = first.preview.basis();
            let evaluations = first.preview.whole() * f64::from(work.repetitions);
            let paced_s = work.max_evaluations_per_s.map_or(0.0, |rate| evaluations / rate);
            Ok(cost(evaluations, robot_trial_s, &[first], paced_s, basis))
        }
        (Work::Experiment { .. }, Some((_, plan))) => {
            let time = PREVIEW_TIME / u32::try_from(plan.cells.len()).unwrap_or(u32::MAX).max(1);
            let previews = plan.cells.iter().map(|cell| try_out(&cell.problem, plan.seed, time, clock));
            let previews = previews.collect::<Result<Vec<_>, _>>()?;
            let evaluations = previews.iter().map(|p| p.preview.whole()).sum::<f64>() * f64::from(plan.repetitions);
            let ended = previews.iter().filter(|p| p.preview.finished).count();
            let basis = format!(
                "the first repetition of each of {} cells, {ended} of them simulated to the end; one core",
                previews.len()
            );
            Ok(cost(evaluations, robot_trial_s, &previews, 0.0, basis))
        }
        _ => {
            let basis = "a generalization needs no evaluations".to_owned();
            Ok(CostEstimate { evaluations: 0, simulated_s: 0.1, robot_s: 0.0, text: basis.clone(), basis })
        }
    }
}

fn cost(evaluations: f64, robot_trial_s: f64, previews: &[Timed], least_s: f64, basis: String) -> CostEstimate {
    let tried = previews.iter().map(|p| p.preview.evaluations).sum::<u64>().max(1);
    let per_evaluation_s = previews.iter().map(|p| p.took_s).sum::<f64>() / tried as f64;
    CostEstimate {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count of evaluations, >= 0")]
        evaluations: evaluations as u64,
        simulated_s: (evaluations * per_evaluation_s).max(least_s),
        robot_s: evaluations * robot_trial_s,
        text: in_words(evaluations, robot_trial_s),
        basis,
    }
}

fn try_out(problem: &Problem, seed: u64, time: Duration, clock: &dyn Clock) -> Result<Timed, AppError> {
    let mut started = None;
    let mut elapsed = || {
        let now = clock.elapsed();
        now.saturating_sub(*started.get_or_insert(now))
    };
    let preview = Preview::new(problem, seed, || elapsed() < time)
        .map_err(|error| AppError::field("/execution", "invalid_problem", chain_text(&error)))?;
    Ok(Timed { preview, took_s: elapsed().as_secs_f64() })
}
