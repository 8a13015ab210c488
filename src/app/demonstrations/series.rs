//! Samples for plotting: a window of time, thinned without losing peaks.

use crate::app::model::{AppError, SamplesQuery, Series, limits};
use crate::app::{out_of_bounds, within};
use crate::framework::demonstration::{Demonstration, Stream};

/// One series per requested feature.
///
/// # Errors
/// `Malformed` for invalid bounds and unknown features.
pub(super) fn series(demonstration: &Demonstration, query: &SamplesQuery) -> Result<Vec<Series>, AppError> {
    let max_points = query.max_points.unwrap_or(limits::DEFAULT_POINTS);
    within("max_points", max_points, &limits::SAMPLE_POINTS)?;
    let known: Vec<&str> = demonstration.features().map(|feature| feature.name.as_str()).collect();
    if let Some(unknown) = query.features.iter().find(|name| !known.contains(&name.as_str())) {
        return Err(out_of_bounds("features", format!("{unknown:?}"), &format!("names of {known:?}")));
    }
    let (from_s, to_s) = (query.from_s.unwrap_or(0.0), query.to_s.unwrap_or(f64::MAX));
    if !(from_s.is_finite() && from_s <= to_s) {
        return Err(out_of_bounds("from", from_s, "a time before `to`"));
    }
    let start_s = demonstration.span_s().map_or(0.0, |(start, _)| start);
    let wanted = |name: &str| query.features.is_empty() || query.features.iter().any(|wanted| wanted == name);
    let mut all = Vec::new();
    for stream in &demonstration.streams {
        let first = stream.time_s().partition_point(|t| t - start_s < from_s);
        let last = stream.time_s().partition_point(|t| t - start_s <= to_s);
        for (column, feature) in stream.features().iter().enumerate() {
            if !wanted(&feature.name) {
                continue;
            }
            let kept = thin(stream, column, first..last, max_points as usize);
            all.push(Series {
                stream: stream.name().to_owned(),
                feature: feature.clone(),
                t_s: kept.iter().map(|&sample| stream.time_s()[sample] - start_s).collect(),
                values: kept.iter().map(|&sample| stream.row(sample)[column]).collect(),
                decimated: kept.len() < last - first,
            });
        }
    }
    Ok(all)
}

/// At most `most` samples of `window`, in order of time: the minimum and the maximum of each of `most / 2` bins.
fn thin(stream: &Stream, column: usize, window: std::ops::Range<usize>, most: usize) -> Vec<usize> {
    if window.len() <= most {
        return window.collect();
    }
    let bins = most / 2;
    let mut kept = Vec::with_capacity(most);
    for bin in 0..bins {
        let from = window.start + bin * window.len() / bins;
        let to = window.start + (bin + 1) * window.len() / bins;
        let value = |sample: usize| stream.row(sample)[column];
        let mut extremes = [from, from];
        for sample in from..to {
            if value(sample) < value(extremes[0]) {
                extremes[0] = sample;
            }
            if value(sample) > value(extremes[1]) {
                extremes[1] = sample;
            }
        }
        extremes.sort_unstable();
        kept.push(extremes[0]);
        if extremes[1] != extremes[0] {
            kept.push(extremes[1]);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::framework::Feature;
    use proptest::prelude::*;

    fn demonstration(values: Vec<f64>) -> Demonstration {
        let time_s = (0..values.len()).map(|i| 100.0 + i as f64).collect();
        let stream = Stream::new("s", vec![Feature::new("x", "m")], time_s, values).unwrap();
        Demonstration { name: "d".to_owned(), streams: vec![stream] }
    }

    #[test]
    fn a_window_is_counted_from_the_first_sample() {
        let query = SamplesQuery { from_s: Some(1.0), to_s: Some(2.0), ..SamplesQuery::default() };
        let all = series(&demonstration(vec![5.0, 6.0, 7.0, 8.0]), &query).unwrap();
        assert_eq!((all[0].t_s.as_slice(), all[0].values.as_slice()), (&[1.0, 2.0][..], &[6.0, 7.0][..]));
        assert!(!all[0].decimated);
        let unknown = SamplesQuery { features: vec!["y".to_owned()], ..SamplesQuery::default() };
        assert!(series(&demonstration(vec![0.0, 1.0]), &unknown).is_err());
    }

    proptest! {
        #[test]
        fn thinning_keeps_the_extremes_and_the_bound(
            values in prop::collection::vec(-1e3..1e3_f64, 5..400),
            most in 4_u32..50,
        ) {
            let query = SamplesQuery { max_points: Some(most), ..SamplesQuery::default() };
            let all = series(&demonstration(values.clone()), &query).unwrap();
            let kept = &all[0];
            prop_assert!(kept.values.len() <= (most as usize).max(values.len().min(most as usize)));
            prop_assert!(kept.t_s.is_sorted_by(|a, b| a < b));
            let extreme = |of: &[f64], pick: fn(f64, f64) -> f64| of.iter().copied().reduce(pick);
            prop_assert_eq!(extreme(&kept.values, f64::min), extreme(&values, f64::min));
            prop_assert_eq!(extreme(&kept.values, f64::max), extreme(&values, f64::max));
        }
    }
}
