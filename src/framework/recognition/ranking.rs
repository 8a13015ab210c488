//! Ranking of an observation against candidate actions with an open set: "none of them" is a possible answer.
//!
//! The open set needs a dimensionless number. The *relative discrepancy* is d / R. d is the mean distance of the rows
//! and goals matched by the warping path: the larger of the mean over rows and the mean over goals, so that a long
//! observation cannot hide goals that were never shown. R is the size of the action, the diagonal of the box around its
//! goals. For `sum_of_features` both are summed over the features' own paths and sides; R is 1 if all goals are equal.
//! A value of 0.1 means that matched rows are on average a tenth of the action's own size apart. Standard borders
//! determine the path for `aquila` too, because that metric charges nothing along its borders and may match most rows
//! of a long recording to one goal.
//!
//! Candidates with the same features are ranked by discrepancy. If features differ, all are ranked by relative
//! discrepancy, because discrepancies over different features and units are not comparable.

use super::discrepancy::detailed;
use super::{FeatureDiscrepancy, Metric};
use crate::Feature;
use crate::generalization::Goals;
use serde::{Deserialize, Serialize};

/// Default threshold: relative discrepancy above which the best candidate is not recognized.
pub const DEFAULT_THRESHOLD: f64 = 0.3;
/// Largest matrix of observed rows x goals, in cells of 8 bytes.
const MAX_CELLS: usize = 16 << 20;

/// Options for recognition.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RecognizeSpec {
    /// Metric of the discrepancy.
    pub metric: Metric,
    /// Largest relative discrepancy (dimensionless) of a recognized action; 0.3 if absent.
    pub threshold: Option<f64>,
}

/// Result of a recognition, with every candidate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Recognition {
    /// Name of the best candidate; absent (*unknown*) if none is within the threshold.
    pub recognized: Option<String>,
    /// Metric in use.
    pub metric: Metric,
    /// Threshold in use, relative discrepancy.
    pub threshold: f64,
    /// All comparable candidates, best first; ties are ordered by name.
    pub matches: Vec<Match>,
    /// Candidates that could not be compared, with the reason.
    pub incomparable: Vec<Incomparable>,
}

/// Discrepancy of one candidate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Match {
    /// Name of the action.
    pub name: String,
    /// D, features' unit.
    pub discrepancy: f64,
    /// Mean distance of matched rows and goals divided by the action's size, dimensionless.
    pub relative_discrepancy: f64,
    /// Whether the relative discrepancy is within the threshold.
    pub within_threshold: bool,
    /// Discrepancy split by feature, in the action's order.
    pub features: Vec<FeatureDiscrepancy>,
    /// Warping path: pairs (observed row, goal) from 0; empty for `sum_of_features`, whose features have their own
    /// paths.
    pub path: Vec<[u32; 2]>,
}

/// A candidate whose features were not observed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Incomparable {
    /// Name of the action.
    pub name: String,
    /// Feature that is missing or has another unit.
    pub feature: Feature,
    /// Unit in the observation; absent if the feature was not observed.
    pub observed_unit: Option<String>,
}

/// Reasons why nothing could be compared.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RecognizeError {
    /// The threshold is negative or not a number.
    #[error("threshold is {threshold}: give at least 0")]
    Threshold {
        /// Requested threshold.
        threshold: f64,
    },
    /// The observation is too long for the full matrix.
    #[error("{rows} observed rows x {goals} goals exceed {limit} cells: record at a lower rate")]
    TooLarge {
        /// Number of observed rows.
        rows: usize,
        /// Goals of the candidate.
        goals: usize,
        /// Largest allowed product.
        limit: usize,
    },
}

