//! The discrepancy under each metric, as one number or split by feature with its warping path.

use super::Metric;
use super::dtw::{self, Border};
use crate::Feature;
use crate::distance::distance;
use serde::{Deserialize, Serialize};

/// Discrepancy D between an observation of I rows and J goals over the same m features, in the features' unit.
///
/// `observed` and `goals` are row-major with `features` columns; O(J) memory.
///
/// # Panics
/// If either is empty or not a whole number of rows.
#[must_use]
pub fn discrepancy(metric: Metric, observed: &[f64], goals: &[f64], features: usize) -> f64 {
    match metric {
        Metric::Multivariate | Metric::Aquila => dtw::distance(observed, goals, features, metric.border()),
        Metric::SumOfFeatures => {
            let rows = (observed.len() + goals.len()) / features;
            (0..features)
                .map(|k| {
                    let (o, x) = (column(observed, features, k), column(goals, features, k));
                    dtw::distance(&o, &x, 1, Border::Accumulated) / rows as f64
                })
                .sum()
        }
    }
}

/// One feature's share of a discrepancy.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct FeatureDiscrepancy {
    /// Name and unit.
    pub feature: Feature,
    /// Contribution in the feature's unit; the contributions of all features add up to the discrepancy.
    pub discrepancy: f64,
    /// Warping path of this feature for `sum_of_features`; empty for metrics with one joint path.
    pub path: Vec<[u32; 2]>,
}

/// A discrepancy with its split and paths.
pub(super) struct Detailed {
    pub discrepancy: f64,
    /// Mean distance of matched rows and goals under standard borders, see [`mean_distance`]; summed over features for
    /// `sum_of_features`.
    pub mean_distance: f64,
    /// Joint path; empty for `sum_of_features`.
    pub path: Vec<[u32; 2]>,
    pub features: Vec<FeatureDiscrepancy>,
}

/// Like [`discrepancy`], with the split and the path; O(I x J) memory.
///
/// Joint metrics are split along their path: a matched pair at distance d, to which feature k contributes delta_k, adds
/// `delta_k^2 / d` to feature k. For `aquila` only the pairs that make up the value count, those after the last border
/// cell.
pub(super) fn detailed(metric: Metric, observed: &[f64], goals: &[f64], features: &[Feature]) -> Detailed {
    let m = features.len();
    if metric == Metric::SumOfFeatures {
        return sum_of_features(observed, goals, features);
    }
    let alignment = dtw::align(observed, goals, m, metric.border());
    let counted_from = match metric.border() {
        Border::Accumulated => 0,
        Border::Local => alignment.path.iter().rposition(|&(i, j)| i == 0 || j == 0).unwrap_or(0),
    };
    let mut parts = vec![0.0; m];
    for &pair in &alignment.path[counted_from..] {
        let apart = pair_distance(observed, goals, m, pair);
        if apart > 0.0 {
            for (part, (o, x)) in parts.iter_mut().zip(row(observed, m, pair.0).iter().zip(row(goals, m, pair.1))) {
                *part += (o - x) * (o - x) / apart;
            }
        }
    }
    let split = features.iter().zip(parts).map(|(feature, discrepancy)| FeatureDiscrepancy {
        feature: feature.clone(),
        discrepancy,
        path: Vec::new(),
    });
    Detailed {
        discrepancy: alignment.distance,
        mean_distance: match metric.border() {
            Border::Accumulated => mean_distance(observed, goals, m, &alignment.path),
            Border::Local => {
                mean_distance(observed, goals, m, &dtw::align(observed, goals, m, Border::Accumulated).path)
            }
        },
        features: split.collect(),
        path: pairs(&alignment.path),
    }
}

fn sum_of_features(observed: &[f64], goals: &[f64], features: &[Feature]) -> Detailed {
    let m = features.len();
    let rows = (observed.len() + goals.len()) / m;
    let mut mean = 0.0;
    let split: Vec<FeatureDiscrepancy> = features
        .iter()
        .enumerate()
        .map(|(k, feature)| {
            let (o, x) = (column(observed, m, k), column(goals, m, k));
            let alignment = dtw::align(&o, &x, 1, Border::Accumulated);
            mean += mean_distance(&o, &x, 1, &alignment.path);
            FeatureDiscrepancy {
                feature: feature.clone(),
                discrepancy: alignment.distance / rows as f64,
                path: pairs(&alignment.path),
            }
        })
        .collect();
    Detailed {
        discrepancy: split.iter().map(|part| part.discrepancy).sum(),
        mean_distance: mean,
        path: Vec::new(),
        features: split,
    }
}

