//! Storage of experiments; a job writes their rows with its progress.

use super::StoreError;
use crate::app::model::{ExperimentId, ExperimentView, Keyset, RowFilter};
use crate::framework::experiment::{Plan, RunRow};
use async_trait::async_trait;

/// An experiment to keep.
#[derive(Debug, Clone)]
pub struct NewExperiment {
    /// The experiment, as shown; `state` and `finished_runs` are read from its job and its rows.
    pub view: ExperimentView,
    /// The plan of the experiment.
    pub plan: Plan,
}

/// Experiments: the plan, written with its job, and the rows of finished runs.
#[async_trait]
pub trait Experiments: Send + Sync {
    /// Reads one experiment.
    async fn experiment(&self, id: &ExperimentId) -> Result<ExperimentView, StoreError>;
    /// Lists experiments.
    async fn experiments(&self, keyset: &Keyset) -> Result<Vec<ExperimentView>, StoreError>;
    /// The plan of the experiment.
    async fn experiment_plan(&self, id: &ExperimentId) -> Result<Plan, StoreError>;
    /// Finished runs ordered by cell, then repetition; empty if there is no such experiment.
    async fn experiment_rows(&self, id: &ExperimentId, filter: &RowFilter) -> Result<Vec<RunRow>, StoreError>;
}
