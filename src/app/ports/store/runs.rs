//! Storage of runs, their trials and trajectories; a job writes them with its progress.

use super::StoreError;
use crate::app::model::{ConvergencePoint, Keyset, RunFilter, RunGoals, RunId, RunView, TrajectoryId, TrajectoryView};
use crate::framework::method::whole_run::Trial;
use async_trait::async_trait;

/// A finished repetition to keep.
#[derive(Debug, Clone)]
pub struct NewRun {
    /// The run, as shown.
    pub view: RunView,
    /// Goals of the run.
    pub goals: RunGoals,
    /// Convergence of the run.
    pub convergence: Vec<ConvergencePoint>,
    /// Trajectory of the run; `None` if it has none.
    pub trajectory: Option<TrajectoryView>,
    /// Trials of the run, empty unless the method plans the whole run.
    pub trials: KeptTrials,
}

/// The trials of a run.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct KeptTrials {
    /// Digest of everything that determines an observation; `None` if no other run can share the trials.
    pub setup_key: Option<String>,
    /// Trials in the order they were made.
    pub trials: Vec<Trial>,
}

/// Runs, written once.
#[async_trait]
pub trait Runs: Send + Sync {
    /// Reads one run.
    async fn run(&self, id: &RunId) -> Result<RunView, StoreError>;
    /// Goals of the run.
    async fn run_goals(&self, id: &RunId) -> Result<RunGoals, StoreError>;
    /// Convergence of the run.
    async fn run_convergence(&self, id: &RunId) -> Result<Vec<ConvergencePoint>, StoreError>;
    /// The trials of a run; empty if it has none or does not exist.
    async fn run_trials(&self, id: &RunId) -> Result<KeptTrials, StoreError>;
    /// Runs with trials of this set-up, newest first, at most `limit`.
    async fn runs_on(&self, setup_key: &str, limit: u32) -> Result<Vec<(RunView, Vec<Trial>)>, StoreError>;
    /// Lists runs.
    async fn runs(&self, filter: &RunFilter, keyset: &Keyset) -> Result<Vec<RunView>, StoreError>;
    /// Reads one trajectory.
    async fn trajectory(&self, id: &TrajectoryId) -> Result<TrajectoryView, StoreError>;
}