/// Ranks `candidates` (name, goals) by how well `observed` (one row per sample) matches them.
///
/// Each candidate is compared over its own features, matched by name and unit; additional observed features are
/// ignored.
///
/// # Errors
/// [`RecognizeError`] for a threshold out of range or an observation that is too long.
pub fn recognize(
    observed: &Goals,
    candidates: &[(String, Goals)],
    spec: &RecognizeSpec,
) -> Result<Recognition, RecognizeError> {
    let threshold = spec.threshold.unwrap_or(DEFAULT_THRESHOLD);
    if threshold.is_nan() || threshold < 0.0 {
        return Err(RecognizeError::Threshold { threshold });
    }
    let mut matches = Vec::new();
    let mut incomparable = Vec::new();
    for (name, goals) in candidates {
        if observed.len().saturating_mul(goals.len()) > MAX_CELLS {
            return Err(RecognizeError::TooLarge { rows: observed.len(), goals: goals.len(), limit: MAX_CELLS });
        }
        match project(observed, goals.features()) {
            Ok(rows) => matches.push(compare(name, &rows, goals, spec.metric, threshold)),
            Err((feature, observed_unit)) => {
                incomparable.push(Incomparable { name: name.clone(), feature, observed_unit });
            }
        }
    }
    rank(&mut matches);
    let recognized = matches.first().filter(|best| best.within_threshold).map(|best| best.name.clone());
    Ok(Recognition { recognized, metric: spec.metric, threshold, matches, incomparable })
}

/// Orders best first: by discrepancy if all have the same features, else by relative discrepancy.
fn rank(matches: &mut [Match]) {
    let features = |found: &Match| {
        let mut names: Vec<String> = found.features.iter().map(|part| part.feature.header()).collect();
        names.sort();
        names
    };
    let alike = matches.windows(2).all(|pair| features(&pair[0]) == features(&pair[1]));
    let key = |found: &Match| if alike { found.discrepancy } else { found.relative_discrepancy };
    matches.sort_by(|a, b| key(a).total_cmp(&key(b)).then_with(|| a.name.cmp(&b.name)));
}

fn compare(name: &str, rows: &[f64], goals: &Goals, metric: Metric, threshold: f64) -> Match {
    let found = detailed(metric, rows, goals.values(), goals.features());
    let relative_discrepancy = found.mean_distance / size(goals, metric);
    Match {
        name: name.to_owned(),
        discrepancy: found.discrepancy,
        relative_discrepancy,
        within_threshold: relative_discrepancy <= threshold,
        features: found.features,
        path: found.path,
    }
}

/// Extracts the columns of `features` from the observation; the error is the missing feature and the unit it was
/// observed in.
fn project(observed: &Goals, features: &[Feature]) -> Result<Vec<f64>, (Feature, Option<String>)> {
    let column = |feature: &Feature| match observed.features().iter().position(|f| f.name == feature.name) {
        Some(column) if observed.features()[column].unit == feature.unit => Ok(column),
        Some(column) => Err((feature.clone(), Some(observed.features()[column].unit.clone()))),
        None => Err((feature.clone(), None)),
    };
    let columns = features.iter().map(column).collect::<Result<Vec<usize>, _>>()?;
    Ok(observed.rows().flat_map(|row| columns.iter().map(|&column| row[column])).collect())
}

