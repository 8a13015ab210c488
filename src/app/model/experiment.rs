//! Requests for experiments, and what is shown of them.

use super::id::{ExperimentId, JobId};
use super::time::Timestamp;
use crate::framework::experiment::{CellResult, CellSpec, MatrixSpec, PairedComparison, Quantity, RunId};
use crate::framework::job::State;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// What to run: tables of the paper, single cells, a matrix, or several of these. Every cell runs the seeds
/// `seed..seed + repetitions`, so that cells can be compared pair by pair.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct ExperimentRequest {
    /// Display name; made of what is run when absent.
    #[serde(default)]
    pub name: Option<String>,
    /// Seed of each cell's first repetition, below 2^53; drawn and recorded when absent.
    #[serde(default)]
    pub seed: Option<u64>,
    /// Runs of each cell (at least 1).
    #[serde(default = "one")]
    pub repetitions: u32,
    /// Cells of the paper: one table, or all.
    #[serde(default)]
    pub paper_table: Option<PaperTable>,
    /// Cells one by one, after those of the paper.
    #[serde(default)]
    pub cells: Vec<CellSpec>,
    /// Every preset with every method and every setting, after the cells.
    #[serde(default)]
    pub matrix: Option<MatrixSpec>,
}

fn one() -> u32 {
    1
}

/// A table of the paper by its number, 1 to 6, or `all`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(untagged)]
pub enum PaperTable {
    /// 1 to 6.
    Number(u8),
    /// All six.
    Every(EveryTable),
}

/// All tables of the paper.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum EveryTable {
    /// Tables 1 to 6.
    All,
}

/// An experiment and how far it is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ExperimentView {
    /// Its id.
    pub id: ExperimentId,
    /// Display name.
    pub name: String,
    /// The job that runs it.
    pub job: JobId,
    /// Where that job stands.
    pub state: State,
    /// Seed of each cell's first repetition.
    pub seed: u64,
    /// Runs of each cell.
    pub repetitions: u32,
    /// Number of cells.
    pub cells: u32,
    /// Cells x repetitions.
    pub runs: u64,
    /// Runs that ended and are stored.
    pub finished_runs: u64,
    /// When it was submitted.
    pub created_at: Timestamp,
}

/// The table so far: one row a cell, over the runs that ended.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ExperimentTable {
    /// The experiment.
    pub experiment: ExperimentId,
    /// Cells x repetitions.
    pub runs: u64,
    /// Runs the table is made of.
    pub finished_runs: u64,
    /// In the plan's order; a cell's index is its place here.
    pub cells: Vec<CellResult>,
}

/// Two cells of an experiment, seed by seed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ExperimentComparison {
    /// The experiment.
    pub experiment: ExperimentId,
    /// Index of the first cell.
    pub first: u32,
    /// Index of the second cell.
    pub second: u32,
    /// What was compared.
    pub quantity: Quantity,
    /// The result in one sentence.
    pub sentence: String,
    /// Second minus first, over the seeds that count in both.
    pub comparison: PairedComparison,
}

/// Which rows of an experiment.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct RowFilter {
    /// Of this cell only.
    pub cell: Option<u32>,
    /// After this run only.
    pub after: Option<RunId>,
    /// At most so many; all when absent.
    pub limit: Option<u32>,
}
