//! What a generalization is asked for, what it gives, and why it may not be possible.

use super::Goals;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// How the samples of several demonstrations make one goal.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize, ToSchema, clap::ValueEnum)]
#[serde(rename_all = "snake_case")]
#[clap(rename_all = "snake_case")]
pub enum Weighting {
    /// The mean of the demonstrations' means: each showing counts alike. n = floor(mean duration / T_min).
    #[default]
    PerDemonstration,
    /// As the authors' script: the mean of all samples in the bin, so a longer or denser demonstration weighs more;
    /// bins are open at their end, which leaves out each last sample; durations are rounded up to whole seconds
    /// before the mean, the mean down, and n = floor(that / T_min).
    PerSample,
}

/// How demonstrations are generalized.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct GeneralizeSpec {
    /// T_min, the time of one goal, seconds (> 0).
    pub t_min_s: f64,
    /// How samples are weighted.
    #[serde(default)]
    pub weighting: Weighting,
    /// Names of the features to keep, in order; all when absent.
    #[serde(default)]
    pub features: Option<Vec<String>>,
}

impl GeneralizeSpec {
    /// All features, weighted per demonstration.
    #[must_use]
    pub fn new(t_min_s: f64) -> Self {
        Self { t_min_s, weighting: Weighting::default(), features: None }
    }
}

/// A generalized action with what it was made from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct Generalized {
    /// X: n goals of m features.
    pub goals: Goals,
    /// n x m: standard deviation (N - 1) over the demonstrations of their means in the goal's bin, features' units;
    /// 0 for a single demonstration.
    pub spread: Vec<Vec<f64>>,
    /// Duration of each demonstration, seconds.
    pub durations_s: Vec<f64>,
    /// Their mean, seconds.
    pub mean_duration_s: f64,
    /// T_min as asked for, seconds.
    pub t_min_s: f64,
    /// The weighting as asked for.
    pub weighting: Weighting,
    /// Bins (of one feature of one demonstration) without a sample, filled by linear interpolation in time.
    pub interpolated_bins: u64,
}

/// Why demonstrations cannot be generalized.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GeneralizeError {
    /// None were given.
    #[error("no demonstration to generalize: give at least one")]
    NoDemonstration,
    /// T_min is not a positive finite time.
    #[error("t_min_s is {t_min_s:?} s: give a positive time of one goal")]
    Period {
        /// As asked for.
        t_min_s: f64,
    },
    /// T_min is longer than the demonstrations.
    #[error("t_min_s {t_min_s:?} s leaves no goal in a mean duration of {mean_duration_s} s: give at most that")]
    NoGoal {
        /// As asked for.
        t_min_s: f64,
        /// Mean duration of the demonstrations.
        mean_duration_s: f64,
    },
    /// T_min is far shorter than any use.
    #[error("t_min_s {t_min_s:?} s makes {goals:e} goals, more than {limit}: give a longer time of one goal")]
    TooManyGoals {
        /// As asked for.
        t_min_s: f64,
        /// n that would follow.
        goals: f64,
        /// Largest n.
        limit: usize,
    },
    /// A demonstration lacks a feature.
    #[error("demonstration {demonstration:?} has no feature {feature:?}, only {available:?}: select features all have")]
    MissingFeature {
        /// Name of the demonstration.
        demonstration: String,
        /// The feature.
        feature: String,
        /// What it has.
        available: Vec<String>,
    },
    /// A demonstration has a feature the first one has not.
    #[error(
        "demonstration {demonstration:?} has a feature {feature:?} that {first:?} has not: select features all have"
    )]
    ExtraFeature {
        /// Name of the demonstration.
        demonstration: String,
        /// The feature.
        feature: String,
        /// Name of the first demonstration.
        first: String,
    },
    /// A feature in two units.
    #[error(
        "feature {feature:?} is in {unit:?} in demonstration {demonstration:?}, in {expected:?} in the first: convert one"
    )]
    UnitMismatch {
        /// Name of the demonstration.
        demonstration: String,
        /// The feature.
        feature: String,
        /// Its unit there.
        unit: String,
        /// Its unit in the first demonstration.
        expected: String,
    },
    /// The selection is empty or names a feature twice.
    #[error("the selected features {features:?} are not one or more different names")]
    Selection {
        /// As asked for.
        features: Vec<String>,
    },
    /// A stream does not cover a goal's bin at all.
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
        /// Middle of the bin, recorder's time.
        time_s: f64,
        /// First time of the stream.
        from_s: f64,
        /// Last time of the stream.
        to_s: f64,
    },
    /// The means overflow.
    #[error("the goals are not finite: {0}")]
    Goals(#[from] super::GoalsError),
}
