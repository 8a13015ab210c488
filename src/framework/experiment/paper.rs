//! The paper's tables as data: 28 cells with what they ran, what was published and what the raw logs hold.
//!
//! Source: R. Fernandez-Fernandez, J. G. Victores, D. Estevez, C. Balaguer, "Real evaluations tractability using
//! continuous goal-directed actions in smart city applications", 2018, doi:10.3390/s18113818; raw means and spreads
//! from the authors' published logs.

use super::{CellResult, CellSpec, ExperimentSpec, InvalidRule};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use utoipa::ToSchema;

/// The shipped file.
const TABLES: &str = include_str!("../../../examples/experiments/paper-tables.toml");

/// One published cell.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct PaperCell {
    /// Table 1 to 6.
    pub table: u8,
    /// `wax` or `paint`.
    pub action: String,
    /// Method, box or velocity, as the paper names it.
    pub setting: String,
    /// What was really run, in words.
    pub settings_as_run: String,
    /// The problem it starts from.
    pub preset: String,
    /// The tables' numbers.
    pub published: PaperNumbers,
    /// The numbers behind them.
    pub raw: PaperNumbers,
    /// Runs behind the raw numbers.
    pub runs: u32,
    /// What a run without feasible last goal counted for.
    #[serde(default)]
    pub invalid: InvalidRule,
    /// How near a correct implementation comes.
    #[serde(default)]
    pub tolerance: Tolerance,
    /// Corners of the box the tool had to stay in.
    #[serde(default)]
    pub box_m: Option<BoxCorners>,
    /// Limit V of the distance within the population, degrees summed over joints.
    #[serde(default)]
    pub velocity_deg: Option<f64>,
}

/// Corners of an axis-aligned box, m.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct BoxCorners {
    /// Least x, y, z.
    pub lower: [f64; 3],
    /// Greatest x, y, z.
    pub upper: [f64; 3],
}

/// Means and spreads of one source.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct PaperNumbers {
    /// Mean evaluations after the last goal.
    pub evaluations: f64,
    /// Their sd.
    #[serde(default)]
    pub evaluations_sd: Option<f64>,
    /// Mean discrepancy after the last goal, mm or percentage points.
    pub discrepancy: f64,
    /// Its sd.
    #[serde(default)]
    pub discrepancy_sd: Option<f64>,
    /// Mean share painted, %.
    #[serde(default)]
    pub painted_percent: Option<f64>,
}

/// Shares of the raw numbers within which the means of 1000 runs lie.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Tolerance {
    /// Of the evaluations.
    pub evaluations: f64,
    /// Of the discrepancy.
    pub discrepancy: f64,
    /// Of the percentage painted, points.
    pub painted_points: f64,
}

impl Default for Tolerance {
    fn default() -> Self {
        Self { evaluations: 0.08, discrepancy: 0.13, painted_points: 2.0 }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Tables {
    cells: Vec<PaperCell>,
}

/// All cells, table by table.
///
/// # Errors
/// If the shipped file is broken, which a test rules out.
pub fn cells() -> Result<Vec<PaperCell>, toml::de::Error> {
    Ok(toml::from_str::<Tables>(TABLES)?.cells)
}

impl PaperCell {
    /// The cell as an experiment runs it.
    #[must_use]
    pub fn spec(&self) -> CellSpec {
        CellSpec {
            table: self.table.to_string(),
            action: self.action.clone(),
            setting: self.setting.clone(),
            preset: self.preset.clone(),
            overrides: self.overrides(),
            invalid: self.invalid,
        }
    }

    fn overrides(&self) -> Value {
        Value::Null
    }

    /// What keeps `result` from agreeing with the raw numbers; empty where it does.
    #[must_use]
    pub fn disagreements(&self, result: &CellResult) -> Vec<Disagreement> {
        let sd_share = if self.action == "wax" { 0.25 } else { 0.35 };
        let (evaluations, discrepancy) = (result.evaluations, result.discrepancy);
        let share = |expected: Option<f64>, share: f64| expected.map(|expected| (expected, expected * share));
        let checks = [
            ("evaluations", evaluations.map(|s| s.mean), share(Some(self.raw.evaluations), self.tolerance.evaluations)),
            ("discrepancy", discrepancy.map(|s| s.mean), share(Some(self.raw.discrepancy), self.tolerance.discrepancy)),
            ("evaluations sd", evaluations.and_then(|s| s.sd), share(self.raw.evaluations_sd, sd_share)),
            ("discrepancy sd", discrepancy.and_then(|s| s.sd), share(self.raw.discrepancy_sd, sd_share)),
            (
                "painted",
                result.painted.map(|s| s.mean),
                self.published.painted_percent.map(|expected| (expected, self.tolerance.painted_points)),
            ),
        ];
        let judge = |(quantity, found, band): (&'static str, Option<f64>, Option<(f64, f64)>)| {
            let (expected, allowed) = band?;
            let agrees = found.is_some_and(|found| (found - expected).abs() <= allowed);
            (!agrees).then_some(Disagreement { quantity, found, expected, allowed })
        };
        checks.into_iter().filter_map(judge).collect()
    }
}

/// A number outside its band.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disagreement {
    /// What was compared.
    pub quantity: &'static str,
    /// Our number; none where no run counts.
    pub found: Option<f64>,
    /// The raw (painted: published) number.
    pub expected: f64,
    /// Largest difference allowed.
    pub allowed: f64,
}

/// The tables as an experiment: all six, or one.
#[must_use]
pub fn experiment(cells: &[PaperCell], table: Option<u8>, seed: u64, repetitions: u32) -> ExperimentSpec {
    let chosen = cells.iter().filter(|cell| table.is_none_or(|table| cell.table == table));
    let name = table.map_or_else(|| "paper tables 1 to 6".to_owned(), |table| format!("paper table {table}"));
    ExperimentSpec { name, seed, repetitions, cells: chosen.map(PaperCell::spec).collect(), matrix: None }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_28_cells_are_there_once() {
        let cells = cells().unwrap();
        assert_eq!(cells.len(), 28);
        let per_table: Vec<usize> = (1..=6).map(|t| cells.iter().filter(|c| c.table == t).count()).collect();
        assert_eq!(per_table, [4, 4, 5, 5, 5, 5]);
        let mut names: Vec<_> = cells.iter().map(|c| (c.table, c.setting.clone())).collect();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), 28);
    }

    /// The published means are the raw ones rounded, except for the cell that was copied from another.
    #[test]
    fn one_published_cell_is_a_copy() {
        let cells = cells().unwrap();
        let off = |cell: &&PaperCell| (cell.published.evaluations / cell.raw.evaluations - 1.0).abs() > 0.01;
        let copied: Vec<_> = cells.iter().filter(off).map(|cell| (cell.table, cell.setting.as_str())).collect();
        assert_eq!(copied, [(4, "v 20")]);
        let of = |table: u8, setting: &str| cells.iter().find(|c| c.table == table && c.setting == setting).unwrap();
        assert_eq!(of(4, "v 20").published.discrepancy, of(3, "box 0.3 m").published.discrepancy);
    }
}
