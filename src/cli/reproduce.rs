//! `cgda reproduce`: reruns the paper's tables and figures.

use super::experiment::finish;
use crate::framework::experiment::{Experiment, export};
use crate::reproduce::paper::{PaperCell, PaperTables};
use crate::reproduce::{figures, paper_markdown, shipped};
use anyhow::Context as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// Rerun the paper's tables and figures and compare them with the published values.
#[derive(Debug, clap::Args)]
pub struct ReproduceArguments {
    /// Only this table (1 to 6); all if absent.
    #[arg(long, value_parser = clap::value_parser!(u8).range(1..=6), conflicts_with = "figures")]
    table: Option<u8>,
    /// Runs per cell, with seeds counting up from --seed.
    #[arg(long, value_name = "R", default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..))]
    repetitions: u32,
    /// Seed of each cell's first run.
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Number of threads; all cores if absent. The results do not depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    threads: Option<u32>,
    /// Print CSV, one line per cell.
    #[arg(long)]
    csv: bool,
    /// Write the paper's figures 2, 4, 5, 6, 7, 8, 9 and 10 to this directory as SVG.
    #[arg(long, value_name = "DIR")]
    figures: Option<PathBuf>,
}

/// Runs the tables and prints them, or writes the figures.
///
/// # Errors
/// A directory that cannot be written, or a closed stdout.
pub fn run_command(arguments: &ReproduceArguments) -> anyhow::Result<()> {
    let tables = PaperTables::shipped()?.only(arguments.table);
    let spec = tables.experiment(arguments.seed, arguments.repetitions)?;
    let plan = spec.plan(|name| shipped::preset(name).ok())?;
    let mut experiment = Experiment::new(plan);
    if let Some((_, error)) = finish(&mut experiment, arguments.threads)?.into_iter().next() {
        return Err(error.into());
    }
    if let Some(folder) = &arguments.figures {
        return write_figures(folder, &experiment, &tables.cells);
    }
    let table = experiment.table();
    let text = if arguments.csv { export::paper_csv(&table) } else { paper_markdown(&tables.cells, &table) };
    std::io::stdout().lock().write_all(text.as_bytes())?;
    Ok(())
}

fn write_figures(folder: &Path, experiment: &Experiment, cells: &[PaperCell]) -> anyhow::Result<()> {
    std::fs::create_dir_all(folder).with_context(|| format!("cannot create {}", folder.display()))?;
    for (number, svg) in figures::figures(experiment, cells)? {
        let path = folder.join(format!("figure-{number:02}.svg"));
        std::fs::write(&path, svg).with_context(|| format!("cannot write {}", path.display()))?;
        eprintln!("{}", path.display());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::framework::experiment::{CellResult, Plan};

    fn plan(table: Option<u8>, repetitions: u32) -> (PaperTables, Plan) {
        let tables = PaperTables::shipped().unwrap().only(table);
        let spec = tables.experiment(1, repetitions).unwrap();
        let plan = spec.plan(|name| shipped::preset(name).ok()).unwrap();
        (tables, plan)
    }

    fn experiment(table: Option<u8>, repetitions: u32, threads: u32) -> (PaperTables, Experiment) {
        let (tables, plan) = plan(table, repetitions);
        let mut experiment = Experiment::new(plan);
        assert!(finish(&mut experiment, Some(threads)).unwrap().is_empty());
        (tables, experiment)
    }

    #[test]
    fn many_threads_give_the_bits_of_one() {
        let (one, many) = (experiment(Some(2), 6, 1).1, experiment(Some(2), 6, 3).1);
        assert_eq!(one, many);
        assert_eq!(export::paper_csv(&one.table()), export::paper_csv(&many.table()));
    }

    /// `cgda run --preset paper-wax --method pso` gives the same runs as the tables' cells.
    #[test]
    fn the_tables_run_the_presets_own_methods() {
        let (tables, plan) = plan(None, 1);
        let mut compared = 0;
        for (paper, cell) in tables.cells.iter().zip(&plan.cells).filter(|(paper, _)| paper.table <= 2) {
            let mut preset = shipped::preset(&paper.preset).unwrap();
            assert!(preset.select_method(&paper.setting.to_lowercase().replace('-', "_")), "{}", paper.setting);
            assert_eq!(preset.problem, cell.problem, "{} {}", paper.preset, paper.setting);
            compared += 1;
        }
        assert_eq!(compared, 8);
    }

    /// Means over only 20 runs, hence the tolerance of 40 %: a smoke test. 1000 runs stay within 8 and 13 %.
    #[test]
    fn every_cell_comes_near_the_paper_s_and_every_figure_is_drawn() {
        let (tables, experiment) = experiment(None, 20, 2);
        let near = |cell: &PaperCell, result: &CellResult| {
            let ratio = |found: Option<f64>, raw: f64| found.map_or(0.0, |found| found / raw);
            let evaluations = ratio(result.evaluations.map(|s| s.mean), cell.raw.evaluations);
            let discrepancy = ratio(result.discrepancy.map(|s| s.mean), cell.raw.discrepancy);
            let found = format!("table {}, {}: {evaluations:.2} {discrepancy:.2}", cell.table, cell.setting);
            ((evaluations - 1.0).abs() > 0.4 || (discrepancy - 1.0).abs() > 0.75).then_some(found)
        };
        let table = experiment.table();
        let far: Vec<_> = tables.cells.iter().zip(&table).filter_map(|(cell, result)| near(cell, result)).collect();
        assert!(far.is_empty(), "{far:#?}");
        let drawn = figures::figures(&experiment, &tables.cells).unwrap();
        assert_eq!(drawn.iter().map(|(number, _)| *number).collect::<Vec<_>>(), [2, 4, 5, 6, 7, 8, 9, 10]);
        for (number, svg) in drawn {
            let document = roxmltree::Document::parse(&svg).unwrap();
            let title = document.root_element().first_element_child().unwrap().text().unwrap();
            assert!(title.starts_with(&format!("Figure {number}. ")), "{title}");
        }
    }
}
