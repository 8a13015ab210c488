//! Paired comparison of two settings that ran the same seeds.
//!
//! The test is Wilcoxon's signed-rank test: discrepancies cluster at local optima and evaluations are skewed, so the
//! paired t test's normality assumption does not hold; ranks only need symmetry under the null hypothesis.
//!
//! Source: F. Wilcoxon, "Individual comparisons by ranking methods", 1945, doi:10.2307/3001968; ties and zeros as in M.
//! Hollander, D. A. Wolfe, "Nonparametric statistical methods" (zeros dropped, mean ranks).

use super::summary::{half_width_95, mean, standard_deviation};
use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, Normal};

/// Up to this many non-zero differences, the p value is exact (including ties).
const EXACT_UP_TO: usize = 50;

/// Comparison of one quantity over the same seeds; differences are second minus first.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct PairedComparison {
    /// Number of pairs k.
    pub pairs: u64,
    /// Number of pairs without a difference, which the test drops.
    pub ties: u64,
    /// Mean of second - first.
    pub mean_difference: f64,
    /// 95 % interval of the mean difference by Student's t; absent for a single pair.
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub interval_95: Option<[f64; 2]>,
    /// Sum of the ranks of the positive differences.
    pub w_plus: f64,
    /// Two-sided p value of Wilcoxon's signed-rank test; 1 if no pair differs.
    pub p_value: f64,
    /// Matched-pairs rank-biserial correlation, from -1 (first is always larger) to 1 (second is always larger).
    pub rank_biserial: f64,
}

/// Compares `first[i]` with `second[i]`; `None` if there are no pairs.
///
/// # Panics
/// If the slices differ in length.
#[must_use]
pub fn compare(first: &[f64], second: &[f64]) -> Option<PairedComparison> {
    assert_eq!(first.len(), second.len(), "a paired comparison needs pairs");
    let differences: Vec<f64> = first.iter().zip(second).map(|(a, b)| b - a).collect();
    let mean_difference = mean(&differences)?;
    let half = standard_deviation(&differences).map(|sd| half_width_95(differences.len(), sd));
    let mut nonzero: Vec<f64> = differences.iter().copied().filter(|d| *d != 0.0).collect();
    nonzero.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    let doubled = doubled_ranks(&nonzero);
    let total: u64 = doubled.iter().sum();
    let plus: u64 = doubled.iter().zip(&nonzero).filter(|(_, d)| **d > 0.0).map(|(rank, _)| rank).sum();
    let p_value = match nonzero.len() {
        0 => 1.0,
        n if n <= EXACT_UP_TO => exact_p(&doubled, plus.min(total - plus)),
        _ => normal_p(&doubled, plus),
    };
    Some(PairedComparison {
        pairs: differences.len() as u64,
        ties: (differences.len() - nonzero.len()) as u64,
        mean_difference,
        interval_95: half.map(|half| [mean_difference - half, mean_difference + half]),
        w_plus: plus as f64 / 2.0,
        p_value,
        rank_biserial: if total == 0 { 0.0 } else { (2.0 * plus as f64 - total as f64) / total as f64 },
    })
}

/// Twice the mean rank (from 1) of each value, for values ascending by size; integers even with ties.
fn doubled_ranks(ascending: &[f64]) -> Vec<u64> {
    let mut ranks = Vec::with_capacity(ascending.len());
    for group in ascending.chunk_by(|a, b| a.abs().total_cmp(&b.abs()).is_eq()) {
        let before = ranks.len() as u64;
        ranks.extend(group.iter().map(|_| 2 * before + group.len() as u64 + 1));
    }
    ranks
}

