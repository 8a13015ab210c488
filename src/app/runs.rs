//! Runs: finished repetitions of execution jobs.

use crate::app::model::{
    AppError, Convergence, ErrorKind, Keyset, Page, PageQuery, RunFilter, RunGoals, RunId, RunTrials, RunView,
    TrajectoryView, limits,
};
use crate::app::{UseCases, within};

impl UseCases {
    /// Lists runs, newest first.
    ///
    /// # Errors
    /// `Malformed` page.
    pub async fn list_runs(&self, filter: RunFilter, page: PageQuery) -> Result<Page<RunView>, AppError> {
        let keyset = Keyset::new(&page, &format!("runs {filter:?}"))?;
        let runs = self.ports.store.runs(&filter, &keyset).await?;
        Ok(keyset.page(runs, |run| run.id.to_string()))
    }

    /// Reads one run.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn get_run(&self, id: &RunId) -> Result<RunView, AppError> {
        Ok(self.ports.store.run(id).await?)
    }

    /// Reads a run's goals.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn run_goals(&self, id: &RunId) -> Result<RunGoals, AppError> {
        Ok(self.ports.store.run_goals(id).await?)
    }

    /// Reads a run's trials.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn run_trials(&self, id: &RunId) -> Result<RunTrials, AppError> {
        let run = self.get_run(id).await?;
        Ok(RunTrials { run: run.id, trials: self.ports.store.run_trials(id).await?.trials })
    }

    /// Reads a run's convergence: each improvement and the end of each goal, thinned to at most `max_points` evenly spaced points including the first and the last.
    ///
    /// # Errors
    /// `NotFound`; `Malformed` number.
    pub async fn run_convergence(&self, id: &RunId, max_points: Option<u32>) -> Result<Convergence, AppError> {
        let max_points =
            within("max_points", max_points.unwrap_or(limits::DEFAULT_POINTS), &limits::CONVERGENCE_POINTS)?;
        let all = self.ports.store.run_convergence(id).await?;
        Ok(Convergence { run: id.clone(), points: thin(&all, max_points as usize) })
    }

    /// Reads a run's trajectory.
    ///
    /// # Errors
    /// `NotFound` if there is no such run or it has no trajectory.
    pub async fn run_trajectory(&self, id: &RunId) -> Result<TrajectoryView, AppError> {
        let run = self.get_run(id).await?;
        let Some(trajectory) = run.trajectory else {
            let why = run.trajectory_problem.unwrap_or_else(|| "none was made".to_owned());
            return Err(AppError::new(ErrorKind::NotFound, "no_trajectory", format!("{id} has no trajectory: {why}")));
        };
        self.get_trajectory(&trajectory).await
    }
}

/// At most `most` (>= 2) evenly spaced items of `all`, including the first and the last.
fn thin<T: Copy>(all: &[T], most: usize) -> Vec<T> {
    if all.len() <= most {
        return all.to_vec();
    }
    (0..most).map(|i| all[i * (all.len() - 1) / (most - 1)]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::bench::Bench;
    use crate::app::model::JobId;
    use uuid::Uuid;

    #[tokio::test]
    async fn runs_are_listed_by_job_and_their_parts_are_read() {
        let bench = Bench::new();
        let (first, second) = (bench.run(true).await, bench.run(true).await);
        let list = async |job| bench.app.list_runs(RunFilter { job }, PageQuery::default()).await.unwrap().items;
        assert_eq!(list(None).await, [second.clone(), first.clone()]);
        assert_eq!(list(Some(second.job.clone())).await, [second]);
        assert!(list(Some(JobId::from_uuid(Uuid::from_u128(99)))).await.is_empty());
        assert_eq!(bench.app.run_goals(&first.id).await.unwrap().goals.len(), first.goals as usize);
        assert!(bench.app.run_trials(&first.id).await.unwrap().trials.is_empty());
    }

    #[tokio::test]
    async fn a_convergence_is_thinned_to_the_points_asked_for() {
        let bench = Bench::new();
        let run = bench.run(false).await.id;
        let evaluations = async |most| {
            let points = bench.app.run_convergence(&run, most).await.unwrap().points;
            points.iter().map(|point| point.evaluations).collect::<Vec<u64>>()
        };
        assert_eq!(evaluations(Some(4)).await, [1, 34, 67, 100]);
        assert_eq!(evaluations(None).await.len(), 100);
        assert_eq!(bench.app.run_convergence(&run, Some(1)).await.unwrap_err().kind, ErrorKind::Malformed);
    }

    #[tokio::test]
    async fn a_run_without_a_trajectory_says_why() {
        let bench = Bench::new();
        let (with, without) = (bench.run(true).await, bench.run(false).await);
        assert_eq!(Some(bench.app.run_trajectory(&with.id).await.unwrap().id), with.trajectory);
        let error = bench.app.run_trajectory(&without.id).await.unwrap_err();
        assert_eq!((error.kind, error.code), (ErrorKind::NotFound, "no_trajectory"));
        assert!(error.message.ends_with("has no trajectory: too steep"), "{error}");
    }

    #[test]
    fn thinning_keeps_both_ends_and_the_order() {
        let all: Vec<u32> = (0..100).collect();
        assert_eq!(thin(&all, 4), [0, 33, 66, 99]);
        assert_eq!(thin(&all, 2), [0, 99]);
        assert_eq!(thin(&all[..3], 4), [0, 1, 2]);
    }
}
