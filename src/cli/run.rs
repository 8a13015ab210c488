//! `cgda run`: executes a problem, from a preset or from demonstrations, for R seeds on all cores.

mod collisions;
mod dry_run;
mod figures;
mod output;
mod planning;
mod problem;
mod reality;
mod seeded;

use crate::app::model::limits::MAX_TRIAL_S;
use crate::framework::execution::{Iet, ROBOT_TRIAL_S, RunResult, simulate};
use crate::framework::motion::{Motion, deliver};
use crate::framework::range::{Range, above};
use crate::framework::trajectory::PlanSpec;
use crate::framework::world::SimulatedRobot;
use anyhow::Context as _;
use figures::Figures;
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;
use seeded::Seeded;
use std::io::{IsTerminal as _, Write as _};
use std::path::PathBuf;

/// A finished run and its motion.
struct Delivered {
    result: RunResult,
    motion: Motion,
    /// The robot that stood for the real one; `None` if it was as described.
    simulated_robot: Option<SimulatedRobot>,
}

/// Number of evaluations between updates of the progress bar.
const SLICE: u64 = 2_000;

const USAGE: &str = "cgda run --preset <NAME> [OPTIONS]\n       \
                     cgda run --robot <URDF> --world <FILE> [OPTIONS] <FILES>...";

/// Find the joint trajectory that produces the demonstrated effects.
#[derive(Debug, clap::Args)]
#[command(allow_negative_numbers = true, override_usage = USAGE)]
pub struct RunArguments {
    #[command(flatten)]
    problem: problem::ProblemArguments,
    /// Seed of the first repetition; the others count up from it.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Number of independent runs.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    repetitions: u32,
    /// Also print the share of runs whose discrepancy is at most this (features' unit); the preset's own threshold if
    /// absent.
    #[arg(long, value_parser = positive)]
    threshold: Option<f64>,
    /// Execute this preset's action before each run, on the same robot with the same seed, and reuse its trials.
    #[arg(long, value_name = "PRESET")]
    after: Option<String>,
    /// Start the robot in a pose drawn from the seed, uniformly within its limits.
    #[arg(long)]
    random_start: bool,
    /// Number of threads; all cores if absent. The result does not depend on it.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Write each run's trajectory to this directory as CSV, JSON and ROS 2 JointTrajectory.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    planning: planning::PlanningArguments,
    /// Print one JSON object on stdout.
    #[arg(long)]
    json: bool,
    /// Only estimate what the runs would cost.
    #[arg(long)]
    dry_run: bool,
    /// Duration of a trial on a robot, seconds, for --dry-run.
    #[arg(long, value_name = "SECONDS", default_value_t = ROBOT_TRIAL_S, value_parser = trial_s)]
    robot_trial_s: f64,
}

fn positive(argument: &str) -> Result<f64, String> {
    within(above(0.0).up_to(1e9), argument)
}

fn trial_s(argument: &str) -> Result<f64, String> {
    within(above(0.0).up_to(MAX_TRIAL_S), argument)
}

fn within(range: Range, argument: &str) -> Result<f64, String> {
    let value = argument.parse().ok().filter(|&value| range.contains(value));
    value.ok_or_else(|| format!("give {range}"))
}

/// Runs the problem and prints its results.
///
/// # Errors
/// Invalid input, a problem whose parts do not fit together, or files that cannot be written.
pub fn run(arguments: &RunArguments) -> anyhow::Result<()> {
    let named = problem::read(&arguments.problem)?;
    let after = arguments.after.as_ref().map(|preset| problem::read_like(&arguments.problem, preset)).transpose()?;
    // Fails before any thread is started.
    let iet = Iet::new(&named.problem, arguments.seed)?;
    let seeded = Seeded::new(named, after, arguments.random_start)?;
    let last = u64::from(arguments.repetitions - 1);
    arguments.seed.checked_add(last).context("the last repetition's seed exceeds 64 bits: give a smaller --seed")?;
    if arguments.dry_run {
        let RunArguments { seed, repetitions, robot_trial_s, json, .. } = *arguments;
        let text = dry_run::report(&seeded, seed, repetitions, robot_trial_s, json)?;
        return Ok(std::io::stdout().lock().write_all(text.as_bytes())?);
    }
    let planning = arguments.planning.spec();
    planning.check(iet.chain())?;
    let names = arguments.planning.names();
    names.check(iet.chain())?;
    if !seeded.named.problem.execution.checks_collisions() {
        eprintln!("collisions are not checked: the arm may pass through itself and through what it works on");
    }
    let seeds: Vec<u64> = (0..=last).map(|offset| arguments.seed + offset).collect();
    let runs = search(&seeded, &seeds, &planning, arguments.threads)?;
    if let Some(directory) = &arguments.out {
        output::write_trajectories(directory, &seeded.named, &runs, &names)?;
    }
    let figures = Figures::of(&runs, arguments.threshold.or(seeded.named.threshold)).context("there were no runs")?;
    let text = if arguments.json {
        output::json(&seeded, arguments.seed, &runs, figures)?
    } else {
        output::table(&seeded.named, &runs, &figures)
    };
    std::io::stdout().lock().write_all(text.as_bytes())?;
    Ok(())
}

/// Executes all runs; the results are in the order of `seeds`.
fn search(seeded: &Seeded, seeds: &[u64], planning: &PlanSpec, threads: Option<u16>) -> anyhow::Result<Vec<Delivered>> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.map_or(0, usize::from)).build()?;
    let bar = progress_bar((seeds.len() * seeded.named.problem.goals.len()) as u64);
    let runs = pool.install(|| seeds.par_iter().map(|&seed| one(seeded, seed, planning, &bar)).collect());
    bar.finish_and_clear();
    runs
}

fn one(seeded: &Seeded, seed: u64, planning: &PlanSpec, bar: &ProgressBar) -> anyhow::Result<Delivered> {
    let problem = seeded.problem(seed)?;
    let mut iet = Iet::new(&problem, seed)?;
    let mut world = iet.world()?;
    let mut goals_done = 0;
    while !iet.is_finished() {
        simulate(&mut iet, world.as_mut(), SLICE).with_context(|| format!("seed {seed}"))?;
        let done = iet.progress().results.len();
        bar.inc((done - goals_done) as u64);
        goals_done = done;
    }
    let reality = problem.execution.reality.as_ref().filter(|reality| reality.is_distorted());
    let simulated_robot = reality.map(|reality| reality.robot(iet.chain(), seed));
    let result = iet.finish()?;
    let motion = deliver(&problem, &result, planning)?;
    Ok(Delivered { result, motion, simulated_robot })
}

fn progress_bar(goals: u64) -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} goals  {elapsed} elapsed, {eta} left")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(goals).with_style(style)
}

#[cfg(test)]
mod tests {
    use super::trial_s;

    #[test]
    fn a_trial_takes_as_long_as_over_the_network() {
        assert_eq!(trial_s("86400"), Ok(86_400.0));
        for wrong in ["86400.1", "0", "nan", "inf", "x"] {
            assert_eq!(trial_s(wrong).unwrap_err(), "give more than 0 and at most 86400", "{wrong}");
        }
    }
}
