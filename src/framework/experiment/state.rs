//! The state of an experiment: its plan and its finished runs.
//!
//! # Invariants
//! - Rows are stored by (cell, repetition), so the order in which runs finish and their threads are not observable.
//! - A run is recorded once; recording the same row again changes nothing, and a different row for the same run is an
//!   error.

use super::{Cell, CellResult, Plan};
use crate::method::per_goal::Tally;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Id of a run within an experiment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema), schema(as = ExperimentRun))]
pub struct RunId {
    /// Index of the cell, from 0.
    pub cell: u32,
    /// Repetition, from 0; its seed is the plan's seed plus this.
    pub repetition: u32,
}

/// Summary of one finished run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct RunRow {
    /// Id of the run.
    #[serde(flatten)]
    pub id: RunId,
    /// Seed of the repetition.
    pub seed: u64,
    /// Number of executed candidates.
    pub evaluations: u64,
    /// Discrepancy of the last goal's winner according to the method (features' unit).
    pub discrepancy: f64,
    /// Discrepancy of that winner when executed; `None` unless the method never executed it.
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub true_discrepancy: Option<f64>,
    /// Painted share, %; `None` unless the world is a surface. See
    /// [`RunResult::painted_percent`](crate::execution::RunResult::painted_percent).
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub painted_percent: Option<f64>,
    /// Whether the last goal had no feasible candidate.
    pub invalid: bool,
    /// Evaluations per goal, in order.
    pub evaluations_per_goal: Vec<u64>,
    /// Number of fitness values by origin.
    pub provenance: Tally,
    /// SHA-256 of the run's joints, evaluations and discrepancy, to the last bit.
    pub digest: String,
}

/// Reasons why a row is rejected.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RecordError {
    /// The plan has no such run.
    #[error("cell {}, repetition {} is outside {cells} cells x {repetitions} repetitions", id.cell, id.repetition)]
    Unplanned {
        /// Id of the run.
        id: RunId,
        /// Number of cells in the plan.
        cells: usize,
        /// Number of repetitions in the plan.
        repetitions: u32,
    },
    /// The seed differs from the plan's.
    #[error("cell {}, repetition {} ran seed {found}, the plan says {expected}", id.cell, id.repetition)]
    Seed {
        /// Id of the run.
        id: RunId,
        /// Seed in the row.
        found: u64,
        /// Seed in the plan.
        expected: u64,
    },
    /// The run already has a different result, so its computation is not deterministic.
    #[error("cell {}, repetition {} has digest {recorded} already, not {found}", id.cell, id.repetition)]
    Conflict {
        /// Id of the run.
        id: RunId,
        /// Digest of the recorded row.
        recorded: String,
        /// Digest of the new row.
        found: String,
    },
}

/// A plan with its finished runs.
#[derive(Debug, Clone, PartialEq)]
pub struct Experiment {
    plan: Plan,
    rows: BTreeMap<RunId, RunRow>,
}

impl Experiment {
    /// An experiment without finished runs.
    #[must_use]
    pub fn new(plan: Plan) -> Self {
        Self { plan, rows: BTreeMap::new() }
    }

    /// An experiment with finished `rows`, in any order.
    ///
    /// # Errors
    /// [`RecordError`] for the first row that does not belong to this plan.
    pub fn resume(plan: Plan, rows: impl IntoIterator<Item = RunRow>) -> Result<Self, RecordError> {
        let mut experiment = Self::new(plan);
        rows.into_iter().try_for_each(|row| experiment.record(row))?;
        Ok(experiment)
    }

    /// The plan of all runs.
    #[must_use]
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Finished runs, ordered by cell, then repetition.
    #[must_use]
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &RunRow> {
        self.rows.values()
    }

    /// Finished runs of one cell, ordered by repetition.
    pub fn rows_of(&self, cell: u32) -> impl Iterator<Item = &RunRow> {
        let of = |repetition| RunId { cell, repetition };
        self.rows.range(of(0)..=of(u32::MAX)).map(|(_, row)| row)
    }

    /// Pending runs, repetition by repetition over all cells, so that the table is complete early, if coarse.
    pub fn pending(&self) -> impl Iterator<Item = RunId> {
        let runs = (0..self.plan.repetitions)
            .flat_map(|repetition| (0u32..).zip(&self.plan.cells).map(move |(cell, _)| RunId { cell, repetition }));
        runs.filter(|id| !self.rows.contains_key(id))
    }

    /// Whether every run is finished.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.rows.len() as u64 == self.plan.runs()
    }

    /// Adds a finished run.
    ///
    /// # Errors
    /// [`RecordError`] if the row does not belong to this plan or contradicts a recorded one.
    pub fn record(&mut self, row: RunRow) -> Result<(), RecordError> {
        let id = row.id;
        if self.plan.cell(id).is_none() {
            let (cells, repetitions) = (self.plan.cells.len(), self.plan.repetitions);
            return Err(RecordError::Unplanned { id, cells, repetitions });
        }
        let expected = self.plan.seed_of(id);
        if row.seed != expected {
            return Err(RecordError::Seed { id, found: row.seed, expected });
        }
        match self.rows.get(&id) {
            Some(known) if *known == row => Ok(()),
            Some(known) => Err(RecordError::Conflict { id, recorded: known.digest.clone(), found: row.digest }),
            None => {
                self.rows.insert(id, row);
                Ok(())
            }
        }
    }

    /// The table so far: one result per cell, in the plan's order.
    #[must_use]
    pub fn table(&self) -> Vec<CellResult> {
        (0u32..).zip(&self.plan.cells).map(|(index, cell)| CellResult::of(cell, self.rows_of(index))).collect()
    }
}

impl Plan {
    /// Number of runs: cells x repetitions.
    #[must_use]
    pub fn runs(&self) -> u64 {
        self.cells.len() as u64 * u64::from(self.repetitions)
    }

    /// The cell that a run belongs to; `None` if the plan has no such run.
    #[must_use]
    pub fn cell(&self, id: RunId) -> Option<&Cell> {
        self.cells.get(id.cell as usize).filter(|_| id.repetition < self.repetitions)
    }

    /// Seed of a run; all cells share their seeds.
    #[must_use]
    pub fn seed_of(&self, id: RunId) -> u64 {
        self.seed.wrapping_add(u64::from(id.repetition))
    }
}
