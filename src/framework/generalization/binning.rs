//! Time normalisation and binning (paper eq. 1-2).
//!
//! Symbols: N demonstrations of durations d_k; T_min; n = floor(mean(d) / T_min) goals. A sample at time t of
//! demonstration k has the normalised time x = (t - start_k) / d_k in [0, 1] and lies in bin floor(x n). x = 1 lies in
//! the last bin (`per_demonstration`) or in none (`per_sample`, as in the authors' script). Start and duration are
//! those of the demonstration, not of the single stream.

use super::{GeneralizeError, GeneralizeSpec, Generalized, Goals, Weighting};
use crate::Feature;
use crate::demonstration::{Demonstration, Stream};
use crate::range::above;

/// Largest number of goals.
const MAX_GOALS: usize = 10_000;

/// Generalizes demonstrations into the goals of an action.
///
/// # Errors
/// [`GeneralizeError`] names the demonstration, stream or feature that does not fit.
pub fn generalize(demonstrations: &[Demonstration], spec: &GeneralizeSpec) -> Result<Generalized, GeneralizeError> {
    let first = demonstrations.first().ok_or(GeneralizeError::NoDemonstration)?;
    above(0.0).check("t_min_s", Some("s"), spec.t_min_s)?;
    let features = selection(first, spec)?;
    let columns = demonstrations
        .iter()
        .map(|demonstration| columns(demonstration, first, &features, spec.features.is_none()))
        .collect::<Result<Vec<_>, _>>()?;
    let durations_s: Vec<f64> = demonstrations.iter().map(Demonstration::duration_s).collect();
    let mean_duration_s = mean(&durations_s);
    let n = number_of_goals(&durations_s, spec)?;

    let mut rows = vec![vec![0.0; features.len()]; n];
    let mut spread = rows.clone();
    let mut interpolated_bins = 0;
    for feature in 0..features.len() {
        let bins: Vec<Bins> = columns.iter().map(|columns| Bins::fill(&columns[feature], n, spec.weighting)).collect();
        for goal in 0..n {
            let mut means = Vec::with_capacity(bins.len());
            for (bins, columns) in bins.iter().zip(&columns) {
                means.push(bins.mean_or_interpolated(goal, &columns[feature], &mut interpolated_bins)?);
            }
            let samples: u64 = bins.iter().map(|b| b.counts[goal]).sum();
            rows[goal][feature] = match spec.weighting {
                Weighting::PerSample if samples > 0 => bins.iter().map(|b| b.sums[goal]).sum::<f64>() / samples as f64,
                Weighting::PerSample | Weighting::PerDemonstration => mean(&means),
            };
            spread[goal][feature] = standard_deviation(&means);
        }
    }
    Ok(Generalized {
        goals: Goals::new(features, &rows)?.spaced(Some(mean_duration_s / n as f64)),
        spread,
        durations_s,
        mean_duration_s,
        t_min_s: spec.t_min_s,
        weighting: spec.weighting,
        interpolated_bins,
    })
}

fn number_of_goals(durations_s: &[f64], spec: &GeneralizeSpec) -> Result<usize, GeneralizeError> {
    let t_min_s = spec.t_min_s;
    let mean_duration_s = mean(durations_s);
    let goals = match spec.weighting {
        Weighting::PerDemonstration => (mean_duration_s / t_min_s).floor(),
        Weighting::PerSample => {
            let whole_seconds: Vec<f64> = durations_s.iter().map(|d| d.ceil()).collect();
            (mean(&whole_seconds).floor() / t_min_s).floor()
        }
    };
    if goals < 1.0 {
        return Err(GeneralizeError::NoGoal { t_min_s, mean_duration_s });
    }
    if goals > MAX_GOALS as f64 {
        return Err(GeneralizeError::TooManyGoals { t_min_s, goals, limit: MAX_GOALS });
    }
    Ok(index(goals))
}

/// The features to generalize: the selected ones, or else all of the first demonstration.
fn selection(first: &Demonstration, spec: &GeneralizeSpec) -> Result<Vec<Feature>, GeneralizeError> {
    let Some(names) = &spec.features else { return Ok(first.features().cloned().collect()) };
    let repeated = names.iter().enumerate().any(|(i, name)| names[..i].contains(name));
    if names.is_empty() || repeated {
        return Err(GeneralizeError::Selection { features: names.clone() });
    }
    names.iter().map(|name| find(first, name).map(|(stream, column)| stream.features()[column].clone())).collect()
}

