//! The paper's tables as data: 28 cells with their settings as run, the published numbers and those of the raw logs.
//!
//! Source: R. Fernandez-Fernandez, J. G. Victores, D. Estevez, C. Balaguer, "Real evaluations tractability using
//! continuous goal-directed actions in smart city applications"; raw means and spreads from the authors' published
//! logs.

use crate::framework::constraint::{ConstraintSpec, GeometrySpec, PointSpec, PopulationVelocitySpec, RegionSpec, Side};
use crate::framework::experiment::{CellSpec, ExperimentSpec, InvalidRule, merge};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use utoipa::ToSchema;

/// The shipped file.
const TABLES: &str = include_str!("../../examples/experiments/paper-tables.toml");

/// One published cell.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct PaperCell {
    /// Number of the table, 1 to 6.
    pub table: u8,
    /// `wax` or `paint`.
    pub action: String,
    /// Method, box or velocity, in the paper's words.
    pub setting: String,
    /// Description of what was really run.
    pub settings_as_run: String,
    /// Name of the preset it starts from.
    pub preset: String,
    /// Method to use, one of the preset's; the first if absent.
    #[serde(default)]
    pub method: Option<String>,
    /// Names of the patches to apply, in order.
    #[serde(default)]
    pub patches: Vec<String>,
    /// Numbers printed in the paper.
    pub published: PaperNumbers,
    /// Numbers from the raw logs.
    pub raw: PaperNumbers,
    /// Number of runs behind the raw numbers.
    pub runs: u32,
    /// Treatment of runs without a feasible last goal.
    #[serde(default)]
    pub invalid: InvalidRule,
    /// Bounds within which a correct implementation agrees.
    #[serde(default)]
    pub tolerance: Tolerance,
    /// Corners of the box that the tool had to stay in; `None` without a box.
    #[serde(default)]
    pub box_m: Option<BoxCorners>,
    /// Limit V of the distance within the population, degrees summed over joints; `None` without a limit.
    #[serde(default)]
    pub velocity_deg: Option<f64>,
}

/// Corners of an axis-aligned box, m.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct BoxCorners {
    /// Smallest x, y, z.
    pub lower: [f64; 3],
    /// Largest x, y, z.
    pub upper: [f64; 3],
}

/// Means and standard deviations from one source.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct PaperNumbers {
    /// Mean evaluations after the last goal.
    pub evaluations: f64,
    /// Standard deviation of the evaluations.
    #[serde(default)]
    pub evaluations_sd: Option<f64>,
    /// Mean discrepancy after the last goal, mm or percentage points.
    pub discrepancy: f64,
    /// Standard deviation of the discrepancy.
    #[serde(default)]
    pub discrepancy_sd: Option<f64>,
    /// Mean painted share, %.
    #[serde(default)]
    pub painted_percent: Option<f64>,
}

/// Relative bounds around the raw numbers within which the means of 1000 runs lie.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Tolerance {
    /// Relative bound for evaluations.
    pub evaluations: f64,
    /// Relative bound for the discrepancy.
    pub discrepancy: f64,
    /// Bound for the painted share, percentage points.
    pub painted_points: f64,
}

impl Default for Tolerance {
    fn default() -> Self {
        Self { evaluations: 0.08, discrepancy: 0.13, painted_points: 2.0 }
    }
}

/// The paper's tables: cells and the data they share.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PaperTables {
    /// Point that the boxes constrain.
    constrained_point: PointSpec,
    /// Merge patches by name.
    patches: BTreeMap<String, Value>,
    /// All cells, table by table.
    pub cells: Vec<PaperCell>,
}

