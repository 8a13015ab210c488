//! `cgda experiment`: runs a matrix of settings from a TOML file on all cores; prints a table and writes a figure.

use crate::framework::experiment::{CellResult, Experiment, ExperimentSpec, RunError, RunId, RunRow, export, run};
use crate::reproduce::figure::{Method, trade_off};
use crate::reproduce::shipped;
use anyhow::{Context as _, ensure};
use indicatif::{ParallelProgressIterator as _, ProgressBar, ProgressStyle};
use rayon::iter::Either;
use rayon::prelude::{IntoParallelRefIterator as _, ParallelIterator as _};
use std::error::Error as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// Run an experiment: cells of presets, methods and settings, all with the same seeds.
#[derive(Debug, clap::Args)]
pub struct ExperimentArguments {
    /// The experiment: a TOML file (see docs/experiments.md).
    file: PathBuf,
    /// Runs per cell; overrides the file's value.
    #[arg(long, value_name = "R", value_parser = clap::value_parser!(u32).range(1..))]
    repetitions: Option<u32>,
    /// Seed of each cell's first run; overrides the file's value.
    #[arg(long, value_name = "S")]
    seed: Option<u64>,
    /// Number of threads; all cores if absent. The results do not depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    threads: Option<u32>,
    /// Print CSV with every statistic, one line per cell.
    #[arg(long)]
    csv: bool,
    /// Write a figure of evaluations against discrepancy to this file, as SVG with one marker per cell.
    #[arg(long, value_name = "SVG")]
    figure: Option<PathBuf>,
}

/// Runs the experiment and prints its table.
///
/// # Errors
/// The file is not a valid experiment, a cell cannot be executed, or the figure cannot be written.
pub fn run_command(arguments: &ExperimentArguments) -> anyhow::Result<()> {
    let spec = read(&arguments.file)?;
    let spec = ExperimentSpec {
        repetitions: arguments.repetitions.unwrap_or(spec.repetitions),
        seed: arguments.seed.unwrap_or(spec.seed),
        ..spec
    };
    let mut experiment = Experiment::new(spec.plan(|name| shipped::preset(name).ok())?);
    let lost = finish(&mut experiment, arguments.threads)?;
    report(&lost, &experiment)?;
    if let Some(path) = &arguments.figure {
        std::fs::write(path, figure(&experiment)?).with_context(|| format!("cannot write {}", path.display()))?;
    }
    let mut table = experiment.table();
    count(&lost, &mut table);
    let text = if arguments.csv { export::full_csv(&table) } else { export::markdown(&table) };
    std::io::stdout().lock().write_all(text.as_bytes())?;
    Ok(())
}

fn read(path: &Path) -> anyhow::Result<ExperimentSpec> {
    let text = std::fs::read_to_string(path).with_context(|| format!("cannot read {}", path.display()))?;
    toml::from_str(&text).with_context(|| format!("{} is not a valid experiment", path.display()))
}

/// A run that could not be finished, with the reason.
pub(super) type Lost = (RunId, RunError);

/// Reports every lost run on stderr.
///
/// # Errors
/// The first one, if no run finished.
fn report(lost: &[Lost], experiment: &Experiment) -> anyhow::Result<()> {
    for (_, error) in lost {
        let cause = error.source().map_or_else(String::new, |cause| format!(": {cause}"));
        ensure!(experiment.rows().len() > 0, "{error}{cause}");
        eprintln!("counted as invalid: {error}{cause}");
    }
    Ok(())
}

/// Counts lost runs as invalid runs of their cells.
fn count(lost: &[Lost], table: &mut [CellResult]) {
    for (id, _) in lost {
        if let Some(cell) = table.get_mut(id.cell as usize) {
            cell.repetitions += 1;
            cell.invalid += 1;
        }
    }
}

