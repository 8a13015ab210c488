//! Progress of an execution, in the terms of the API.

use crate::app::model::{GoalProgress, JobProgress, TrialProgress};
use crate::app::ports::NewRun;
use crate::framework::distance::distance;
use crate::framework::execution::{GoalResult, Problem, Progress};
use crate::framework::method::whole_run::Trial;
use std::collections::BTreeSet;
use std::sync::Arc;

/// The progress of one execution job.
pub(super) struct Report {
    problem: Arc<Problem>,
    repetitions: u32,
    /// Current repetition, from 0.
    repetition: u32,
    /// Number of evaluations in earlier repetitions.
    evaluations_before: u64,
    /// Trials of the current repetition, if the method records them.
    trials: Vec<TrialProgress>,
}

impl Report {
    /// The report of a job of `repetitions` runs of `problem`, at its beginning.
    pub(super) fn new(problem: Arc<Problem>, repetitions: u32) -> Self {
        Self { problem, repetitions, repetition: 0, evaluations_before: 0, trials: Vec::new() }
    }

    /// Starts or continues a repetition; `log` contains the trials it has already made.
    pub(super) fn begin(&mut self, repetition: u32, evaluations_before: u64, log: &[Trial]) {
        self.repetition = repetition;
        self.evaluations_before = evaluations_before;
        self.trials.clear();
        self.news(log);
    }

    /// The trials of `log` that have not been reported yet; they now count as reported.
    pub(super) fn news(&mut self, log: &[Trial]) -> Vec<TrialProgress> {
        let goals = &self.problem.goals;
        let repetition = self.repetition;
        let show = |(index, trial): (usize, &Trial)| TrialProgress {
            repetition,
            index: narrow(index),
            goal: narrow(trial.goal),
            residual: trial.observation.as_ref().map(|seen| distance(seen, goals.row(trial.goal))),
        };
        let news: Vec<_> = log.iter().enumerate().skip(self.trials.len()).map(show).collect();
        self.trials.extend_from_slice(&news);
        news
    }

    /// The result of a goal that has ended.
    pub(super) fn goal(&self, goal: &GoalResult) -> GoalProgress {
        GoalProgress {
            repetition: self.repetition,
            index: narrow(goal.index),
            evaluations: goal.evaluations,
            discrepancy: goal.discrepancy,
            stop_reason: goal.stop_reason,
            judgement: Some(goal.judgement),
            joints: goal.joints.clone(),
            observation: goal.observation.clone(),
            residual: Some(distance(&goal.observation, self.problem.goals.row(goal.index))),
        }
    }

    /// Progress of the job while its current repetition is at `progress`.
    pub(super) fn progress(&self, progress: &Progress) -> JobProgress {
        // A method that plans the whole run goes back and forth between goals: the number of goals tried is its measure.
        let tried = self.trials.iter().map(|trial| trial.goal).collect::<BTreeSet<u32>>().len();
        let goals_done = if progress.finished || tried == 0 { progress.goal_index } else { tried - 1 };
        let done = goals_done as f64 / progress.goals.max(1) as f64;
        JobProgress {
            fraction: (f64::from(self.repetition) + done) / f64::from(self.repetitions),
            repetition: self.repetition,
            repetitions: self.repetitions,
            goal_index: narrow(progress.goal_index),
            goals: narrow(progress.goals),
            evaluations: progress.evaluations,
            goal_evaluations: progress.goal_evaluations,
            total_evaluations: self.evaluations_before + progress.evaluations,
            discrepancy: progress.best_discrepancy,
            finished_goals: progress.results.iter().map(|goal| self.goal(goal)).collect(),
            trials: self.trials.clone(),
        }
    }

    /// Progress of a job between two repetitions.
    pub(super) fn between(&self) -> JobProgress {
        let goals = narrow(self.problem.goals.len());
        JobProgress {
            fraction: f64::from(self.repetition) / f64::from(self.repetitions),
            repetition: self.repetition,
            repetitions: self.repetitions,
            goals,
            total_evaluations: self.evaluations_before,
            ..JobProgress::default()
        }
    }

    /// Progress of a job that has ended; `last` is its last run if this attempt made it.
    pub(super) fn at_end(&self, last: Option<&NewRun>, total_evaluations: u64) -> JobProgress {
        let goals = narrow(self.problem.goals.len());
        let results = last.map(|run| run.goals.goals.as_slice()).unwrap_or_default();
        let repetition = self.repetitions - 1;
        JobProgress {
            fraction: 1.0,
            repetition,
            repetitions: self.repetitions,
            goal_index: goals,
            goals,
            evaluations: last.map_or(0, |run| run.view.evaluations),
            goal_evaluations: 0,
            total_evaluations,
            discrepancy: last.map(|run| run.view.discrepancy),
            finished_goals: results.iter().map(|goal| GoalProgress::of_run(repetition, goal)).collect(),
            trials: self.trials.clone(),
        }
    }
}

fn narrow(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::shipped;

    fn report() -> Report {
        Report::new(Arc::new(shipped::preset("wax").unwrap().problem), 2)
    }

    fn trial(goal: usize, observation: Option<Vec<f64>>) -> Trial {
        Trial { joints: vec![0.0; 3], observation, cells: None, goal }
    }

    #[test]
    fn each_trial_is_news_once_and_a_resumed_repetition_knows_those_before() {
        let mut report = report();
        let first = report.problem.goals.row(0).to_vec();
        let log = [trial(0, Some(first)), trial(1, None)];
        report.begin(1, 40, &log[..1]);
        let news = report.news(&log);
        assert_eq!(news.iter().map(|t| (t.repetition, t.index, t.residual)).collect::<Vec<_>>(), [(1, 1, None)]);
        assert_eq!(report.news(&log), []);
        assert_eq!(report.trials[0].residual, Some(0.0));
        report.begin(0, 0, &[]);
        assert_eq!(report.news(&log).len(), 2);
    }

    #[test]
    fn the_share_counts_goals_tried_or_ended_over_all_repetitions() {
        let mut report = report();
        let goals = report.problem.goals.len();
        report.begin(1, 40, &[]);
        let mut progress = Progress {
            goal_index: 1,
            goals,
            evaluations: 7,
            goal_evaluations: 3,
            best_discrepancy: Some(2.0),
            finished: false,
            results: Vec::new(),
        };
        let shown = report.progress(&progress);
        assert_eq!((shown.total_evaluations, shown.fraction), (47, 0.5 + 0.5 / goals as f64));
        report.news(&[trial(0, None), trial(2, None), trial(0, None)]);
        progress.goal_index = 0;
        assert_eq!(report.progress(&progress).fraction, 0.5 + 0.5 / goals as f64);
        report.begin(1, 47, &[]);
        let between = report.between();
        assert_eq!((between.fraction, between.total_evaluations, between.goal_index), (0.5, 47, 0));
    }
}