/// Size R of an action, in its features' unit.
fn size(goals: &Goals, metric: Metric) -> f64 {
    let side = |feature: usize| {
        let values = goals.rows().map(move |row| row[feature]);
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        high - low
    };
    let sides = (0..goals.features().len()).map(side);
    let size = match metric {
        Metric::SumOfFeatures => sides.sum(),
        Metric::Multivariate | Metric::Aquila => sides.map(|s| s * s).sum::<f64>().sqrt(),
    };
    if size > 0.0 { size } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn goals(unit: &str, rows: &[[f64; 2]]) -> Goals {
        let rows: Vec<Vec<f64>> = rows.iter().map(|row| row.to_vec()).collect();
        Goals::new(vec![Feature::new("x", unit), Feature::new("y", unit)], &rows).unwrap()
    }

    fn candidates() -> Vec<(String, Goals)> {
        vec![
            ("back".to_owned(), goals("mm", &[[30.0, 0.0], [15.0, 20.0], [0.0, 40.0]])),
            ("along".to_owned(), goals("mm", &[[0.0, 0.0], [15.0, 20.0], [30.0, 40.0]])),
            ("metres".to_owned(), goals("m", &[[0.0, 0.0], [15.0, 20.0], [30.0, 40.0]])),
        ]
    }

    #[test]
    fn the_action_shown_is_ranked_first_and_units_have_to_match() {
        let observed = goals("mm", &[[0.0, 1.0], [8.0, 10.0], [15.0, 20.0], [22.0, 30.0], [30.0, 41.0]]);
        for metric in [Metric::SumOfFeatures, Metric::Multivariate, Metric::Aquila] {
            let found = recognize(&observed, &candidates(), &RecognizeSpec { metric, threshold: None }).unwrap();
            assert_eq!(found.recognized.as_deref(), Some("along"), "{metric:?}");
            assert_eq!(found.matches.len(), 2);
            assert!(found.matches[0].relative_discrepancy < found.matches[1].relative_discrepancy);
            assert_eq!(found.incomparable[0].name, "metres");
            assert_eq!(found.incomparable[0].observed_unit.as_deref(), Some("mm"));
        }
    }

    #[test]
    fn relative_discrepancy_is_the_mean_distance_over_the_size() {
        // both rows 5 mm off, size 50 mm: 5 / 50
        let action = vec![("a".to_owned(), goals("mm", &[[0.0, 0.0], [30.0, 40.0]]))];
        let observed = goals("mm", &[[3.0, 4.0], [33.0, 44.0]]);
        let spec = RecognizeSpec { metric: Metric::Multivariate, threshold: Some(0.1 + 1e-12) };
        let found = recognize(&observed, &action, &spec).unwrap();
        assert!((found.matches[0].discrepancy - 10.0).abs() < 1e-12);
        assert!((found.matches[0].relative_discrepancy - 0.1).abs() < 1e-12);
        assert_eq!(found.recognized.as_deref(), Some("a"));
    }

    #[test]
    fn something_else_is_unknown() {
        let observed = goals("mm", &[[500.0, 0.0], [500.0, -90.0], [480.0, -200.0]]);
        let found = recognize(&observed, &candidates(), &RecognizeSpec::default()).unwrap();
        assert_eq!(found.recognized, None);
        assert!(!found.matches[0].within_threshold);
    }

    #[test]
    fn actions_of_other_features_are_ranked_by_relative_discrepancy() {
        let x_only = Goals::new(vec![Feature::new("x", "mm")], &[vec![0.0], vec![1.0]]).unwrap();
        let mut actions = candidates();
        actions.truncate(2);
        actions.push(("small".to_owned(), x_only));
        let observed = goals("mm", &[[1.0, 3.0], [15.0, 24.0], [30.0, 44.0]]);
        let found = recognize(&observed, &actions, &RecognizeSpec::default()).unwrap();
        assert_eq!(found.matches[0].name, "along");
        let mut relative: Vec<f64> = found.matches.iter().map(|m| m.relative_discrepancy).collect();
        assert!(relative.is_sorted());
        relative.dedup();
        assert_eq!(relative.len(), 3);
    }

    #[test]
    fn actions_of_the_same_features_are_ranked_by_discrepancy() {
        let wide = goals("mm", &[[0.0, 0.0], [100.0, 0.0]]);
        let actions = vec![("narrow".to_owned(), goals("mm", &[[40.0, 0.0], [42.0, 0.0]])), ("wide".to_owned(), wide)];
        let found = recognize(&goals("mm", &[[35.0, 0.0], [55.0, 0.0]]), &actions, &RecognizeSpec::default()).unwrap();
        assert_eq!(found.matches[0].name, "narrow");
        assert!(found.matches[0].discrepancy < found.matches[1].discrepancy);
        assert!(found.matches[0].relative_discrepancy > found.matches[1].relative_discrepancy);
    }

    #[test]
    fn a_long_rest_at_the_first_goal_is_not_the_action() {
        let rest = goals("mm", &[[0.0, 0.0]; 500]);
        let found = recognize(&rest, &candidates(), &RecognizeSpec::default()).unwrap();
        assert_eq!(found.recognized, None);
        assert!((found.matches[0].relative_discrepancy - (25.0 + 50.0) / 3.0 / 50.0).abs() < 1e-12);
    }

    #[test]
    fn columns_are_matched_by_name() {
        let swapped = Goals::new(
            vec![Feature::new("y", "mm"), Feature::new("x", "mm")],
            &[vec![0.0, 0.0], vec![20.0, 15.0], vec![40.0, 30.0]],
        )
        .unwrap();
        let found = recognize(&swapped, &candidates(), &RecognizeSpec::default()).unwrap();
        assert_eq!(found.matches[0].name, "along");
        assert!(found.matches[0].discrepancy.abs() < 1e-12);
        assert_eq!(found.matches[0].path, [[0, 0], [1, 1], [2, 2]]);
    }
}
