//! Output of `cgda run`: text, JSON and trajectory files.

use super::Delivered;
use super::figures::Figures;
use super::seeded::Seeded;
use crate::framework::execution::{Chosen, DiscrepancyEstimate, Replay, RunOutcome, RunVerdict, Verdict};
use crate::framework::motion::{JointStep, Motion};
use crate::framework::preset::Preset;
use crate::framework::trajectory::export::{ExportSpec, Exported};
use crate::framework::world::SimulatedRobot;
use anyhow::Context as _;
use serde::Serialize;
use std::fmt::Write as _;
use std::path::Path;

/// JSON object on stdout; its shape is stable.
#[derive(Serialize)]
struct Report<'a> {
    preset: &'a str,
    method: &'static str,
    /// Reason for the method; `None` unless `auto` chose it.
    #[serde(skip_serializing_if = "Option::is_none")]
    chosen: Option<&'a Chosen>,
    seed: u64,
    repetitions: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    after: Option<&'a str>,
    runs: Vec<Run<'a>>,
    #[serde(flatten)]
    figures: Figures,
}

#[derive(Serialize)]
struct Run<'a> {
    seed: u64,
    evaluations: u64,
    discrepancy: f64,
    /// Painted share that the trajectory leaves, %.
    painted_percent: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    estimate: Option<DiscrepancyEstimate>,
    verdict: RunVerdict,
    /// Cells that the trajectory paints, row * columns + column.
    #[serde(skip_serializing_if = "Option::is_none")]
    painted_cells: Option<Vec<usize>>,
    /// Largest move of one joint between successive poses, the first from home, rad or m.
    largest_step: Option<&'a JointStep>,
    replay: &'a Replay,
    /// The robot that stood for the real one.
    #[serde(skip_serializing_if = "Option::is_none")]
    simulated_robot: Option<&'a SimulatedRobot>,
    /// Reason why there is no trajectory.
    trajectory_problem: Option<String>,
    goals: Vec<Goal>,
    digest: &'a str,
}

#[derive(Serialize)]
struct Goal {
    index: usize,
    evaluations: u64,
    discrepancy: f64,
    stop_reason: crate::framework::method::per_goal::StopReason,
    verdict: Verdict,
    distance: Option<f64>,
    tolerance: f64,
}

/// The result of all runs as one JSON object.
pub(super) fn json(seeded: &Seeded, seed: u64, runs: &[Delivered], figures: Figures) -> anyhow::Result<String> {
    let named = &seeded.named;
    let report = Report {
        preset: &named.name,
        method: named.problem.execution.method.name(),
        chosen: named.problem.execution.chosen.as_ref(),
        seed,
        repetitions: runs.len(),
        after: seeded.after.as_ref().map(|before| before.name.as_str()),
        runs: runs
            .iter()
            .map(|Delivered { result: run, motion, simulated_robot }| Run {
                seed: run.seed,
                evaluations: run.evaluations,
                discrepancy: run.discrepancy,
                estimate: run.estimate,
                verdict: motion.verdict,
                painted_percent: motion.replay.painted_percent,
                painted_cells: motion.cells.as_ref().map(|cells| cells.iter().collect()),
                largest_step: motion.largest_step.as_ref(),
                replay: &motion.replay,
                simulated_robot: simulated_robot.as_ref(),
                trajectory_problem: motion.trajectory.as_ref().err().map(ToString::to_string),
                goals: run
                    .goals
                    .iter()
                    .map(|g| Goal {
                        index: g.index,
                        evaluations: g.evaluations,
                        discrepancy: g.discrepancy,
                        stop_reason: g.stop_reason,
                        verdict: g.judgement.verdict,
                        distance: g.judgement.distance,
                        tolerance: g.judgement.tolerance,
                    })
                    .collect(),
                digest: &run.digest,
            })
            .collect(),
        figures,
    };
    Ok(format!("{}\n", serde_json::to_string(&report)?))
}

/// A line with the chosen method and the reason; empty unless `auto` chose it.
pub(super) fn method(named: &Preset) -> String {
    let chosen = named.problem.execution.chosen.as_ref();
    chosen.map_or_else(String::new, |Chosen { method, reason }| format!("method {method}: {reason}\n"))
}

