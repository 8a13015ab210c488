//! An experiment, its plan and the rows of its finished runs.
//!
//! A cell's specification and its problem are stored as the core writes them, see [`super::job`]; the rest is a type of
//! the store.

use super::tally::{Tally, complete_tally};
use super::{document, unchanged, versions};
use crate::app::model::{ExperimentId, ExperimentView, JobId, Timestamp};
use crate::framework::execution::Problem;
use crate::framework::experiment::{Cell, CellSpec, Plan as ExperimentPlan, RunId, RunRow};
use crate::framework::infinite_as_null;
use crate::framework::job::State;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// An experiment without its state and its number of finished runs: the columns of its job and its rows have them.
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
    /// The experiment with the state of its job and its number of finished runs.
    pub(in crate::store) fn shown(self, state: State, finished_runs: u64) -> ExperimentView {
        let Self { id, name, job, seed, repetitions, cells, runs, created_at } = self;
        ExperimentView { id, name, job, state, seed, repetitions, cells, runs, finished_runs, created_at }
    }
}

document! {
    /// The plan of an experiment.
    Plan keeps ExperimentPlan {
        name: String,
        seed: u64,
        repetitions: u32,
    }
    each { cells: PlannedCell, }
}
versions! { Plan keeps ExperimentPlan, "plan", [unchanged] }

document! {
    /// A cell with its whole problem.
    PlannedCell keeps Cell {
        spec: CellSpec,
        problem: Problem,
    }
}

document! {
    /// One finished run.
    Row keeps RunRow {
        seed: u64,
        evaluations: u64,
        #[serde(with = "infinite_as_null::number")]
        discrepancy: f64,
        true_discrepancy: Option<f64>,
        painted_percent: Option<f64>,
        invalid: bool,
        evaluations_per_goal: Vec<u64>,
        digest: String,
    }
    with {
        #[serde(flatten)]
        id: Place,
        provenance: Tally,
    }
}
versions! { Row keeps RunRow, "row", [with_whole_tally] }

fn with_whole_tally(mut row: Value) -> Value {
    complete_tally(&mut row);
    row
}

document! {
    /// The place of a run in its experiment.
    Place keeps RunId {
        cell: u32,
        repetition: u32,
    }
}
