//! An experiment, its plan and the rows of its finished runs.

use super::tally::complete_tally;
use super::{unchanged, versions, whole_document};
use crate::app::model::{ExperimentId, ExperimentView, JobId, Timestamp};
use crate::framework::experiment::{self, RunRow};
use crate::framework::job::State;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// An experiment without its state and its number of finished runs, which its job and its rows know.
#[derive(Debug, Serialize, Deserialize)]
pub(in crate::store) struct Experiment {
    id: ExperimentId,
    name: String,
    job: JobId,
    seed: u64,
    repetitions: u32,
    cells: u32,
    runs: u64,
    created_at: Timestamp,
}
versions! { Experiment keeps Self, "experiment", [unchanged] }

impl From<ExperimentView> for Experiment {
    fn from(view: ExperimentView) -> Self {
        let ExperimentView { id, name, job, state: _, seed, repetitions, cells, runs, finished_runs: _, created_at } =
            view;
        Self { id, name, job, seed, repetitions, cells, runs, created_at }
    }
}

impl Experiment {
    /// The experiment as it is shown.
    pub(in crate::store) fn shown(self, state: State, finished_runs: u64) -> ExperimentView {
        let Self { id, name, job, seed, repetitions, cells, runs, created_at } = self;
        ExperimentView { id, name, job, state, seed, repetitions, cells, runs, finished_runs, created_at }
    }
}

whole_document! {
    /// All it takes to run an experiment.
    Plan keeps experiment::Plan
}
versions! { Plan keeps experiment::Plan, "plan", [unchanged] }

whole_document! {
    /// One finished run.
    Row keeps RunRow
}
versions! { Row keeps RunRow, "row", [with_whole_tally] }

fn with_whole_tally(mut row: Value) -> Value {
    complete_tally(&mut row);
    row
}
