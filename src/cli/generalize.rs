//! `cgda generalize`: demonstrations in, goals out.

use super::demonstrations::{ReadArguments, read_demonstrations};
use super::values::Weighting;
use crate::framework::generalization::{GeneralizeSpec, Generalized, generalize, goals_to_csv};
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::PathBuf;

/// Generalize demonstrations into the goals of an action.
#[derive(Debug, clap::Args)]
#[command(allow_negative_numbers = true)]
pub struct GeneralizeArguments {
    /// Demonstrations: a file is one with a single stream, a directory one with a stream per file.
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// T_min, the duration of one goal in seconds; n = mean duration / T_min.
    #[arg(long, value_name = "SECONDS")]
    t_min: f64,
    /// Whether every demonstration or every sample has the same weight.
    #[arg(long, value_enum, default_value_t = Weighting::PerDemonstration)]
    weighting: Weighting,
    /// Feature to keep; may be repeated; all if absent.
    #[arg(long = "feature", value_name = "NAME")]
    features: Vec<String>,
    /// Print CSV: a header, then one row per goal with one column per feature.
    #[arg(long, conflicts_with = "json")]
    csv: bool,
    /// Print JSON: goals, spread, durations.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    read: ReadArguments,
}

/// Prints the goals of the demonstrations.
///
/// # Errors
/// Rejected files, demonstrations that do not fit together, or a closed stdout.
pub fn run(arguments: &GeneralizeArguments) -> anyhow::Result<()> {
    let demonstrations = read_demonstrations(&arguments.files, &arguments.read)?;
    let features = (!arguments.features.is_empty()).then(|| arguments.features.clone());
    let spec = GeneralizeSpec { t_min_s: arguments.t_min, weighting: arguments.weighting.into(), features };
    let generalized = generalize(&demonstrations, &spec)?;
    if generalized.interpolated_bins > 0 {
        eprintln!("{} bins without samples were interpolated in time", generalized.interpolated_bins);
    }
    let text = if arguments.csv {
        goals_to_csv(&generalized.goals)
    } else if arguments.json {
        format!("{}\n", serde_json::to_string_pretty(&generalized)?)
    } else {
        table(&generalized)
    };
    std::io::stdout().lock().write_all(text.as_bytes())?;
    Ok(())
}

/// Goals with their spread, as a table for people.
fn table(generalized: &Generalized) -> String {
    let goals = &generalized.goals;
    let mut text = format!(
        "{} goals from {} demonstrations, mean duration {:.2} s (value +- standard deviation over demonstrations)\n",
        goals.len(),
        generalized.durations_s.len(),
        generalized.mean_duration_s
    );
    let _ = write!(text, "{:>5}", "goal");
    for feature in goals.features() {
        let _ = write!(text, "  {:>24}", feature.header());
    }
    for (index, (row, spread)) in goals.rows().zip(&generalized.spread).enumerate() {
        let _ = write!(text, "\n{:>5}", index + 1);
        for (value, deviation) in row.iter().zip(spread) {
            let _ = write!(text, "  {:>24}", format!("{value:.4} +- {deviation:.4}"));
        }
    }
    text.push('\n');
    text
}
