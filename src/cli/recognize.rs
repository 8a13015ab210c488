//! `cgda recognize`: which of several actions a demonstration shows, or none.

use super::demonstrations::{ReadArguments, read_demonstrations};
use super::values::Metric;
use crate::framework::generalization::{Generalized, Goals, goals_from_csv};
use crate::framework::recognition::{Recognition, RecognizeSpec, observed_rows, recognize};
use anyhow::{Context as _, bail};
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// Rank actions by how well they match an observed demonstration.
#[derive(Debug, clap::Args)]
#[command(allow_negative_numbers = true)]
pub struct RecognizeArguments {
    /// The observation: a file with a single stream, or a directory with a stream per file.
    observed: PathBuf,
    /// Actions: goals as printed by `cgda generalize` with --csv or --json.
    #[arg(required = true)]
    actions: Vec<PathBuf>,
    /// Metric of the discrepancy.
    #[arg(long, value_enum, default_value_t = Metric::Multivariate)]
    metric: Metric,
    /// Largest relative discrepancy (mean distance of matched rows divided by the action's size) of a recognized
    /// action; above it the answer is unknown. 0.3 if absent.
    #[arg(long, value_name = "SHARE")]
    threshold: Option<f64>,
    /// Print JSON: ranking, split by feature, warping paths.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    read: ReadArguments,
}

/// Prints the ranking.
///
/// # Errors
/// Rejected files, actions that are not goals, no comparable action, or a closed stdout.
pub fn run(arguments: &RecognizeArguments) -> anyhow::Result<()> {
    let demonstrations = read_demonstrations(std::slice::from_ref(&arguments.observed), &arguments.read)?;
    let observed = observed_rows(&demonstrations[0])?;
    let actions = arguments.actions.iter().map(|path| action(path)).collect::<anyhow::Result<Vec<_>>>()?;
    let spec = RecognizeSpec { metric: arguments.metric.into(), threshold: arguments.threshold };
    let recognition = recognize(&observed, &actions, &spec)?;
    for other in &recognition.incomparable {
        let found =
            other.observed_unit.as_ref().map_or("not observed".to_owned(), |unit| format!("observed in {unit:?}"));
        eprintln!("{}: cannot be compared, {} is {found}", other.name, other.feature.header());
    }
    if recognition.matches.is_empty() {
        bail!("none of the {} actions has the observed features", actions.len());
    }
    let text =
        if arguments.json { format!("{}\n", serde_json::to_string_pretty(&recognition)?) } else { table(&recognition) };
    std::io::stdout().lock().write_all(text.as_bytes())?;
    Ok(())
}

/// Reads goals from a CSV or JSON file; the action is named after the file.
fn action(path: &Path) -> anyhow::Result<(String, Goals)> {
    let text = std::fs::read_to_string(path).with_context(|| format!("cannot read {}", path.display()))?;
    let goals = if text.trim_start().starts_with('{') {
        serde_json::from_str::<Generalized>(&text)
            .map(|generalized| generalized.goals)
            .or_else(|_| serde_json::from_str::<Goals>(&text))
            .with_context(|| format!("{} does not contain goals {{features, goals}}", path.display()))?
    } else {
        goals_from_csv(&text).with_context(|| format!("{} does not contain a table of goals", path.display()))?
    };
    Ok((path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned()), goals))
}

/// The ranking as a table for people.
fn table(recognition: &Recognition) -> String {
    let mut text = match &recognition.recognized {
        Some(name) => format!("recognised: {name}\n"),
        None => "recognised: unknown, no action is within the threshold\n".to_owned(),
    };
    let _ = writeln!(text, "threshold {} (relative discrepancy)", recognition.threshold);
    let _ = writeln!(text, "{:>4}  {:<24}  {:>9}  {:>14}  by feature", "rank", "action", "relative", "discrepancy");
    for (index, found) in recognition.matches.iter().enumerate() {
        let split: Vec<String> =
            found.features.iter().map(|part| format!("{} {:.4}", part.feature.name, part.discrepancy)).collect();
        let _ = writeln!(
            text,
            "{:>4}  {:<24}  {:>9.4}  {:>14.4}  {}",
            index + 1,
            found.name,
            found.relative_discrepancy,
            found.discrepancy,
            split.join(", ")
        );
    }
    text
}
