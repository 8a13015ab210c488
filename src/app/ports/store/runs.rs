//! Storage of runs, their trials and trajectories; a job writes them with its progress.

use super::StoreError;
use crate::app::model::{ConvergencePoint, Keyset, RunFilter, RunGoals, RunId, RunView, TrajectoryId, TrajectoryView};
use crate::framework::method::whole_run::Trial;
use async_trait::async_trait;

/// A finished repetition to keep.
#[derive(Debug, Clone)]
pub struct NewRun {
    /// What is shown of it.
    pub view: RunView,
    /// Its goals.
    pub goals: RunGoals,
    /// Its convergence.
    pub convergence: Vec<ConvergencePoint>,
    /// Its trajectory.
    pub trajectory: Option<TrajectoryView>,
    /// Its trials, where the method remembers them.
    pub trials: KeptTrials,
}

/// The trials of a run.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct KeptTrials {
    /// What decides what a pose shows, as a digest; none where that changes with time.
    pub setting: Option<String>,
    /// In the order they were made.
    pub trials: Vec<Trial>,
}

/// Runs, written once.
#[async_trait]
pub trait Runs: Send + Sync {
    /// One run.
    async fn run(&self, id: &RunId) -> Result<RunView, StoreError>;
    /// Its goals.
    async fn run_goals(&self, id: &RunId) -> Result<RunGoals, StoreError>;
    /// Its convergence.
    async fn run_convergence(&self, id: &RunId) -> Result<Vec<ConvergencePoint>, StoreError>;
    /// Its trials; none of a run without any, or of no run.
    async fn run_trials(&self, id: &RunId) -> Result<KeptTrials, StoreError>;
    /// Runs with trials of this setting, newest first, at most `limit`.
    async fn runs_on(&self, setting: &str, limit: u32) -> Result<Vec<(RunView, Vec<Trial>)>, StoreError>;
    /// Runs.
    async fn runs(&self, filter: &RunFilter, keyset: &Keyset) -> Result<Vec<RunView>, StoreError>;
    /// One trajectory.
    async fn trajectory(&self, id: &TrajectoryId) -> Result<TrajectoryView, StoreError>;
}
