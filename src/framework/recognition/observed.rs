//! A demonstration as one matrix of observations, for comparison with goals.

use crate::Feature;
use crate::demonstration::{Demonstration, Stream};
use crate::generalization::{Goals, GoalsError};

/// Reasons why a demonstration does not form a matrix of observations.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ObservedError {
    /// The demonstration has no streams.
    #[error("demonstration {demonstration:?} has no streams")]
    Empty {
        /// Name of the demonstration.
        demonstration: String,
    },
    /// The streams have no time in common.
    #[error(
        "the streams of demonstration {demonstration:?} have no sample time in common (last start {start_s} s, first \
         end {end_s} s): align them by start"
    )]
    NoOverlap {
        /// Name of the demonstration.
        demonstration: String,
        /// Latest start among the streams, seconds.
        start_s: f64,
        /// Earliest end among the streams, seconds.
        end_s: f64,
    },
    /// Interpolation overflowed.
    #[error("the observations are not finite")]
    Values(#[from] GoalsError),
}

/// Combines the samples of all streams into rows over all features.
///
/// A single stream gives its own rows. With several, rows are taken at the sample times of the first stream within the
/// time that all of them cover; the others are interpolated linearly.
///
/// # Errors
/// [`ObservedError`] if the streams have no time in common.
pub fn observed_rows(demonstration: &Demonstration) -> Result<Goals, ObservedError> {
    let empty = || ObservedError::Empty { demonstration: demonstration.name.clone() };
    let (first, others) = demonstration.streams.split_first().ok_or_else(empty)?;
    let features: Vec<Feature> = demonstration.features().cloned().collect();
    let last = |stream: &Stream| stream.time_s()[stream.len() - 1];
    let start_s = demonstration.streams.iter().map(|s| s.time_s()[0]).fold(f64::NEG_INFINITY, f64::max);
    let end_s = demonstration.streams.iter().map(last).fold(f64::INFINITY, f64::min);
    let mut rows = Vec::new();
    for (sample, &time_s) in first.time_s().iter().enumerate() {
        if (start_s..=end_s).contains(&time_s) {
            let mut row = first.row(sample).to_vec();
            for stream in others {
                push_at(stream, time_s, &mut row);
            }
            rows.push(row);
        }
    }
    if rows.is_empty() {
        return Err(ObservedError::NoOverlap { demonstration: demonstration.name.clone(), start_s, end_s });
    }
    Ok(Goals::new(features, &rows)?)
}

/// Appends the stream's values at `time_s`, which the stream must cover.
fn push_at(stream: &Stream, time_s: f64, row: &mut Vec<f64>) {
    let times = stream.time_s();
    let after = times.partition_point(|t| *t < time_s).clamp(1, times.len() - 1);
    let share = (time_s - times[after - 1]) / (times[after] - times[after - 1]);
    let pairs = stream.row(after - 1).iter().zip(stream.row(after));
    row.extend(pairs.map(|(before, behind)| before + share * (behind - before)));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stream(name: &str, time_s: &[f64], values: &[f64]) -> Stream {
        Stream::new(name, vec![Feature::new(name, "")], time_s.to_vec(), values.to_vec()).unwrap()
    }

    #[test]
    fn other_streams_are_read_at_the_first_ones_times() {
        let streams =
            vec![stream("a", &[0.0, 1.0, 2.0, 3.0], &[0.0, 1.0, 2.0, 3.0]), stream("b", &[0.5, 2.5], &[10.0, 30.0])];
        let rows = observed_rows(&Demonstration { name: "d".to_owned(), streams }).unwrap();
        assert_eq!(rows.values(), [1.0, 15.0, 2.0, 25.0]);
    }

    #[test]
    fn clocks_apart_are_told() {
        let streams = vec![stream("a", &[0.0, 1.0], &[0.0, 1.0]), stream("b", &[600.0, 601.0], &[0.0, 1.0])];
        let error = observed_rows(&Demonstration { name: "d".to_owned(), streams }).unwrap_err();
        assert!(error.to_string().contains("last start 600 s, first end 1 s"), "{error}");
    }
}
