//! An experiment as written by users, and its expansion into a self-contained plan of runs.

use super::patch::merge;
use crate::execution::Problem;
use crate::preset::Preset;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Maximum number of runs (cells x repetitions) of an experiment.
pub const MAX_RUNS: u64 = 1_000_000;

/// Description of an experiment: individual cells, a matrix, or both. Every cell runs the seeds
/// `seed..seed + repetitions`, so that cells can be compared in pairs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExperimentSpec {
    /// Display name.
    pub name: String,
    /// Seed of each cell's first repetition.
    #[serde(default)]
    pub seed: u64,
    /// Number of runs per cell (at least 1).
    pub repetitions: u32,
    /// Individual cells.
    #[serde(default)]
    pub cells: Vec<CellSpec>,
    /// Matrix of every preset with every method and every setting.
    #[serde(default)]
    pub matrix: Option<MatrixSpec>,
}

/// One cell: a preset and the changes to it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct CellSpec {
    /// Heading under which the cell is shown, for example the number of a table.
    #[serde(default)]
    pub table: String,
    /// Name of the action, for display.
    pub action: String,
    /// Setting that distinguishes the cell from its neighbours; (table, action, setting) is unique.
    pub setting: String,
    /// Name of the preset it starts from.
    pub preset: String,
    /// Method to use, with the preset's own parameters for it if it has any; the preset's first method if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub method: Option<String>,
    /// JSON merge patch over the preset's problem; selecting another `name`, `kind` or `strategy` replaces that whole
    /// choice.
    #[serde(default)]
    #[cfg_attr(feature = "schema", schema(value_type = Object))]
    pub overrides: Value,
    /// Treatment of a run without any feasible candidate at its last goal.
    #[serde(default)]
    pub invalid: InvalidRule,
}

/// Presets x methods x settings; an empty axis changes nothing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct MatrixSpec {
    /// Names of the presets to start from.
    pub presets: Vec<String>,
    /// First axis of overrides.
    #[serde(default)]
    pub methods: Vec<Variant>,
    /// Second axis of overrides, applied after the first.
    #[serde(default)]
    pub settings: Vec<Variant>,
    /// Treatment of invalid runs, as in [`CellSpec`].
    #[serde(default)]
    pub invalid: InvalidRule,
}

/// One point on an axis of the matrix.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct Variant {
    /// Name, shown as part of the cell's setting.
    pub name: String,
    /// Method to use, as in [`CellSpec`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub method: Option<String>,
    /// JSON merge patch over the problem.
    #[serde(default)]
    #[cfg_attr(feature = "schema", schema(value_type = Object))]
    pub overrides: Value,
}

/// Treatment of a run whose last goal ended without a feasible candidate.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum InvalidRule {
    /// It is left out of all statistics and counted as invalid.
    #[default]
    Exclude,
    /// It counts with this discrepancy (features' unit) and a painted share of 0.
    CountAs(f64),
}

/// A cell with its whole problem.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Cell {
    /// The cell as written, or as expanded from the matrix.
    pub spec: CellSpec,
    /// The preset's problem with the overrides applied.
    pub problem: Problem,
}

/// An expanded experiment: self-contained, even if presets change later.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Plan {
    /// Display name.
    pub name: String,
    /// Seed of each cell's first repetition.
    pub seed: u64,
    /// Number of runs per cell.
    pub repetitions: u32,
    /// Cells in table order.
    pub cells: Vec<Cell>,
}

/// Reasons why a description is not a valid experiment.
#[derive(Debug, thiserror::Error)]
pub enum ExperimentError {
    /// There is nothing to run.
    #[error("the experiment has {cells} cells of {repetitions} repetitions: give at least one of each")]
    Empty {
        /// Number of cells after expansion.
        cells: usize,
        /// Requested repetitions.
        repetitions: u32,
    },
    /// There are too many runs.
    #[error("{cells} cells x {repetitions} repetitions exceed the limit of {limit} runs: split the experiment")]
    TooManyRuns {
        /// Number of cells after expansion.
        cells: usize,
        /// Requested repetitions.
        repetitions: u32,
        /// Maximum number of runs.
        limit: u64,
    },
    /// The last seed exceeds 64 bits.
    #[error("seed {seed} with {repetitions} repetitions runs past the largest seed, {}: start lower", u64::MAX)]
    Seed {
        /// First seed.
        seed: u64,
        /// Requested repetitions.
        repetitions: u32,
    },
    /// The preset does not exist.
    #[error("cell {cell} ({setting:?}) starts from preset {preset:?}, which does not exist")]
    UnknownPreset {
        /// Index of the cell, from 0.
        cell: usize,
        /// Setting of the cell.
        setting: String,
        /// Name of the preset.
        preset: String,
    },
    /// The method does not exist.
    #[error("cell {cell} ({setting:?}) names method {method:?}, which does not exist")]
    UnknownMethod {
        /// Index of the cell, from 0.
        cell: usize,
        /// Setting of the cell.
        setting: String,
        /// Name of the method.
        method: String,
    },
    /// Two cells have the same names.
    #[error("cells {first} and {second} are both table {table:?}, action {action:?}, setting {setting:?}: rename one")]
    Duplicate {
        /// Index of the first cell, from 0.
        first: usize,
        /// Index of the second cell, from 0.
        second: usize,
        /// Table of both.
        table: String,
        /// Action of both.
        action: String,
        /// Setting of both.
        setting: String,
    },
    /// Overrides that are no object: a merge patch of any other kind would replace the whole problem.
    #[error("cell {cell} ({setting:?}): its overrides are not an object: give the members of the problem to change")]
    NoPatch {
        /// Index of the cell, from 0.
        cell: usize,
        /// Setting of the cell.
        setting: String,
    },
    /// A preset with overrides does not form a valid problem.
    #[error("cell {cell} ({setting:?}): its overrides do not fit preset {preset:?}")]
    Overrides {
        /// Index of the cell, from 0.
        cell: usize,
        /// Setting of the cell.
        setting: String,
        /// Name of the preset.
        preset: String,
        /// Underlying error.
        source: serde_json::Error,
    },
}

