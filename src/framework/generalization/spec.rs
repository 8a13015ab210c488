//! Input, output and errors of a generalization.

use super::Goals;
use crate::range::OutOfRange;
use serde::{Deserialize, Serialize};

/// How the samples of several demonstrations are combined into a goal.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Weighting {
    /// The mean of the demonstrations' means: every demonstration counts equally. n = floor(mean duration / T_min).
    #[default]
    PerDemonstration,
    /// As in the authors' script: the mean of all samples in the bin, so a longer or denser demonstration weighs more.
    /// Bins are half-open, which drops each last sample. Durations are rounded up to whole seconds before averaging,
    /// their mean is rounded down, and n = floor(that / T_min).
    PerSample,
}

/// Options of a generalization.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GeneralizeSpec {
    /// T_min, the duration of one goal, seconds (> 0).
    pub t_min_s: f64,
    /// How samples are weighted.
    #[serde(default)]
    pub weighting: Weighting,
    /// Names of the features to keep, in order; all if absent.
    #[serde(default)]
    pub features: Option<Vec<String>>,
}

impl GeneralizeSpec {
    /// Options for all features, weighted per demonstration.
    #[must_use]
    pub fn new(t_min_s: f64) -> Self {
        Self { t_min_s, weighting: Weighting::default(), features: None }
    }
}

/// A generalized action and the data it was made from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Generalized {
    /// Matrix X: n goals of m features.
    pub goals: Goals,
    /// n x m: standard deviation (N - 1) of the demonstrations' means in each goal's bin, features' units; 0 for a
    /// single demonstration.
    pub spread: Vec<Vec<f64>>,
    /// Duration of each demonstration, seconds.
    pub durations_s: Vec<f64>,
    /// Mean of the durations, seconds.
    pub mean_duration_s: f64,
    /// Requested T_min, seconds.
    pub t_min_s: f64,
    /// Requested weighting.
    pub weighting: Weighting,
    /// Number of bins (per feature and demonstration) without a sample, filled by linear interpolation in time.
    pub interpolated_bins: u64,
}

/// Reasons why demonstrations cannot be generalized.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GeneralizeError {
    /// No demonstration was given.
    #[error("there are no demonstrations to generalize: give at least one")]
    NoDemonstration,
    /// T_min is not a positive finite time.
    #[error(transparent)]
    Period(#[from] OutOfRange),
    /// T_min is longer than the demonstrations.
    #[error("t_min_s {t_min_s:?} s is longer than the mean duration of {mean_duration_s} s: give at most that")]
    NoGoal {
        /// Requested T_min, seconds.
        t_min_s: f64,
        /// Mean duration of the demonstrations, seconds.
        mean_duration_s: f64,
    },
    /// T_min is so short that it makes too many goals.
    #[error("t_min_s {t_min_s:?} s gives {goals:e} goals, more than {limit}: give a longer duration per goal")]
    TooManyGoals {
        /// Requested T_min, seconds.
        t_min_s: f64,
        /// Resulting number of goals n.
        goals: f64,
        /// Largest allowed n.
        limit: usize,
    },
    /// A demonstration lacks a feature.
    #[error(
        "demonstration {demonstration:?} has no feature {feature:?}, only {available:?}: select features that all have"
    )]
    MissingFeature {
        /// Name of the demonstration.
        demonstration: String,
        /// Name of the missing feature.
        feature: String,
        /// Names of the features it has.
        available: Vec<String>,
    },
    /// A demonstration has a feature that the first one lacks.
    #[error(
        "demonstration {demonstration:?} has a feature {feature:?} that {first:?} lacks: select features that all have"
    )]
    ExtraFeature {
        /// Name of the demonstration.
        demonstration: String,
        /// Name of the additional feature.
        feature: String,
        /// Name of the first demonstration.
        first: String,
    },
    /// A feature has different units in two demonstrations.
    #[error(
        "feature {feature:?} is in {unit:?} in demonstration {demonstration:?} but in {expected:?} in the first: convert one"
    )]
    UnitMismatch {
        /// Name of the demonstration.
        demonstration: String,
        /// Name of the feature.
        feature: String,
        /// Unit in this demonstration.
        unit: String,
        /// Its unit in the first demonstration.
        expected: String,
    },
    /// The selection is empty or names a feature twice.
    #[error("the selected features are {features:?}: give one or more names, each once")]
    Selection {
        /// Requested names.
        features: Vec<String>,
    },
    /// A stream does not overlap a goal's bin at all.
    #[error(
        "stream {stream:?} of demonstration {demonstration:?} has no sample around {time_s} s (goal {goal}); it covers \
         {from_s} s to {to_s} s: align the streams by start or leave its features out"
    )]
    Uncovered {
        /// Name of the demonstration.
        demonstration: String,
        /// Name of the stream.
        stream: String,
        /// Goal index from 0.
        goal: usize,
        /// Centre of the bin, recorder's clock, seconds.
        time_s: f64,
        /// First time of the stream, seconds.
        from_s: f64,
        /// Last time of the stream, seconds.
        to_s: f64,
    },
    /// The means overflow.
    #[error("the goals are not finite: {0}")]
    Goals(#[from] super::GoalsError),
}
