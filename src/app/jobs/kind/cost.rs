//! Cost estimates: simulates first repetitions for a short time and extrapolates.

use crate::app::chain_text;
use crate::app::model::{AppError, CostEstimate};
use crate::app::ports::Clock;
use crate::framework::execution::{Preview, Problem, in_words};
use std::time::Duration;

/// Time for all previews of one estimate.
pub(super) const PREVIEW_TIME: Duration = Duration::from_millis(500);

/// A preview and the time it took.
pub(super) struct Timed {
    pub preview: Preview,
    took_s: f64,
}

/// Cost of trials, in simulation and on a robot.
#[derive(Clone, Copy)]
pub(super) struct TrialCost<'a> {
    /// Duration of a trial on a robot, seconds.
    pub robot_trial_s: f64,
    /// Measures previews.
    pub clock: &'a dyn Clock,
}

impl TrialCost<'_> {
    /// Cost of `evaluations` by the speed of `previews`; the simulation takes at least `least_s`.
    pub(super) fn of(self, evaluations: f64, previews: &[Timed], least_s: f64, basis: String) -> CostEstimate {
        let tried = previews.iter().map(|p| p.preview.evaluations).sum::<u64>().max(1);
        let per_evaluation_s = previews.iter().map(|p| p.took_s).sum::<f64>() / tried as f64;
        CostEstimate {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a count of evaluations, >= 0"
            )]
            evaluations: evaluations as u64,
            simulated_s: (evaluations * per_evaluation_s).max(least_s),
            robot_s: evaluations * self.robot_trial_s,
            text: in_words(evaluations, self.robot_trial_s),
            basis,
        }
    }

    /// Runs the first repetition of `problem` for `time`.
    ///
    /// # Errors
    /// `Invalid` if it breaks off.
    pub(super) fn try_out(self, problem: &Problem, seed: u64, time: Duration) -> Result<Timed, AppError> {
        let mut started = None;
        let mut elapsed = || {
            let now = self.clock.elapsed();
            now.saturating_sub(*started.get_or_insert(now))
        };
        let preview = Preview::new(problem, seed, || elapsed() < time)
            .map_err(|error| AppError::field("/execution", "invalid_problem", chain_text(&error)))?;
        Ok(Timed { preview, took_s: elapsed().as_secs_f64() })
    }
}
