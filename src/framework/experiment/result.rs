//! A cell's runs reduced to the numbers of a table, and comparisons of two cells.

use super::{Cell, Experiment, InvalidRule, PairedComparison, RunRow, Summary, compare};
use serde::{Deserialize, Serialize};

/// One row of a table: statistics over the runs that count.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct CellResult {
    /// Table it belongs to.
    pub table: String,
    /// Action that was executed.
    pub action: String,
    /// Setting that distinguishes it from its neighbours.
    pub setting: String,
    /// Number of finished runs, valid or not.
    pub repetitions: u64,
    /// Number of runs whose last goal had no feasible candidate.
    pub invalid: u64,
    /// Evaluations after the last goal; absent until a run counts.
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub evaluations: Option<Summary>,
    /// Discrepancy after the last goal (features' unit).
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub discrepancy: Option<Summary>,
    /// Share of the cells reached at the last goal, %; absent if the world has no cells.
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub painted: Option<Summary>,
    /// Cumulative evaluations after each goal, one entry per goal.
    pub cumulative: Vec<Summary>,
}

/// A quantity of a run that can be compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// Evaluations after the last goal.
    Evaluations,
    /// Discrepancy after the last goal (features' unit).
    Discrepancy,
    /// Share of the cells reached, %.
    Painted,
}

/// Value of a run in its cell's statistics; `None` if the cell's rule leaves it out.
fn value(row: &RunRow, cell: &Cell, quantity: Quantity) -> Option<f64> {
    let counted_as = match (row.invalid, cell.spec.invalid) {
        (true, InvalidRule::Exclude) => return None,
        (true, InvalidRule::CountAs(discrepancy)) => Some(discrepancy),
        (false, _) => None,
    };
    match quantity {
        Quantity::Evaluations => Some(row.evaluations as f64),
        Quantity::Discrepancy => Some(counted_as.unwrap_or(row.discrepancy)),
        Quantity::Painted if counted_as.is_some() => cell.problem.world.properties().surface.is_some().then_some(0.0),
        Quantity::Painted => row.painted_percent,
    }
}

fn cumulative(rows: &[&RunRow]) -> Vec<Summary> {
    let goals = rows.iter().map(|row| row.evaluations_per_goal.len()).max().unwrap_or(0);
    let mut totals = vec![0u64; rows.len()];
    let after = |goal: usize| {
        for (total, row) in totals.iter_mut().zip(rows) {
            *total += row.evaluations_per_goal.get(goal).copied().unwrap_or(0);
        }
        Summary::of(&totals.iter().map(|total| *total as f64).collect::<Vec<_>>())
    };
    (0..goals).filter_map(after).collect()
}

impl CellResult {
    /// Statistics of `cell` over its finished `rows`.
    pub fn of<'r>(cell: &Cell, rows: impl Iterator<Item = &'r RunRow>) -> Self {
        let rows: Vec<&RunRow> = rows.collect();
        let summary =
            |quantity| Summary::of(&rows.iter().filter_map(|row| value(row, cell, quantity)).collect::<Vec<_>>());
        let counting = |row: &&&RunRow| value(row, cell, Quantity::Evaluations).is_some();
        let counted: Vec<&RunRow> = rows.iter().filter(counting).copied().collect();
        Self {
            table: cell.spec.table.clone(),
            action: cell.spec.action.clone(),
            setting: cell.spec.setting.clone(),
            repetitions: rows.len() as u64,
            invalid: rows.iter().filter(|row| row.invalid).count() as u64,
            evaluations: summary(Quantity::Evaluations),
            discrepancy: summary(Quantity::Discrepancy),
            painted: summary(Quantity::Painted),
            cumulative: cumulative(&counted),
        }
    }
}

impl Experiment {
    /// Compares cell `second` with cell `first` over the seeds that count in both; `None` if there is no such seed or
    /// cell.
    #[must_use]
    pub fn compare(&self, first: u32, second: u32, quantity: Quantity) -> Option<PairedComparison> {
        let cells = &self.plan().cells;
        let (first_cell, second_cell) = (cells.get(first as usize)?, cells.get(second as usize)?);
        let mut others = self.rows_of(second).peekable();
        let (mut left, mut right) = (Vec::new(), Vec::new());
        for row in self.rows_of(first) {
            while others.next_if(|other| other.id.repetition < row.id.repetition).is_some() {}
            let Some(other) = others.next_if(|other| other.id.repetition == row.id.repetition) else { continue };
            if let (Some(a), Some(b)) = (value(row, first_cell, quantity), value(other, second_cell, quantity)) {
                left.push(a);
                right.push(b);
            }
        }
        compare(&left, &right)
    }
}
