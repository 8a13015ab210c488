//! Runs: one finished repetition of an execution job each.

use crate::app::id::{ActionId, JobId, RobotId, RunId, TrajectoryId, WorldId};
use crate::app::trajectories::TrajectoryView;
use crate::app::{App, AppError, ErrorKind, Keyset, Page, PageQuery, Timestamp, null_as_infinite, out_of_bounds};
use crate::framework::Feature;
use crate::framework::optimizer::{Provenance, StopReason, Tally};
use crate::framework::recognition::Metric;
use crate::framework::whole_run::Trial;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// One finished repetition.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RunView {
    /// Its id.
    pub id: RunId,
    /// The job it belongs to.
    pub job: JobId,
    /// Which repetition, from 0.
    pub repetition: u32,
    /// The action executed.
    pub action: ActionId,
    /// The robot.
    pub robot: RobotId,
    /// The world.
    pub world: WorldId,
    /// Method name, for example `sst`.
    pub method: String,
    /// How discrepancy was measured.
    pub metric: Metric,
    /// Its seed.
    pub seed: u64,
    /// Evaluations of all goals.
    pub evaluations: u64,
    /// Discrepancy of the whole observation, features' unit.
    #[serde(deserialize_with = "null_as_infinite::number")]
    pub discrepancy: f64,
    /// What the last goal's winner really does, where `discrepancy` is the value of one that was never executed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub true_discrepancy: Option<f64>,
    /// Whether the last goal's joints satisfy the constraints; true where there are none.
    #[serde(default = "satisfied")]
    pub valid: bool,
    /// Where the fitness values of all goals come from, by count.
    #[serde(default)]
    pub provenance: Tally,
    /// Share of the surface painted, %, in a world of coverage.
    pub painted_percent: Option<f64>,
    /// Number of goals.
    pub goals: u32,
    /// SHA-256 of the result's bits, hexadecimal.
    pub digest: String,
    /// Its trajectory; absent when none could be made within the limits, which `trajectory_problem` explains.
    pub trajectory: Option<TrajectoryId>,
    /// Why there is no trajectory.
    pub trajectory_problem: Option<String>,
    /// When it ended.
    pub created_at: Timestamp,
}

/// Runs of versions without constraints.
fn satisfied() -> bool {
    true
}

/// Winners of versions that executed every candidate.
fn simulated() -> Provenance {
    Provenance::Simulated
}

/// One goal of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RunGoal {
    /// From 0.
    pub index: u32,
    /// Evaluations of this goal.
    pub evaluations: u64,
    /// Discrepancy of the observation up to this goal, features' unit.
    #[serde(deserialize_with = "null_as_infinite::number")]
    pub discrepancy: f64,
    /// Why the goal ended.
    pub stop_reason: StopReason,
    /// Free joints, rad or m.
    pub joints: Vec<f64>,
    /// What was observed there.
    #[serde(deserialize_with = "null_as_infinite::numbers")]
    pub observation: Vec<f64>,
    /// What was asked for.
    pub goal: Vec<f64>,
    /// Distance of `observation` from `goal` (Euclidean, features' unit): for a goal out of reach the best found.
    #[serde(default)]
    pub residual: Option<f64>,
    /// Where the winner's discrepancy comes from.
    #[serde(default = "simulated")]
    pub winner: Provenance,
    /// What the winner really does, where `discrepancy` is the value of one that was never executed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub true_discrepancy: Option<f64>,
    /// Whether the joints satisfy the constraints; true where there are none.
    #[serde(default = "satisfied")]
    pub feasible: bool,
    /// Where the fitness values of this goal come from, by count.
    #[serde(default)]
    pub provenance: Tally,
}

/// All goals of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RunGoals {
    /// The run.
    pub run: RunId,
    /// Features, in the order of `goal` and `observation`.
    pub features: Vec<Feature>,
    /// Free joints, in the order of `joints`.
    pub joint_names: Vec<String>,
    /// One entry a goal.
    pub goals: Vec<RunGoal>,
}

