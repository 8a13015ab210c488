//! Requests for and views of experiments.

use super::id::{ExperimentId, JobId};
use super::time::Timestamp;
use crate::framework::experiment::{CellResult, CellSpec, MatrixSpec, PairedComparison, Quantity, RunId};
use crate::framework::job::State;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Request for an experiment: tables of the paper, individual cells, a matrix, or a combination. Every cell runs the
/// seeds `seed..seed + repetitions`, so that cells can be compared in pairs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct ExperimentRequest {
    /// Display name; derived from the cells if absent.
    #[serde(default)]
    pub name: Option<String>,
    /// Seed of each cell's first repetition, below 2^53; drawn and recorded if absent.
    #[serde(default)]
    pub seed: Option<u64>,
    /// Number of runs per cell (at least 1).
    #[serde(default = "one")]
    pub repetitions: u32,
    /// Cells of the paper: one table, or all.
    #[serde(default)]
    pub paper_table: Option<PaperTable>,
    /// Individual cells, after those of the paper.
    #[serde(default)]
    pub cells: Vec<CellSpec>,
    /// Every preset with every method and every setting, after the individual cells.
    #[serde(default)]
    pub matrix: Option<MatrixSpec>,
}

fn one() -> u32 {
    1
}

/// A table of the paper by its number, 1 to 6, or `all`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(untagged, expecting = "not a table of the paper: give 1 to 6, or \"all\"")]
pub enum PaperTable {
    /// Number of the table, 1 to 6.
    Number(u8),
    /// All six tables.
    Every(EveryTable),
}

/// All tables of the paper.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum EveryTable {
    /// Tables 1 to 6.
    All,
}

/// An experiment with its progress.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ExperimentView {
    /// Id of the experiment.
    pub id: ExperimentId,
    /// Display name.
    pub name: String,
    /// Job that runs it.
    pub job: JobId,
    /// State of that job.
    pub state: State,
    /// Seed of each cell's first repetition.
    pub seed: u64,
    /// Number of runs per cell.
    pub repetitions: u32,
    /// Number of cells.
    pub cells: u32,
    /// Number of runs: cells x repetitions.
    pub runs: u64,
    /// Number of finished and stored runs.
    pub finished_runs: u64,
    /// Time of submission.
    pub created_at: Timestamp,
}

/// The table so far: one row per cell, over the finished runs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ExperimentTable {
    /// Id of the experiment.
    pub experiment: ExperimentId,
    /// Number of runs: cells x repetitions.
    pub runs: u64,
    /// Number of runs in the table.
    pub finished_runs: u64,
    /// Cells in the plan's order; a cell's index is its position here.
    pub cells: Vec<CellResult>,
}

/// Comparison of two cells of an experiment, seed by seed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ExperimentComparison {
    /// Id of the experiment.
    pub experiment: ExperimentId,
    /// Index of the first cell.
    pub first: u32,
    /// Index of the second cell.
    pub second: u32,
    /// Quantity compared.
    pub quantity: Quantity,
    /// Result in one sentence.
    pub sentence: String,
    /// Second minus first, over the seeds with valid runs in both.
    pub comparison: PairedComparison,
}

/// Filter for rows of an experiment.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct RowFilter {
    /// Only rows of this cell.
    pub cell: Option<u32>,
    /// Only rows after this run.
    pub after: Option<RunId>,
    /// Maximum number of rows; all if `None`.
    pub limit: Option<u32>,
}