impl ExperimentSpec {
    /// All cells: the individual ones, then the matrix, ordered by preset, method and setting.
    #[must_use]
    pub fn all_cells(&self) -> Vec<CellSpec> {
        let mut cells = self.cells.clone();
        let Some(matrix) = &self.matrix else { return cells };
        let unchanged = [Variant { name: String::new(), method: None, overrides: Value::Null }];
        let axis = |variants: &'_ [Variant]| if variants.is_empty() { unchanged.to_vec() } else { variants.to_vec() };
        for preset in &matrix.presets {
            for method in &axis(&matrix.methods) {
                for setting in &axis(&matrix.settings) {
                    let names = [&method.name, &setting.name].map(String::as_str);
                    let names: Vec<&str> = names.into_iter().filter(|name| !name.is_empty()).collect();
                    let mut overrides = Value::Object(serde_json::Map::new());
                    for patch in [&method.overrides, &setting.overrides] {
                        if !patch.is_null() {
                            merge(&mut overrides, patch);
                        }
                    }
                    cells.push(CellSpec {
                        table: self.name.clone(),
                        action: preset.clone(),
                        setting: names.join(", "),
                        preset: preset.clone(),
                        method: setting.method.clone().or_else(|| method.method.clone()),
                        overrides,
                        invalid: matrix.invalid,
                    });
                }
            }
        }
        cells
    }

    /// Expands the experiment, building every cell's problem; `preset` looks up a preset by name.
    ///
    /// # Errors
    /// [`ExperimentError`] names the first cell that breaks a rule.
    pub fn plan(&self, preset: impl Fn(&str) -> Option<Preset>) -> Result<Plan, ExperimentError> {
        let cells = self.all_cells();
        let repetitions = self.repetitions;
        if cells.is_empty() || repetitions == 0 {
            return Err(ExperimentError::Empty { cells: cells.len(), repetitions });
        }
        if cells.len() as u64 * u64::from(repetitions) > MAX_RUNS {
            return Err(ExperimentError::TooManyRuns { cells: cells.len(), repetitions, limit: MAX_RUNS });
        }
        if self.seed.checked_add(u64::from(repetitions)).is_none() {
            return Err(ExperimentError::Seed { seed: self.seed, repetitions });
        }
        let cells = cells.into_iter().enumerate().map(|(index, spec)| place(index, spec, &preset));
        let cells = cells.collect::<Result<Vec<Cell>, _>>()?;
        refuse_duplicates(&cells)?;
        Ok(Plan { name: self.name.clone(), seed: self.seed, repetitions, cells })
    }
}

fn place(index: usize, spec: CellSpec, preset: impl Fn(&str) -> Option<Preset>) -> Result<Cell, ExperimentError> {
    let Some(mut preset) = preset(&spec.preset) else {
        return Err(ExperimentError::UnknownPreset { cell: index, setting: spec.setting, preset: spec.preset });
    };
    if let Some(method) = spec.method.as_ref().filter(|method| !preset.select_method(method)).cloned() {
        return Err(ExperimentError::UnknownMethod { cell: index, setting: spec.setting, method });
    }
    let base = preset.problem;
    if spec.overrides.is_null() {
        return Ok(Cell { spec, problem: base });
    }
    if !spec.overrides.is_object() {
        return Err(ExperimentError::NoPatch { cell: index, setting: spec.setting });
    }
    let patched = serde_json::to_value(&base).and_then(|mut value| {
        merge(&mut value, &spec.overrides);
        serde_json::from_value(value)
    });
    match patched {
        Ok(problem) => Ok(Cell { spec, problem }),
        Err(source) => {
            Err(ExperimentError::Overrides { cell: index, setting: spec.setting, preset: spec.preset, source })
        }
    }
}

fn refuse_duplicates(cells: &[Cell]) -> Result<(), ExperimentError> {
    let key = |spec: &CellSpec| (spec.table.clone(), spec.action.clone(), spec.setting.clone());
    let mut seen = std::collections::BTreeMap::new();
    for (second, cell) in cells.iter().enumerate() {
        if let Some(first) = seen.insert(key(&cell.spec), second) {
            let (table, action, setting) = key(&cell.spec);
            return Err(ExperimentError::Duplicate { first, second, table, action, setting });
        }
    }
    Ok(())
}
