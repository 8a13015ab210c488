//! From a request to a plan: looks up presets and the paper's cells, fills in defaults, and checks each cell's problem
//! as a run would.

use crate::app::model::{AppError, EveryTable, ExperimentRequest, FieldError, PaperTable, limits};
use crate::app::{UseCases, chain_text, check_name, compute};
use crate::framework::execution::Iet;
use crate::framework::experiment::{CellSpec, ExperimentSpec, MatrixSpec, Plan};
use crate::reproduce::paper::PaperTables;
use crate::reproduce::shipped;

impl UseCases {
    /// The request with defaults filled in, and its plan.
    pub(in crate::app) async fn plan_experiment(
        &self,
        mut request: ExperimentRequest,
    ) -> Result<(ExperimentRequest, Plan), AppError> {
        let name = request.name.take().unwrap_or_else(|| default_name(&request));
        check_name("/name", &name)?;
        request.name = Some(name.clone());
        let seed = *request.seed.get_or_insert_with(|| self.ports.ids.seed());
        check_size(&request)?;
        if seed >= limits::SEED_BOUND - u64::from(request.repetitions) {
            let last = limits::SEED_BOUND - u64::from(request.repetitions);
            return Err(AppError::field("/seed", "out_of_range", format!("seed is {seed}: give one below {last}")));
        }
        compute(move || {
            let plan = plan(&request, name, seed)?;
            Ok((request, plan))
        })
        .await?
    }
}

fn default_name(request: &ExperimentRequest) -> String {
    match request.paper_table {
        Some(PaperTable::Number(table)) => format!("paper table {table}"),
        Some(PaperTable::Every(EveryTable::All)) => "paper tables".to_owned(),
        None => "experiment".to_owned(),
    }
}

/// Rejects requests that are too large before they are expanded.
fn check_size(request: &ExperimentRequest) -> Result<(), AppError> {
    let axes = |matrix: &MatrixSpec| {
        let lengths = [matrix.presets.len(), matrix.methods.len().max(1), matrix.settings.len().max(1)];
        lengths.into_iter().fold(1_usize, usize::saturating_mul)
    };
    let cells = request.cells.len().saturating_add(request.matrix.as_ref().map_or(0, axes));
    if cells > limits::MAX_CELLS as usize {
        let detail = format!("{cells} cells exceed the limit of {}: split the experiment", limits::MAX_CELLS);
        return Err(AppError::field("/matrix", "out_of_range", detail));
    }
    if request.repetitions == 0 {
        return Err(AppError::field("/repetitions", "out_of_range", "repetitions is 0: give 1 or more"));
    }
    if cells == 0 && request.paper_table.is_none() {
        let detail = "there is nothing to run: give paper_table, cells or a matrix";
        return Err(AppError::field("/cells", "required", detail));
    }
    Ok(())
}

fn plan(request: &ExperimentRequest, name: String, seed: u64) -> Result<Plan, AppError> {
    let repetitions = request.repetitions;
    let mut cells = paper_cells(request.paper_table, seed, repetitions)?;
    let of_paper = cells.len();
    cells.extend(request.cells.iter().cloned());
    let spec = ExperimentSpec { name, seed, repetitions, cells, matrix: request.matrix.clone() };
    let wrong =
        |error: &(dyn std::error::Error + 'static)| AppError::field("", "invalid_experiment", chain_text(error));
    let plan = spec.plan(|name| shipped::preset(name).ok()).map_err(|error| wrong(&error))?;
    if plan.runs() > u64::from(limits::MAX_EXPERIMENT_RUNS) {
        let detail =
            format!("{} runs exceed the limit of {}: split the experiment", plan.runs(), limits::MAX_EXPERIMENT_RUNS);
        return Err(AppError::field("/repetitions", "out_of_range", detail));
    }
    let mut errors = Vec::new();
    for (index, cell) in plan.cells.iter().enumerate().skip(of_paper) {
        if let Err(error) = Iet::new(&cell.problem, seed) {
            let place = index - of_paper;
            let given = place < request.cells.len();
            let pointer = if given { format!("/cells/{place}") } else { "/matrix".to_owned() };
            let detail = format!("{}, {}: {}", cell.spec.action, cell.spec.setting, chain_text(&error));
            errors.push(FieldError::new(pointer, "invalid_problem", detail));
        }
    }
    if errors.is_empty() { Ok(plan) } else { Err(AppError::invalid(errors)) }
}

fn paper_cells(wanted: Option<PaperTable>, seed: u64, repetitions: u32) -> Result<Vec<CellSpec>, AppError> {
    let only = match wanted {
        None => return Ok(Vec::new()),
        Some(PaperTable::Every(EveryTable::All)) => None,
        Some(PaperTable::Number(table)) if (1..=6).contains(&table) => Some(table),
        Some(PaperTable::Number(table)) => {
            let detail = format!("paper_table is {table}: give 1 to 6, or \"all\"");
            return Err(AppError::field("/paper_table", "out_of_range", detail));
        }
    };
    let tables = PaperTables::shipped().map_err(AppError::internal)?.only(only);
    Ok(tables.experiment(seed, repetitions).map_err(AppError::internal)?.cells)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn request(json: serde_json::Value) -> ExperimentRequest {
        serde_json::from_value(json).unwrap()
    }

    fn planned(json: serde_json::Value) -> Result<Plan, AppError> {
        let request = request(json);
        check_size(&request)?;
        plan(&request, "x".to_owned(), 1)
    }

    #[test]
    fn the_papers_cells_come_first_and_survive_storage_to_the_bit() {
        let one = planned(json!({"paper_table": 1, "repetitions": 2,
            "matrix": {"presets": ["paper-wax"], "settings": [{"name": "p 10", "overrides":
                {"execution": {"method": {"population": 10}}}}]}}));
        let one = one.unwrap();
        assert_eq!((one.cells.len(), one.runs()), (5, 10));
        assert_eq!(one.cells[4].spec.setting, "p 10");
        assert_eq!(planned(json!({"paper_table": "all", "repetitions": 1000})).unwrap().runs(), 28_000);
        let stored: Plan = serde_json::from_str(&serde_json::to_string(&one).unwrap()).unwrap();
        assert_eq!(stored, one);
    }

    #[test]
    fn what_is_wrong_is_told_by_its_place() {
        let many: Vec<_> = (0..40).map(|i| json!({"name": i.to_string()})).collect();
        let cell = |preset: &str, population: i32| {
            json!({"action": "a", "setting": "s", "preset": preset,
                "overrides": {"execution": {"method": {"name": "sst", "population": population}}}})
        };
        for (wrong, pointer) in [
            (json!({"repetitions": 1}), "/cells"),
            (json!({"paper_table": 7}), "/paper_table"),
            (json!({"paper_table": 1, "repetitions": 0}), "/repetitions"),
            (json!({"paper_table": 1, "repetitions": 100_000}), "/repetitions"),
            (json!({"matrix": {"presets": ["paper-wax"], "methods": many, "settings": many}}), "/matrix"),
            (json!({"cells": [cell("nowhere", 10)]}), ""),
            (json!({"cells": [cell("paper-wax", 1)]}), "/cells/0"),
        ] {
            let error = planned(wrong.clone()).unwrap_err();
            assert_eq!(error.details.first().map(|place| place.pointer.as_str()), Some(pointer), "{wrong}: {error}");
        }
        assert!(serde_json::from_value::<ExperimentRequest>(json!({"paper_table": "some"})).is_err());
    }
}
