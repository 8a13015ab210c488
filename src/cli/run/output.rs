//! What `cgda run` prints and writes.

use crate::framework::execution::RunResult;
use crate::framework::preset::Preset;
use crate::framework::robot::{Chain, RobotModel};
use crate::framework::trajectory::{PlanSpec, export, plan};
use anyhow::Context as _;
use serde::Serialize;
use std::fmt::Write as _;
use std::path::Path;

/// The object on stdout; its shape is stable.
#[derive(Serialize)]
struct Report<'a> {
    preset: &'a str,
    method: &'static str,
    seed: u64,
    repetitions: usize,
    runs: Vec<Run<'a>>,
    mean: Mean,
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
    stop_reason: crate::framework::optimizer::StopReason,
}

#[derive(Serialize)]
struct Mean {
    evaluations: f64,
    discrepancy: f64,
    painted_percent: Option<f64>,
}

fn mean(runs: &[RunResult]) -> Mean {
    let over = |value: &dyn Fn(&RunResult) -> f64| runs.iter().map(value).sum::<f64>() / runs.len() as f64;
    let painted: Option<Vec<f64>> = runs.iter().map(|r| r.painted_percent).collect();
    Mean {
        evaluations: over(&|r| r.evaluations as f64),
        discrepancy: over(&|r| r.discrepancy),
        painted_percent: painted.map(|p| p.iter().sum::<f64>() / p.len() as f64),
    }
}

/// One JSON object.
pub(super) fn json(named: &Preset, seed: u64, runs: &[RunResult]) -> anyhow::Result<String> {
    let report = Report {
        preset: &named.name,
        method: named.problem.execution.method.name(),
        seed,
        repetitions: runs.len(),
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
        mean: mean(runs),
    };
    Ok(format!("{}\n", serde_json::to_string(&report)?))
}

/// The goals of the best run, and the means.
pub(super) fn table(named: &Preset, runs: &[RunResult]) -> String {
    let unit = named.problem.goals.features().first().map_or("", |f| f.unit.as_str());
    let mut text = format!("{}: {}\n", named.name, named.description);
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
    let mean = mean(runs);
    let _ = write!(
        text,
        "mean of {} runs: {:.1} evaluations, discrepancy {:.3} {unit}",
        runs.len(),
        mean.evaluations,
        mean.discrepancy
    );
    if let Some(painted) = mean.painted_percent {
        let _ = write!(text, ", painted {painted:.2} %");
    }
    text.push('\n');
    text
}

/// Plans each run's trajectory from the robot's home pose and writes it in three formats.
pub(super) fn write_trajectories(directory: &Path, named: &Preset, runs: &[RunResult]) -> anyhow::Result<()> {
    std::fs::create_dir_all(directory).with_context(|| format!("cannot make {}", directory.display()))?;
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
    eprintln!("{} trajectories written to {}", runs.len() - refused, directory.display());
    Ok(())
}