/// The larger of two mean distances along a path: one weights every observed row equally, the other every goal. The
/// plain mean over the path would let a long observation hide that most goals were never shown.
fn mean_distance(observed: &[f64], goals: &[f64], m: usize, path: &[(usize, usize)]) -> f64 {
    let mean_over = |index: fn(&(usize, usize)) -> usize| {
        let groups: Vec<f64> = path
            .chunk_by(|a, b| index(a) == index(b))
            .map(|pairs| {
                pairs.iter().map(|&pair| pair_distance(observed, goals, m, pair)).sum::<f64>() / pairs.len() as f64
            })
            .collect();
        groups.iter().sum::<f64>() / groups.len() as f64
    };
    mean_over(|pair| pair.0).max(mean_over(|pair| pair.1))
}

fn pair_distance(observed: &[f64], goals: &[f64], m: usize, (i, j): (usize, usize)) -> f64 {
    distance(row(observed, m, i), row(goals, m, j))
}

fn row(values: &[f64], m: usize, i: usize) -> &[f64] {
    &values[i * m..(i + 1) * m]
}

fn column(values: &[f64], features: usize, k: usize) -> Vec<f64> {
    values.iter().skip(k).step_by(features).copied().collect()
}

fn pairs(path: &[(usize, usize)]) -> Vec<[u32; 2]> {
    let narrow = |index: usize| u32::try_from(index).unwrap_or(u32::MAX);
    path.iter().map(|&(i, j)| [narrow(i), narrow(j)]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn features(m: usize) -> Vec<Feature> {
        (0..m).map(|k| Feature::new(format!("f{k}"), "")).collect()
    }

    #[test]
    fn known_values_of_all_metrics() {
        // one feature: accumulated 4, local borders 3 (see dtw), 4 / (3 + 4) normalised
        let (observed, goals) = ([0.0, 2.0, 3.0], [1.0, 1.0, 2.0, 5.0]);
        for (metric, expected) in
            [(Metric::Multivariate, 4.0), (Metric::Aquila, 3.0), (Metric::SumOfFeatures, 4.0 / 7.0)]
        {
            let found = discrepancy(metric, &observed, &goals, 1);
            assert!((found - expected).abs() < 1e-12, "{metric:?}: {found} against {expected}");
        }
    }

    #[test]
    fn a_three_four_five_pair_splits_by_its_squares() {
        let found = detailed(Metric::Multivariate, &[0.0, 0.0], &[3.0, 4.0], &features(2));
        assert!((found.discrepancy - 5.0).abs() < 1e-12);
        assert!((found.features[0].discrepancy - 9.0 / 5.0).abs() < 1e-12);
        assert!((found.features[1].discrepancy - 16.0 / 5.0).abs() < 1e-12);
    }

    proptest! {
        #[test]
        fn parts_add_up_and_agree_with_the_short_form(
            observed in proptest::collection::vec(-9.0..9.0_f64, 1..8),
            goals in proptest::collection::vec(-9.0..9.0_f64, 1..8),
            m in 1..3_usize,
        ) {
            let observed: Vec<f64> = observed.iter().flat_map(|v| (0..m).map(move |k| v * (1.0 + k as f64))).collect();
            let goals: Vec<f64> = goals.iter().flat_map(|v| (0..m).map(move |k| v - k as f64)).collect();
            for metric in [Metric::SumOfFeatures, Metric::Multivariate, Metric::Aquila] {
                let whole = detailed(metric, &observed, &goals, &features(m));
                let short = discrepancy(metric, &observed, &goals, m);
                prop_assert_eq!(whole.discrepancy.to_bits(), short.to_bits());
                let sum: f64 = whole.features.iter().map(|part| part.discrepancy).sum();
                prop_assert!((sum - short).abs() < 1e-9, "{metric:?}: {sum} against {short}");
            }
        }
    }
}
