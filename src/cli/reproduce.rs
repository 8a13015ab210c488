//! `cgda reproduce`: the paper's tables and figures, rerun.

use crate::framework::experiment::paper::{PaperCell, PaperTables};
use crate::framework::experiment::{Experiment, RunId, RunRow, export, paper_figures, run};
use crate::framework::preset;
use anyhow::Context as _;
use indicatif::{ParallelProgressIterator as _, ProgressBar, ProgressStyle};
use rayon::prelude::{IntoParallelRefIterator as _, ParallelIterator as _};
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// Rerun the paper's tables and figures beside what was published.
#[derive(Debug, clap::Args)]
pub struct ReproduceArguments {
    /// Only this table (1 to 6); all when absent.
    #[arg(long, value_parser = clap::value_parser!(u8).range(1..=6), conflicts_with = "figures")]
    table: Option<u8>,
    /// Runs of each cell; each cell runs the seeds from --seed on.
    #[arg(long, value_name = "R", default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..))]
    repetitions: u32,
    /// Seed of each cell's first run.
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Threads; all cores when absent. The results do not depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    threads: Option<u32>,
    /// Print CSV: one line a cell.
    #[arg(long)]
    csv: bool,
    /// Write the paper's figures 2, 4, 5, 6, 7, 8, 9 and 10 there as SVG.
    #[arg(long, value_name = "DIR")]
    figures: Option<PathBuf>,
}

/// Runs the tables and prints them, or writes the figures.
///
/// # Errors
/// A directory that cannot be written, a closed stdout.
pub fn run_command(arguments: &ReproduceArguments) -> anyhow::Result<()> {
    let tables = PaperTables::shipped()?.only(arguments.table);
    let spec = tables.experiment(arguments.seed, arguments.repetitions)?;
    let plan = spec.plan(|name| Some(preset::shipped(name).ok()?.problem))?;
    let mut experiment = Experiment::new(plan);
    finish(&mut experiment, arguments.threads)?;
    if let Some(folder) = &arguments.figures {
        return write_figures(folder, &experiment, &tables.cells);
    }
    let table = experiment.table();
    let text = if arguments.csv { export::paper_csv(&table) } else { export::paper_markdown(&tables.cells, &table) };
    std::io::stdout().lock().write_all(text.as_bytes())?;
    Ok(())
}

/// Runs what is pending on `threads` threads (all cores when absent).
fn finish(experiment: &mut Experiment, threads: Option<u32>) -> anyhow::Result<()> {
    let pending: Vec<RunId> = experiment.pending().collect();
    let bar = ProgressBar::new(pending.len() as u64);
    bar.set_style(ProgressStyle::with_template("{wide_bar} {pos}/{len} runs, {eta} left")?);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0) as usize).build()?;
    let plan = experiment.plan();
    let rows = pool.install(|| {
        let rows = pending.par_iter().progress_with(bar.clone()).map(|id| run(plan, *id));
        rows.collect::<Result<Vec<RunRow>, _>>()
    })?;
    bar.finish_and_clear();
    rows.into_iter().try_for_each(|row| experiment.record(row))?;
    Ok(())
}

fn write_figures(folder: &Path, experiment: &Experiment, cells: &[PaperCell]) -> anyhow::Result<()> {
    std::fs::create_dir_all(folder).with_context(|| format!("{} cannot be made", folder.display()))?;
    for (number, svg) in paper_figures::figures(experiment, cells)? {
        let path = folder.join(format!("figure-{number:02}.svg"));
        std::fs::write(&path, svg).with_context(|| format!("{} cannot be written", path.display()))?;
        eprintln!("{}", path.display());
    }
    Ok(())
}
