//! An experiment as users write it, and its expansion into a self-contained plan of runs.

use super::patch::merge;
use crate::execution::Problem;
use crate::preset::Preset;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use utoipa::ToSchema;

/// Most runs (cells x repetitions) one experiment may have.
pub const MAX_RUNS: u64 = 1_000_000;

/// What to run: single cells, a matrix, or both; every cell runs the seeds `seed..seed + repetitions`, so that cells
/// can be compared pair by pair.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct ExperimentSpec {
    /// Display name.
    pub name: String,
    /// Seed of each cell's first repetition.
    #[serde(default)]
    pub seed: u64,
    /// Runs of each cell (at least 1).
    pub repetitions: u32,
    /// Cells one by one.
    #[serde(default)]
    pub cells: Vec<CellSpec>,
    /// Every preset with every method and every setting.
    #[serde(default)]
    pub matrix: Option<MatrixSpec>,
}

/// One cell: a preset and what it changes in it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct CellSpec {
    /// What the cell is shown under, for example a table's number.
    #[serde(default)]
    pub table: String,
    /// The action executed, for display.
    pub action: String,
    /// What tells the cell from its neighbours; (table, action, setting) is unique.
    pub setting: String,
    /// The problem it starts from.
    pub preset: String,
    /// Which of the preset's methods searches, with the preset's own parameters where it has some; its first where absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub method: Option<String>,
    /// JSON merge patch over the preset's problem; picking another `name`, `kind` or `strategy` replaces that whole choice.
    #[serde(default)]
    #[schema(value_type = Object)]
    pub overrides: Value,
    /// What a run without any feasible candidate at its last goal counts for.
    #[serde(default)]
    pub invalid: InvalidRule,
}

/// Presets x methods x settings; an axis left empty changes nothing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct MatrixSpec {
    /// Problems to start from.
    pub presets: Vec<String>,
    /// First axis of overrides.
    #[serde(default)]
    pub methods: Vec<Variant>,
    /// Second axis of overrides, applied after the first.
    #[serde(default)]
    pub settings: Vec<Variant>,
    /// As in [`CellSpec`].
    #[serde(default)]
    pub invalid: InvalidRule,
}

/// One point of an axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct Variant {
    /// Shown as the cell's setting.
    pub name: String,
    /// As in [`CellSpec`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub method: Option<String>,
    /// JSON merge patch over the problem.
    #[serde(default)]
    #[schema(value_type = Object)]
    pub overrides: Value,
}

/// What a run counts for when its last goal ended without a feasible candidate.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum InvalidRule {
    /// It is left out of every statistic and counted as invalid.
    #[default]
    Exclude,
    /// It counts with this discrepancy (features' unit) and nothing painted.
    CountAs(f64),
}

/// A cell with its whole problem.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Cell {
    /// As written or expanded from the matrix.
    pub spec: CellSpec,
    /// The preset with the overrides in place.
    pub problem: Problem,
}

/// An experiment expanded: all it takes to run it, whatever becomes of the presets.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Plan {
    /// Display name.
    pub name: String,
    /// Seed of each cell's first repetition.
    pub seed: u64,
    /// Runs of each cell.
    pub repetitions: u32,
    /// In table order.
    pub cells: Vec<Cell>,
}

/// Why a description is not an experiment.
#[derive(Debug, thiserror::Error)]
pub enum ExperimentError {
    /// Nothing to run.
    #[error("the experiment has {cells} cells of {repetitions} repetitions: give at least one of each")]
    Empty {
        /// Cells after expansion.
        cells: usize,
        /// Repetitions asked for.
        repetitions: u32,
    },
    /// Too much to run.
    #[error("{cells} cells x {repetitions} repetitions are more than {limit} runs: split the experiment")]
    TooManyRuns {
        /// Cells after expansion.
        cells: usize,
        /// Repetitions asked for.
        repetitions: u32,
        /// The limit.
        limit: u64,
    },
    /// Seeds beyond 64 bits.
    #[error("seed {seed} with {repetitions} repetitions runs past the largest seed, {}: start lower", u64::MAX)]
    Seed {
        /// First seed.
        seed: u64,
        /// Repetitions asked for.
        repetitions: u32,
    },
    /// A preset nobody knows.
    #[error("cell {cell} ({setting:?}) starts from preset {preset:?}, which does not exist")]
    UnknownPreset {
        /// Cell index from 0.
        cell: usize,
        /// Its setting.
        setting: String,
        /// The preset named.
        preset: String,
    },
    /// A method nobody knows.
    #[error("cell {cell} ({setting:?}) names method {method:?}, which does not exist")]
    UnknownMethod {
        /// Cell index from 0.
        cell: usize,
        /// Its setting.
        setting: String,
        /// The method named.
        method: String,
    },
    /// Two cells nobody could tell apart.
    #[error("cells {first} and {second} are both table {table:?}, action {action:?}, setting {setting:?}: rename one")]
    Duplicate {
        /// Cell index from 0.
        first: usize,
        /// Cell index from 0.
        second: usize,
        /// Their table.
        table: String,
        /// Their action.
        action: String,
        /// Their setting.
        setting: String,
    },
    /// A preset with overrides that is no problem.
    #[error("cell {cell} ({setting:?}): its overrides do not fit preset {preset:?}")]
    Overrides {
        /// Cell index from 0.
        cell: usize,
        /// Its setting.
        setting: String,
        /// Its preset.
        preset: String,
        /// What did not fit.
        source: serde_json::Error,
    },
}

impl ExperimentSpec {
    /// All cells: those given one by one, then the matrix, preset by preset, method by method, setting by setting.
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

    /// The experiment with every cell's problem in place; `preset` finds one by its name.
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