fn find<'a>(demonstration: &'a Demonstration, name: &str) -> Result<(&'a Stream, usize), GeneralizeError> {
    let column_of = |stream: &'a Stream| stream.features().iter().position(|f| f.name == name).map(|c| (stream, c));
    demonstration.streams.iter().find_map(column_of).ok_or_else(|| GeneralizeError::MissingFeature {
        demonstration: demonstration.name.clone(),
        feature: name.to_owned(),
        available: demonstration.features().map(|f| f.name.clone()).collect(),
    })
}

/// One feature of one demonstration: its values over normalised time.
struct Column<'a> {
    demonstration: &'a Demonstration,
    stream: &'a Stream,
    index: usize,
    start_s: f64,
    duration_s: f64,
}

impl Column<'_> {
    fn value(&self, sample: usize) -> f64 {
        self.stream.row(sample)[self.index]
    }

    /// Interpolates linearly in time; `None` outside the stream.
    fn at(&self, time_s: f64) -> Option<f64> {
        let times = self.stream.time_s();
        let after = times.partition_point(|t| *t < time_s);
        if after == times.len() || (after == 0 && time_s < times[0]) {
            return None;
        }
        if after == 0 {
            return Some(self.value(0));
        }
        let share = (time_s - times[after - 1]) / (times[after] - times[after - 1]);
        Some(self.value(after - 1) + share * (self.value(after) - self.value(after - 1)))
    }
}

/// The columns of `features` in a demonstration; if `all`, the demonstration must not have any others.
fn columns<'a>(
    demonstration: &'a Demonstration,
    first: &Demonstration,
    features: &[Feature],
    all: bool,
) -> Result<Vec<Column<'a>>, GeneralizeError> {
    let (start_s, end_s) = demonstration.span_s().ok_or(GeneralizeError::NoDemonstration)?;
    let extra = demonstration.features().find(|f| all && !features.iter().any(|known| known.name == f.name));
    if let Some(extra) = extra {
        return Err(GeneralizeError::ExtraFeature {
            demonstration: demonstration.name.clone(),
            feature: extra.name.clone(),
            first: first.name.clone(),
        });
    }
    let column = |feature: &Feature| {
        let (stream, index) = find(demonstration, &feature.name)?;
        let unit = &stream.features()[index].unit;
        if *unit != feature.unit {
            return Err(GeneralizeError::UnitMismatch {
                demonstration: demonstration.name.clone(),
                feature: feature.name.clone(),
                unit: unit.clone(),
                expected: feature.unit.clone(),
            });
        }
        Ok(Column { demonstration, stream, index, start_s, duration_s: end_s - start_s })
    };
    features.iter().map(column).collect()
}

/// Sums and counts per bin for one column.
struct Bins {
    sums: Vec<f64>,
    counts: Vec<u64>,
}

impl Bins {
    fn fill(column: &Column<'_>, n: usize, weighting: Weighting) -> Self {
        let mut bins = Self { sums: vec![0.0; n], counts: vec![0; n] };
        for (sample, time_s) in column.stream.time_s().iter().enumerate() {
            let normalised = (time_s - column.start_s) / column.duration_s;
            let bin = match weighting {
                Weighting::PerSample if normalised >= 1.0 => continue,
                Weighting::PerSample | Weighting::PerDemonstration => index(normalised * n as f64).min(n - 1),
            };
            bins.sums[bin] += column.value(sample);
            bins.counts[bin] += 1;
        }
        bins
    }

    fn mean_or_interpolated(
        &self,
        goal: usize,
        column: &Column<'_>,
        interpolated_bins: &mut u64,
    ) -> Result<f64, GeneralizeError> {
        if self.counts[goal] > 0 {
            return Ok(self.sums[goal] / self.counts[goal] as f64);
        }
        let middle = (goal as f64 + 0.5) / self.counts.len() as f64;
        let time_s = column.start_s + middle * column.duration_s;
        *interpolated_bins += 1;
        column.at(time_s).ok_or_else(|| GeneralizeError::Uncovered {
            demonstration: column.demonstration.name.clone(),
            stream: column.stream.name().to_owned(),
            goal,
            time_s,
            from_s: column.stream.time_s()[0],
            to_s: column.stream.time_s()[column.stream.len() - 1],
        })
    }
}

/// Floor of a number known to lie in 0..=usize::MAX.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "callers bound it; `as` saturates")]
fn index(value: f64) -> usize {
    value as usize
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Sample standard deviation (N - 1); 0 for fewer than two values.
fn standard_deviation(values: &[f64]) -> f64 {
    if values.len() < 2 {
        return 0.0;
    }
    let centre = mean(values);
    let squares: f64 = values.iter().map(|v| (v - centre) * (v - centre)).sum();
    (squares / (values.len() - 1) as f64).sqrt()
}

#[cfg(test)]
#[path = "binning_tests.rs"]
mod tests;
