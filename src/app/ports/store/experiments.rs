//! Storage of experiments; a job writes their rows with its progress.

use super::StoreError;
use crate::app::model::{ExperimentId, ExperimentView, Keyset, RowFilter};
use crate::framework::experiment::{Plan, RunRow};
use async_trait::async_trait;

/// An experiment to keep.
#[derive(Debug, Clone)]
pub struct NewExperiment {
    /// What is shown of it; `state` and `finished_runs` are read from its job and its rows.
    pub view: ExperimentView,
    /// All it takes to run it.
    pub plan: Plan,
}

/// Experiments: the plan, written with its job, and the rows of the runs that ended.
#[async_trait]
pub trait Experiments: Send + Sync {
    /// One experiment.
    async fn experiment(&self, id: &ExperimentId) -> Result<ExperimentView, StoreError>;
    /// Experiments.
    async fn experiments(&self, keyset: &Keyset) -> Result<Vec<ExperimentView>, StoreError>;
    /// All it takes to run it.
    async fn experiment_plan(&self, id: &ExperimentId) -> Result<Plan, StoreError>;
    /// Its finished runs by cell, then repetition; none for an experiment that is not there.
    async fn experiment_rows(&self, id: &ExperimentId, filter: &RowFilter) -> Result<Vec<RunRow>, StoreError>;
}
