//! `cgda run --dry-run`: the estimated cost, from the same preview and in the same words as the service's.

use super::seeded::Seeded;
use crate::framework::execution::{Chosen, Preview, in_words};
use serde::Serialize;
use std::time::{Duration, Instant};

/// Maximum time spent on simulating the first repetition.
const PATIENCE: Duration = Duration::from_secs(2);

/// JSON object on stdout; its shape is stable.
#[derive(Serialize)]
struct Report<'a> {
    preset: &'a str,
    method: &'static str,
    chosen: Option<&'a Chosen>,
    evaluations: f64,
    robot_s: f64,
    text: String,
    basis: String,
}

/// Estimated cost of `repetitions` runs, as text or as one JSON object.
pub(super) fn report(
    seeded: &Seeded,
    seed: u64,
    repetitions: u32,
    robot_trial_s: f64,
    json: bool,
) -> anyhow::Result<String> {
    let named = &seeded.named;
    let problem = seeded.problem(seed)?;
    let mut started = None;
    let go_on = || started.get_or_insert_with(Instant::now).elapsed() < PATIENCE;
    let preview = Preview::new(&problem, seed, go_on)?;
    let evaluations = preview.whole() * f64::from(repetitions);
    let execution = &named.problem.execution;
    let report = Report {
        preset: &named.name,
        method: execution.method.name(),
        chosen: execution.chosen.as_ref(),
        evaluations,
        robot_s: evaluations * robot_trial_s,
        text: in_words(evaluations, robot_trial_s),
        basis: preview.basis(),
    };
    if json {
        return Ok(format!("{}\n", serde_json::to_string(&report)?));
    }
    let Report { text, basis, .. } = report;
    Ok(format!("{}: {}\n{}{text} ({basis})\n", named.name, named.description, super::output::method(named)))
}
