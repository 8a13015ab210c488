//! The state of an experiment: its plan and its finished runs.
//!
//! # Invariants
//! - Rows are kept by (cell, repetition), so neither the order in which runs finish nor their thread can be seen.
//! - A run is recorded once; recording the same row again changes nothing, another row for the same run is refused.

use super::{Cell, CellResult, Plan};
use crate::method::per_goal::Tally;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use utoipa::ToSchema;

/// Which run of an experiment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, ToSchema)]
#[schema(as = ExperimentRun)]
pub struct RunId {
    /// Cell index from 0.
    pub cell: u32,
    /// Repetition from 0; the seed is the plan's seed plus this.
    pub repetition: u32,
}

/// One finished run in short.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RunRow {
    /// Which run.
    #[serde(flatten)]
    pub id: RunId,
    /// Its seed.
    pub seed: u64,
    /// Executions of a candidate.
    pub evaluations: u64,
    /// Discrepancy of the last goal's winner as the method believed it (features' unit).
    pub discrepancy: f64,
    /// What that winner really does, where the method never executed it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub true_discrepancy: Option<f64>,
    /// Where the world has cells: over the last goal's executed candidates the percentage nearest 100.
    pub painted_percent: Option<f64>,
    /// The last goal had no feasible candidate.
    pub invalid: bool,
    /// Evaluations of each goal, in order.
    pub evaluations_per_goal: Vec<u64>,
    /// Where the run's fitness values came from.
    pub provenance: Tally,
    /// SHA-256 of the run's joints, evaluations and discrepancy bits.
    pub digest: String,
}

/// Why a row is refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RecordError {
    /// The plan has no such run.
    #[error("cell {}, repetition {} is outside {cells} cells x {repetitions} repetitions", id.cell, id.repetition)]
    Unplanned {
        /// The run.
        id: RunId,
        /// Cells planned.
        cells: usize,
        /// Repetitions planned.
        repetitions: u32,
    },
    /// The seed is not the plan's.
    #[error("cell {}, repetition {} ran seed {found}, the plan says {expected}", id.cell, id.repetition)]
    Seed {
        /// The run.
        id: RunId,
        /// Seed of the row.
        found: u64,
        /// Seed planned.
        expected: u64,
    },
    /// A second, different result of the same run: whatever made it is not deterministic.
    #[error("cell {}, repetition {} has digest {recorded} already, not {found}", id.cell, id.repetition)]
    Conflict {
        /// The run.
        id: RunId,
        /// Digest recorded.
        recorded: String,
        /// Digest of the new row.
        found: String,
    },
}

/// A plan with the runs finished so far.
#[derive(Debug, Clone, PartialEq)]
pub struct Experiment {
    plan: Plan,
    rows: BTreeMap<RunId, RunRow>,
}

impl Experiment {
    /// Nothing has run yet.
    #[must_use]
    pub fn new(plan: Plan) -> Self {
        Self { plan, rows: BTreeMap::new() }
    }

    /// An experiment whose `rows` are finished, in any order.
    ///
    /// # Errors
    /// [`RecordError`] for the first row that is not of this plan.
    pub fn resume(plan: Plan, rows: impl IntoIterator<Item = RunRow>) -> Result<Self, RecordError> {
        let mut experiment = Self::new(plan);
        rows.into_iter().try_for_each(|row| experiment.record(row))?;
        Ok(experiment)
    }

    /// What is to be run.
    #[must_use]
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Finished runs by cell, then repetition.
    #[must_use]
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &RunRow> {
        self.rows.values()
    }

    /// Finished runs of one cell by repetition.
    pub fn rows_of(&self, cell: u32) -> impl Iterator<Item = &RunRow> {
        let of = |repetition| RunId { cell, repetition };
        self.rows.range(of(0)..=of(u32::MAX)).map(|(_, row)| row)
    }

    /// Runs not finished yet, repetition by repetition over all cells: a table is complete early, if coarse.
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
    /// [`RecordError`] if the row is not of this plan or contradicts what is recorded.
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

    /// The table so far: one result a cell, in the plan's order.
    #[must_use]
    pub fn table(&self) -> Vec<CellResult> {
        (0u32..).zip(&self.plan.cells).map(|(index, cell)| CellResult::of(cell, self.rows_of(index))).collect()
    }
}

impl Plan {
    /// Cells x repetitions.
    #[must_use]
    pub fn runs(&self) -> u64 {
        self.cells.len() as u64 * u64::from(self.repetitions)
    }

    /// The cell a run belongs to; none where the plan has no such run.
    #[must_use]
    pub fn cell(&self, id: RunId) -> Option<&Cell> {
        self.cells.get(id.cell as usize).filter(|_| id.repetition < self.repetitions)
    }

    /// The seed of a run; cells share their seeds.
    #[must_use]
    pub fn seed_of(&self, id: RunId) -> u64 {
        self.seed.wrapping_add(u64::from(id.repetition))
    }
}