/// The trials of a run whose method remembers each one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RunTrials {
    /// The run.
    pub run: RunId,
    /// In the order they were made; none where the method remembers none.
    pub trials: Vec<Trial>,
}

/// Discrepancy against evaluations.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Convergence {
    /// The run.
    pub run: RunId,
    /// Points, in the order of evaluations.
    pub points: Vec<ConvergencePoint>,
}

/// One point of a convergence curve.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ConvergencePoint {
    /// Goal index, from 0.
    pub goal_index: u32,
    /// Evaluations since the run began.
    pub evaluations: u64,
    /// Best discrepancy of the observation up to this goal.
    #[serde(deserialize_with = "null_as_infinite::number")]
    pub discrepancy: f64,
}

/// Which runs.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct RunFilter {
    /// Of this job only.
    pub job: Option<JobId>,
}

impl App {
    /// Newest first.
    ///
    /// # Errors
    /// `Malformed` page.
    pub async fn list_runs(&self, filter: RunFilter, page: PageQuery) -> Result<Page<RunView>, AppError> {
        let keyset = Keyset::new(&page, &format!("runs {filter:?}"))?;
        let runs = self.ports.store.runs(&filter, &keyset).await?;
        Ok(keyset.page(runs, |run| run.id.to_string()))
    }

    /// One run.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn get_run(&self, id: &RunId) -> Result<RunView, AppError> {
        Ok(self.ports.store.run(id).await?)
    }

    /// Its goals.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn run_goals(&self, id: &RunId) -> Result<RunGoals, AppError> {
        Ok(self.ports.store.run_goals(id).await?)
    }

    /// Its trials.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn run_trials(&self, id: &RunId) -> Result<RunTrials, AppError> {
        let run = self.get_run(id).await?;
        Ok(RunTrials { run: run.id, trials: self.ports.store.run_trials(id).await?.trials })
    }

    /// Its convergence: each improvement and where each goal ended, at most `max_points` (2 to 10000) evenly chosen points with the first
    /// and the last.
    ///
    /// # Errors
    /// `NotFound`; `Malformed` number.
    pub async fn run_convergence(&self, id: &RunId, max_points: Option<u32>) -> Result<Convergence, AppError> {
        let max_points = max_points.unwrap_or(1000);
        if !(2..=10_000).contains(&max_points) {
            return Err(out_of_bounds("max_points", max_points, "2 to 10000"));
        }
        let all = self.ports.store.run_convergence(id).await?;
        Ok(Convergence { run: id.clone(), points: thin(&all, max_points as usize) })
    }

    /// Its trajectory.
    ///
    /// # Errors
    /// `NotFound` run, or the run has no trajectory.
    pub async fn run_trajectory(&self, id: &RunId) -> Result<TrajectoryView, AppError> {
        let run = self.get_run(id).await?;
        let Some(trajectory) = run.trajectory else {
            let why = run.trajectory_problem.unwrap_or_else(|| "none was made".to_owned());
            return Err(AppError::new(ErrorKind::NotFound, "no_trajectory", format!("{id} has no trajectory: {why}")));
        };
        self.get_trajectory(&trajectory).await
    }
}

/// At most `most` (>= 2) of `all`, evenly chosen, with the first and the last.
fn thin<T: Copy>(all: &[T], most: usize) -> Vec<T> {
    if all.len() <= most {
        return all.to_vec();
    }
    (0..most).map(|i| all[i * (all.len() - 1) / (most - 1)]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thinning_keeps_both_ends_and_the_order() {
        let all: Vec<u32> = (0..100).collect();
        assert_eq!(thin(&all, 4), [0, 33, 66, 99]);
        assert_eq!(thin(&all, 2), [0, 99]);
        assert_eq!(thin(&all[..3], 4), [0, 1, 2]);
    }
}
