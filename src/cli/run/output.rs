//! Output of `cgda run`: text, JSON and trajectory files.

use super::figures::Figures;
use super::seeded::Seeded;
use crate::framework::execution::{Chosen, RunResult};
use crate::framework::preset::Preset;
use crate::framework::robot::{Chain, RobotModel};
use crate::framework::trajectory::{PlanSpec, export, plan};
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
    painted_percent: Option<f64>,
    goals: Vec<Goal>,
    digest: &'a str,
}

#[derive(Serialize)]
struct Goal {
    index: usize,
    evaluations: u64,
    discrepancy: f64,
    stop_reason: crate::framework::method::per_goal::StopReason,
}

/// The result of all runs as one JSON object.
pub(super) fn json(seeded: &Seeded, seed: u64, runs: &[RunResult], figures: Figures) -> anyhow::Result<String> {
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
            .map(|run| Run {
                seed: run.seed,
                evaluations: run.evaluations,
                discrepancy: run.discrepancy,
                painted_percent: run.painted_percent,
                goals: run
                    .goals
                    .iter()
                    .map(|g| Goal {
                        index: g.index,
                        evaluations: g.evaluations,
                        discrepancy: g.discrepancy,
                        stop_reason: g.stop_reason,
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
pub(super) fn table(named: &Preset, runs: &[RunResult], figures: &Figures) -> String {
    let unit = named.problem.goals.features().first().map_or("", |f| f.unit.as_str());
    let mut text = format!("{}: {}\n{}", named.name, named.description, method(named));
    let Some(best) = runs.iter().min_by(|a, b| a.discrepancy.total_cmp(&b.discrepancy)) else { return text };
    if runs.len() > 1 {
        let _ = writeln!(text, "best of {} runs: seed {}", runs.len(), best.seed);
    }
    let _ = writeln!(
        text,
        "{:>5}  {:>11}  {:>14}  {:<15}  joints (rad or m)",
        "goal",
        "evaluations",
        format!("discrepancy {unit}"),
        "ended by"
    );
    for goal in &best.goals {
        let joints: Vec<String> = goal.joints.iter().map(|q| format!("{q:>8.4}")).collect();
        let reason = serde_json::to_value(goal.stop_reason).ok();
        let _ = writeln!(
            text,
            "{:>5}  {:>11}  {:>14.4}  {:<15}  {}",
            goal.index + 1,
            goal.evaluations,
            goal.discrepancy,
            reason.as_ref().and_then(|r| r.as_str()).unwrap_or_default(),
            joints.join(" ")
        );
    }
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

/// Plans each run's trajectory from the robot's home pose and writes it in three formats.
pub(super) fn write_trajectories(directory: &Path, named: &Preset, runs: &[RunResult]) -> anyhow::Result<()> {
    std::fs::create_dir_all(directory).with_context(|| format!("cannot create {}", directory.display()))?;
    let chain = Chain::new(&RobotModel::from_urdf(&named.problem.urdf)?, &named.problem.robot)?;
    let mut refused = 0;
    for run in runs {
        let trajectory = match plan(&chain, chain.home(), &run.waypoints(), &PlanSpec::default()) {
            Ok(trajectory) => trajectory,
            Err(error) => {
                eprintln!("no trajectory for seed {}: {error}", run.seed);
                refused += 1;
                continue;
            }
        };
        let stem = format!("{}-{}-{}", named.name, named.problem.execution.method.name(), run.seed);
        for (ending, text) in [
            ("csv", export::csv(&trajectory)),
            ("json", export::json(&trajectory)?),
            ("ros2.yaml", export::ros2_joint_trajectory(&trajectory)),
        ] {
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