/// 2 P(W <= `smaller`), where W is the sum of a random half of the ranks: each sign is + or - with probability 1/2.
fn exact_p(doubled: &[u64], smaller: u64) -> f64 {
    let total = doubled.iter().sum::<u64>();
    #[expect(clippy::cast_possible_truncation, reason = "at most 2 x 50 x 51 / 2")]
    let size = |sum: u64| sum as usize;
    let mut chance = vec![0.0; size(total) + 1];
    chance[0] = 1.0;
    let mut reach = 0;
    for &rank in doubled {
        let rank = size(rank);
        for sum in (0..=reach).rev() {
            let half = chance[sum] / 2.0;
            chance[sum] = half;
            chance[sum + rank] += half;
        }
        reach += rank;
    }
    (2.0 * chance[..=size(smaller)].iter().sum::<f64>()).min(1.0)
}

/// Normal approximation with the correction for ties and for continuity.
fn normal_p(doubled: &[u64], plus: u64) -> f64 {
    let total = doubled.iter().sum::<u64>() as f64 / 2.0;
    // Variance of a sum of independent signs on (mean) ranks, which already accounts for ties.
    let variance: f64 = doubled.iter().map(|&rank| (rank as f64 / 2.0).powi(2)).sum::<f64>() / 4.0;
    let distance = ((plus as f64 / 2.0 - total / 2.0).abs() - 0.5).max(0.0);
    (2.0 * Normal::standard().sf(distance / variance.sqrt())).min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Hollander and Wolfe's depression scale (example 3.1): T+ = 5, two-sided p = 0.0390625.
    #[expect(clippy::approx_constant, reason = "3.14 is a patient's score")]
    #[test]
    fn knows_the_textbook() {
        let before = [1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30];
        let after = [0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29];
        let found = compare(&before, &after).unwrap();
        assert_eq!((found.pairs, found.ties, found.w_plus), (9, 0, 5.0));
        assert!((found.p_value - 0.039_062_5).abs() < 1e-12, "{}", found.p_value);
        assert!((found.rank_biserial + 35.0 / 45.0).abs() < 1e-12);
        assert!((found.mean_difference + 0.431_888_9).abs() < 1e-6);
    }

    #[test]
    fn equal_runs_do_not_differ() {
        let same = [1.0, 2.0, 3.0];
        let found = compare(&same, &same).unwrap();
        assert_eq!((found.p_value, found.ties, found.rank_biserial), (1.0, 3, 0.0));
        assert_eq!(compare(&[], &[]), None);
    }

    #[test]
    fn all_of_one_sign_is_the_least_p_there_is() {
        let first = [0.0; 10];
        let second: Vec<f64> = (1..=10).map(f64::from).collect();
        let found = compare(&first, &second).unwrap();
        assert!((found.p_value - 2.0 / 1024.0).abs() < 1e-15);
        assert_eq!(found.rank_biserial, 1.0);
    }

    #[test]
    fn the_normal_approximation_meets_the_exact_distribution() {
        let differences: Vec<f64> = (1..=50_i32).map(|k| f64::from(if k % 3 == 0 { -k } else { k })).collect();
        let doubled = doubled_ranks(&differences);
        let plus: u64 = doubled.iter().zip(&differences).filter(|(_, d)| **d > 0.0).map(|(r, _)| r).sum();
        let total: u64 = doubled.iter().sum();
        let (exact, normal) = (exact_p(&doubled, plus.min(total - plus)), normal_p(&doubled, plus));
        assert!((exact - normal).abs() < 0.05 * exact, "{exact} {normal}");
    }

    proptest! {
        #[test]
        fn swapping_the_two_changes_only_the_sign(
            pairs in prop::collection::vec((0..20_i32, 0..20_i32), 1..120)
        ) {
            let first: Vec<f64> = pairs.iter().map(|p| f64::from(p.0)).collect();
            let second: Vec<f64> = pairs.iter().map(|p| f64::from(p.1)).collect();
            let (a, b) = (compare(&first, &second).unwrap(), compare(&second, &first).unwrap());
            prop_assert!((a.p_value - b.p_value).abs() < 1e-12 && a.p_value > 0.0 && a.p_value <= 1.0);
            prop_assert!((a.mean_difference + b.mean_difference).abs() < 1e-12);
            prop_assert!((a.rank_biserial + b.rank_biserial).abs() < 1e-12);
        }
    }
}