/// Executes the pending runs on `threads` threads (all cores if `None`) and returns those that could not be finished.
///
/// # Errors
/// The threads cannot be started, or a row does not belong to the plan.
pub(super) fn finish(experiment: &mut Experiment, threads: Option<u32>) -> anyhow::Result<Vec<Lost>> {
    let pending: Vec<RunId> = experiment.pending().collect();
    let bar = ProgressBar::new(pending.len() as u64);
    bar.set_style(ProgressStyle::with_template("{wide_bar} {pos}/{len} runs, {eta} left")?);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0) as usize).build()?;
    let plan = experiment.plan();
    let (rows, lost): (Vec<RunRow>, Vec<Lost>) = pool.install(|| {
        let runs = pending.par_iter().progress_with(bar.clone());
        runs.partition_map(|id| match run(plan, *id) {
            Ok(row) => Either::Left(row),
            Err(error) => Either::Right((*id, error)),
        })
    });
    bar.finish_and_clear();
    rows.into_iter().try_for_each(|row| experiment.record(row))?;
    Ok(lost)
}

/// Evaluations against discrepancy for every cell with at least one valid run, as SVG.
fn figure(experiment: &Experiment) -> anyhow::Result<String> {
    let plan = experiment.plan();
    let unit = |cell: usize| plan.cells[cell].problem.goals.features()[0].unit.as_str();
    let other = (1..plan.cells.len()).find(|cell| unit(*cell) != unit(0));
    ensure!(
        other.is_none(),
        "cells in {:?} and {:?} cannot share an axis: use one unit, or omit --figure",
        unit(0),
        other.map_or("", unit)
    );
    let methods = experiment.table().into_iter().filter_map(|cell| {
        Some(Method { name: cell.setting, evaluations: cell.evaluations?, discrepancy: cell.discrepancy? })
    });
    Ok(trade_off(&plan.name, unit(0), &methods.collect::<Vec<_>>())?)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spec() -> ExperimentSpec {
        read(Path::new("examples/experiments/few-evaluations.toml")).unwrap()
    }

    fn done(repetitions: u32, threads: u32, keep: impl Fn(&str) -> bool) -> Experiment {
        let mut spec = ExperimentSpec { repetitions, ..spec() };
        spec.cells.retain(|cell| keep(&cell.setting));
        let mut experiment = Experiment::new(spec.plan(|name| shipped::preset(name).ok()).unwrap());
        assert!(finish(&mut experiment, Some(threads)).unwrap().is_empty());
        experiment
    }

    #[test]
    fn the_shipped_comparison_holds_every_method_and_draws_its_figure() {
        let experiment = done(2, 2, |setting| setting.contains(" mm") || setting == "FI-PSO");
        let svg = figure(&experiment).unwrap();
        assert!(svg.contains("discrepancy (mm)") && svg.contains("FI-PSO"), "{svg}");
        let plan = spec().plan(|name| shipped::preset(name).ok()).unwrap();
        let found: std::collections::BTreeSet<_> =
            plan.cells.iter().map(|cell| cell.problem.execution.method.name()).collect();
        assert_eq!(Vec::from_iter(found), ["affg_pso", "broyden", "cma_es", "fi_pso", "model", "pso", "sst"]);
    }

    #[test]
    fn a_lost_run_is_counted_as_invalid_and_costs_no_other_row() {
        let experiment = done(1, 1, |setting| setting == "FI-PSO");
        let id = RunId { cell: 0, repetition: 1 };
        let lost = [(id, run(experiment.plan(), id).unwrap_err())];
        report(&lost, &experiment).unwrap();
        let mut table = experiment.table();
        let discrepancy = table[0].discrepancy;
        count(&lost, &mut table);
        assert_eq!((table[0].repetitions, table[0].invalid, table[0].discrepancy), (2, 1, discrepancy));
        let nothing = Experiment::new(experiment.plan().clone());
        assert!(report(&lost, &nothing).unwrap_err().to_string().contains("repetition 1"));
    }

    /// Covers every method, including swarms and whole-run methods.
    #[test]
    fn two_threads_give_the_bits_of_one() {
        let quick = |setting: &str| setting != "SST";
        assert_eq!(done(2, 1, quick), done(2, 2, quick));
    }
}
