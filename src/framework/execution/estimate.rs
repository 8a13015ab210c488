//! Cost of a problem before it is run, estimated from its first repetition, which is simulated for as long as the
//! caller allows.

use super::error::ProblemError;
use super::iet::Iet;
use super::simulate::simulate;
use super::spec::Problem;

/// Maximum number of evaluations of a preview; most problems end earlier.
const MOST_EVALUATIONS: u64 = 50_000;
/// Number of evaluations between two calls of `go_on`.
const SLICE: u64 = 1000;

/// Default duration of a trial on a robot, seconds.
pub const ROBOT_TRIAL_S: f64 = 15.0;

/// Progress of the simulated first repetition of a problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Preview {
    /// Number of evaluations made.
    pub evaluations: u64,
    /// Number of goals n.
    pub goals: usize,
    /// Number of goals that had ended.
    pub goals_done: usize,
    /// Whether the run had ended.
    pub finished: bool,
}

impl Preview {
    /// Simulates one repetition while `go_on` returns true. It is called once everything is ready for the first trial
    /// and then from time to time; for a method that plans the whole run, before every trial.
    ///
    /// # Errors
    /// [`ProblemError`] if the run itself would end with one.
    pub fn new(problem: &Problem, seed: u64, mut go_on: impl FnMut() -> bool) -> Result<Self, ProblemError> {
        let mut iet = Iet::new(problem, seed)?;
        let mut world = iet.world()?;
        let slice = if iet.plans_whole_run() { 1 } else { SLICE };
        let mut progress = iet.progress();
        while !progress.finished && progress.evaluations < MOST_EVALUATIONS && go_on() {
            progress = simulate(&mut iet, world.as_mut(), slice)?;
        }
        Ok(Self {
            evaluations: progress.evaluations,
            goals: progress.goals,
            goals_done: progress.goal_index,
            finished: progress.finished,
        })
    }

    /// Estimated number of evaluations of the whole repetition.
    #[must_use]
    pub fn whole(&self) -> f64 {
        let evaluations = self.evaluations as f64;
        if self.finished { evaluations } else { evaluations * self.goals as f64 / (self.goals_done as f64 + 0.5) }
    }

    /// Basis of the estimate, in words.
    #[must_use]
    pub fn basis(&self) -> String {
        if self.finished {
            return "the first repetition, simulated to its end".to_owned();
        }
        format!("{} of {} goals of the first repetition, simulated", self.goals_done, self.goals)
    }
}

/// The cost in words: `about 16 evaluations; at 15 s each, 4 minutes of robot time`.
#[must_use]
pub fn in_words(evaluations: f64, robot_trial_s: f64) -> String {
    let count = if evaluations < 100.0 { evaluations.round() } else { two_digits(evaluations) };
    let noun = if count == 1.0 { "evaluation" } else { "evaluations" };
    let time = duration(evaluations * robot_trial_s);
    format!("about {count} {noun}; at {robot_trial_s} s each, {time} of robot time")
}

fn two_digits(value: f64) -> f64 {
    let unit = 10.0_f64.powf(value.log10().floor() - 1.0);
    (value / unit).round() * unit
}

fn duration(seconds: f64) -> String {
    let units =
        [("second", 1.0, 100.0), ("minute", 60.0, 100.0), ("hour", 3600.0, 48.0), ("day", 86_400.0, f64::INFINITY)];
    let fits = |&(_, size, most): &(&str, f64, f64)| seconds / size < most;
    let (unit, size, _) = units.into_iter().find(fits).unwrap_or(("day", 86_400.0, f64::INFINITY));
    let count = (seconds / size).round();
    if count == 1.0 { format!("1 {unit}") } else { format!("{count} {unit}s") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::execution::run;
    use crate::method::MethodSpec;
    use crate::preset::shipped;
    use rstest::rstest;
    use std::cell::Cell;

    #[rstest]
    #[case(16.0, 15.0, "about 16 evaluations; at 15 s each, 4 minutes of robot time")]
    #[case(1.0, 15.0, "about 1 evaluation; at 15 s each, 15 seconds of robot time")]
    #[case(9679.0, 15.0, "about 9700 evaluations; at 15 s each, 40 hours of robot time")]
    #[case(96_790.0, 15.0, "about 97000 evaluations; at 15 s each, 17 days of robot time")]
    #[case(70.0, 2.5, "about 70 evaluations; at 2.5 s each, 3 minutes of robot time")]
    fn the_cost_is_said_in_words(#[case] evaluations: f64, #[case] trial_s: f64, #[case] text: &str) {
        assert_eq!(in_words(evaluations, trial_s), text);
    }

    #[test]
    fn a_preview_to_the_end_counts_what_the_run_takes() {
        let mut problem = shipped("wax").unwrap().problem;
        problem.execution.method = MethodSpec::by_name("broyden").unwrap();
        let preview = Preview::new(&problem, 5, || true).unwrap();
        assert_eq!((preview.finished, preview.evaluations), (true, run(&problem, 5).unwrap().evaluations));
        assert_eq!(preview.whole(), preview.evaluations as f64);
    }

    #[test]
    fn a_method_that_owns_the_run_is_stopped_between_any_two_trials() {
        let mut problem = shipped("wax").unwrap().problem;
        problem.execution.method = MethodSpec::by_name("model").unwrap();
        let left = Cell::new(6_u32);
        let preview = Preview::new(&problem, 5, || left.replace(left.get().saturating_sub(1)) > 0).unwrap();
        assert_eq!((preview.finished, preview.evaluations), (false, 6));
        assert!(preview.whole() > 6.0 && preview.basis().contains("of 9 goals"), "{}", preview.basis());
    }
}