/// Reasons why the tables cannot be run.
#[derive(Debug, thiserror::Error)]
pub enum PaperError {
    /// The file does not have the expected form.
    #[error("the paper's tables do not fit: {0}")]
    Toml(#[from] toml::de::Error),
    /// A constraint cannot be serialized.
    #[error("the paper's tables, setting {setting:?}: {source}")]
    Json {
        /// Setting of the cell.
        setting: String,
        /// Underlying error.
        source: serde_json::Error,
    },
    /// A cell names a patch that does not exist.
    #[error("the paper's tables, setting {setting:?}: there is no patch {patch:?}")]
    UnknownPatch {
        /// Setting of the cell.
        setting: String,
        /// Name of the patch.
        patch: String,
    },
}

impl PaperTables {
    /// Parses the shipped tables.
    ///
    /// # Errors
    /// If the shipped file is broken, which a test rules out.
    pub fn shipped() -> Result<Self, PaperError> {
        Ok(toml::from_str(TABLES)?)
    }

    /// Keeps only the cells of `table`; all if `None`.
    #[must_use]
    pub fn only(mut self, table: Option<u8>) -> Self {
        self.cells.retain(|cell| table.is_none_or(|table| cell.table == table));
        self
    }

    /// The cells as an experiment, in order.
    ///
    /// # Errors
    /// [`PaperError`] names the cell.
    pub fn experiment(&self, seed: u64, repetitions: u32) -> Result<ExperimentSpec, PaperError> {
        let cells = self.cells.iter().map(|cell| self.spec(cell)).collect::<Result<Vec<_>, _>>()?;
        Ok(ExperimentSpec { name: "paper tables".to_owned(), seed, repetitions, cells, matrix: None })
    }

    fn spec(&self, cell: &PaperCell) -> Result<CellSpec, PaperError> {
        let mut overrides = json!({});
        for name in &cell.patches {
            let unknown = || PaperError::UnknownPatch { setting: cell.setting.clone(), patch: name.clone() };
            merge(&mut overrides, self.patches.get(name).ok_or_else(unknown)?);
        }
        let geometry = cell.box_m.map(|corners| {
            let geometry = GeometrySpec::Box { lower_m: corners.lower, upper_m: corners.upper, dilatation_m: 0.0 };
            ConstraintSpec::Region(RegionSpec { geometry, side: Side::Inside, point: self.constrained_point.clone() })
        });
        let limit = cell.velocity_deg.map(f64::to_radians);
        let velocity = limit.map(|limit_rad| ConstraintSpec::PopulationVelocity(PopulationVelocitySpec { limit_rad }));
        let constraints: Vec<ConstraintSpec> = geometry.into_iter().chain(velocity).collect();
        if !constraints.is_empty() {
            let value = serde_json::to_value(constraints)
                .map_err(|source| PaperError::Json { setting: cell.setting.clone(), source })?;
            merge(&mut overrides, &json!({"execution": {"constraints": value}}));
        }
        Ok(CellSpec {
            table: cell.table.to_string(),
            action: cell.action.clone(),
            setting: cell.setting.clone(),
            preset: cell.preset.clone(),
            method: cell.method.clone(),
            overrides,
            invalid: cell.invalid,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_28_cells_are_there_once() {
        let cells = PaperTables::shipped().unwrap().cells;
        assert_eq!(cells.len(), 28);
        let per_table: Vec<usize> = (1..=6).map(|t| cells.iter().filter(|c| c.table == t).count()).collect();
        assert_eq!(per_table, [4, 4, 5, 5, 5, 5]);
        let mut names: Vec<_> = cells.iter().map(|c| (c.table, c.setting.clone())).collect();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), 28);
    }

    /// Published means are the raw ones rounded, except for the cell that was copied from another.
    #[test]
    fn one_published_cell_is_a_copy() {
        let cells = PaperTables::shipped().unwrap().cells;
        let off = |cell: &&PaperCell| (cell.published.evaluations / cell.raw.evaluations - 1.0).abs() > 0.01;
        let copied: Vec<_> = cells.iter().filter(off).map(|cell| (cell.table, cell.setting.as_str())).collect();
        assert_eq!(copied, [(4, "v 20")]);
        let of = |table: u8, setting: &str| cells.iter().find(|c| c.table == table && c.setting == setting).unwrap();
        assert_eq!(of(4, "v 20").published.discrepancy, of(3, "box 0.3 m").published.discrepancy);
    }
}
