//! Statistics of one quantity over a set of runs.
//!
//! # Invariants
//! - Sums run in the given order: the same rows give the same bits.
//! - No statistic is invented: the spread of a single value and the quantile of an empty set are absent.

use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, StudentsT};

/// Mean, spread and order statistics of k values, in their unit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Summary {
    /// Number of values k (at least 1).
    pub count: u64,
    /// Arithmetic mean.
    pub mean: f64,
    /// Sample standard deviation (denominator k - 1); absent for a single value.
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub sd: Option<f64>,
    /// 95 % confidence interval of the mean by Student's t; absent for a single value.
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub interval_95: Option<[f64; 2]>,
    /// Middle value: half of the values are smaller.
    pub median: f64,
    /// 90th percentile.
    pub p90: f64,
    /// Smallest value.
    pub minimum: f64,
    /// Largest value.
    pub maximum: f64,
}

impl Summary {
    /// Summary of `values`; `None` if empty.
    #[must_use]
    pub fn of(values: &[f64]) -> Option<Self> {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let (&minimum, &maximum) = (sorted.first()?, sorted.last()?);
        let mean = mean(values)?;
        let sd = standard_deviation(values);
        let half = sd.map(|sd| half_width_95(values.len(), sd));
        Some(Self {
            count: values.len() as u64,
            mean,
            sd,
            interval_95: half.map(|half| [mean - half, mean + half]),
            median: quantile(&sorted, 0.5),
            p90: quantile(&sorted, 0.9),
            minimum,
            maximum,
        })
    }
}

/// Arithmetic mean; `None` if empty.
#[must_use]
pub fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// Sample standard deviation, sqrt(sum (x - mean)^2 / (k - 1)); `None` for fewer than two values.
#[must_use]
pub fn standard_deviation(values: &[f64]) -> Option<f64> {
    let centre = mean(values)?;
    let squares: f64 = values.iter().map(|x| (x - centre).powi(2)).sum();
    (values.len() > 1).then(|| (squares / (values.len() - 1) as f64).sqrt())
}

/// Half the 95 % interval of a mean of `count` values: t(0.975, k - 1) sd / sqrt(k).
pub(super) fn half_width_95(count: usize, sd: f64) -> f64 {
    let freedom = count.saturating_sub(1) as f64;
    match StudentsT::new(0.0, 1.0, freedom) {
        Ok(t) => t.inverse_cdf(0.975) * sd / (count as f64).sqrt(),
        Err(_) => f64::INFINITY,
    }
}

/// The `fraction` quantile (0 to 1) of ascending, non-empty values: linear between order statistics (Hyndman and Fan's
/// type 7, doi:10.1080/00031305.1996.10473566).
fn quantile(sorted: &[f64], fraction: f64) -> f64 {
    let position = fraction * (sorted.len() - 1) as f64;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 <= position < len")]
    let below = position.floor() as usize;
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + (position - position.floor()) * (sorted[above] - sorted[below])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn knows_the_textbook() {
        // t(0.975, 7) = 2.364624; sd of these eight is sqrt(32 / 7).
        let s = Summary::of(&[2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0]).unwrap();
        assert_eq!((s.count, s.mean, s.median, s.minimum, s.maximum), (8, 5.0, 4.5, 2.0, 9.0));
        assert!((s.sd.unwrap() - 2.138_089_935).abs() < 1e-9);
        assert!((s.p90 - 7.6).abs() < 1e-12);
        let [low, high] = s.interval_95.unwrap();
        assert!((high - 5.0 - 1.787_487).abs() < 1e-5, "{high}");
        assert!((5.0 - low - 1.787_487).abs() < 1e-5, "{low}");
    }

    #[test]
    fn one_value_has_no_spread_and_none_no_summary() {
        let s = Summary::of(&[3.0]).unwrap();
        assert_eq!((s.mean, s.median, s.p90, s.sd, s.interval_95), (3.0, 3.0, 3.0, None, None));
        assert_eq!(Summary::of(&[]), None);
    }

    proptest! {
        #[test]
        fn statistics_keep_their_order(values in prop::collection::vec(-1e6..1e6_f64, 2..60)) {
            let s = Summary::of(&values).unwrap();
            prop_assert!(s.minimum <= s.median && s.median <= s.p90 && s.p90 <= s.maximum);
            let [low, high] = s.interval_95.unwrap();
            prop_assert!(low <= s.mean && s.mean <= high);
            let shifted: Vec<f64> = values.iter().map(|v| v + 1000.0).collect();
            let t = Summary::of(&shifted).unwrap();
            prop_assert!((t.mean - s.mean - 1000.0).abs() < 1e-6 && (t.sd.unwrap() - s.sd.unwrap()).abs() < 1e-6);
        }
    }
}