/// Table of the best run's goals, followed by the statistics over all runs.
pub(super) fn table(named: &Preset, runs: &[Delivered], figures: &Figures) -> String {
    let unit = named.problem.goals.features().first().map_or("", |f| f.unit.as_str());
    let mut text = format!("{}: {}\n{}", named.name, named.description, method(named));
    let best = runs.iter().min_by(|a, b| a.result.discrepancy.total_cmp(&b.result.discrepancy));
    let Some(Delivered { result: best, motion, .. }) = best else { return text };
    if runs.len() > 1 {
        let _ = writeln!(text, "best of {} runs: seed {}", runs.len(), best.seed);
    }
    let _ = writeln!(
        text,
        "{:>5}  {:>11}  {:>14}  {:<15}  {:<13}  joints (rad or m)",
        "goal",
        "evaluations",
        format!("discrepancy {unit}"),
        "ended by",
        "verdict"
    );
    for goal in &best.goals {
        let joints: Vec<String> = goal.joints.iter().map(|q| format!("{q:>8.4}")).collect();
        let _ = writeln!(
            text,
            "{:>5}  {:>11}  {:>14.4}  {:<15}  {:<13}  {}",
            goal.index + 1,
            goal.evaluations,
            goal.discrepancy,
            word(goal.stop_reason),
            word(goal.judgement.verdict),
            joints.join(" ")
        );
    }
    let tolerance = best.goals.first().map_or(0.0, |goal| goal.judgement.tolerance);
    let _ = writeln!(text, "{} (tolerance {tolerance:.3} {unit})", outcome(motion.verdict));
    if let Some(DiscrepancyEstimate { value, lower, upper }) = best.estimate {
        let _ = writeln!(text, "true discrepancy, estimated: {value:.3} {unit}, 95 % within {lower:.3} to {upper:.3}");
    }
    text.push_str(&effect(motion, unit));
    for (name, statistic) in [("mean", &figures.mean), ("median", &figures.median), ("p90", &figures.p90)] {
        if runs.len() == 1 && name != "mean" {
            continue;
        }
        let which = if runs.len() == 1 { "1 run".to_owned() } else { format!("{name} over {} runs", runs.len()) };
        let _ = write!(
            text,
            "{which}: {:.1} evaluations, discrepancy {:.3} {unit}",
            statistic.evaluations, statistic.discrepancy
        );
        if let Some(painted) = statistic.painted_percent {
            let _ = write!(text, ", painted {painted:.2} %");
        }
        text.push('\n');
    }
    if let Some(reached) = &figures.threshold {
        let percent = 100.0 * reached.share;
        let _ = writeln!(text, "discrepancy at most {} {unit}: {percent:.0} % of the runs", reached.discrepancy);
    }
    text
}

/// The name of a value as JSON has it.
fn word(value: impl Serialize) -> String {
    let json = serde_json::to_value(value).ok();
    json.as_ref().and_then(|json| json.as_str()).unwrap_or_default().to_owned()
}

/// The verdict on a run, in words.
fn outcome(verdict: RunVerdict) -> String {
    let goals = |count: u32| if count == 1 { "1 goal".to_owned() } else { format!("{count} goals") };
    match verdict.outcome {
        RunOutcome::Complete => "complete".to_owned(),
        RunOutcome::GoalsMissed => {
            let RunVerdict { stopped_short, out_of_reach, .. } = verdict;
            let missed = goals(verdict.missed());
            format!("complete with {missed} missed: {stopped_short} stopped short, {out_of_reach} out of reach")
        }
        RunOutcome::Invalid => "invalid: some joints violate the constraints, or the replay differs".to_owned(),
    }
}

/// A line with the effect of the trajectory by its replay, or with the reason why there is none.
fn effect(motion: &Motion, unit: &str) -> String {
    let Motion { trajectory, replay, .. } = motion;
    let mut text = format!("replayed: discrepancy {:.4} {unit} at the goals", replay.discrepancy);
    if let Some(along) = &replay.along {
        let _ = write!(text, ", {:.4} {unit} along the motion", along.discrepancy);
    }
    if let Some(painted) = replay.painted_percent {
        let _ = write!(text, ", painted {painted:.2} %");
    }
    text.push('\n');
    match trajectory {
        Ok(trajectory) => _ = writeln!(text, "trajectory: {:.2} s", trajectory.duration_s()),
        Err(why) => _ = writeln!(text, "no trajectory: {why}"),
    }
    text
}

/// Writes each run's trajectory in three formats, with the joints' names of `names`.
pub(super) fn write_trajectories(
    directory: &Path,
    named: &Preset,
    runs: &[Delivered],
    names: &ExportSpec,
) -> anyhow::Result<()> {
    std::fs::create_dir_all(directory).with_context(|| format!("cannot create {}", directory.display()))?;
    let mut refused = 0;
    for Delivered { result: run, motion, .. } in runs {
        let trajectory = match &motion.trajectory {
            Ok(trajectory) => trajectory,
            Err(error) => {
                eprintln!("no trajectory for seed {}: {error}", run.seed);
                refused += 1;
                continue;
            }
        };
        let exported = Exported::new(trajectory, names)?;
        let stem = format!("{}-{}-{}", named.name, named.problem.execution.method.name(), run.seed);
        for (ending, text) in
            [("csv", exported.csv()), ("json", exported.json()?), ("ros2.yaml", exported.ros2_joint_trajectory())]
        {
            let path = directory.join(format!("{stem}.{ending}"));
            std::fs::write(&path, text).with_context(|| format!("cannot write {}", path.display()))?;
        }
        for note in trajectory.notes() {
            eprintln!("seed {}: {note}", run.seed);
        }
    }
    let written = match runs.len() - refused {
        1 => "1 trajectory".to_owned(),
        count => format!("{count} trajectories"),
    };
    eprintln!("{written} written to {}", directory.display());
    Ok(())
}
