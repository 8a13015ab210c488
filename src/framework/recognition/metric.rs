//! The named metrics of discrepancy; always stored beside a value, never implicit.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// How dynamic time warping (DTW) turns two feature trajectories into one discrepancy.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize, ToSchema, clap::ValueEnum)]
#[serde(rename_all = "snake_case")]
#[clap(rename_all = "snake_case")]
pub enum Metric {
    /// One optimal path per feature, the normalised costs summed (paper eq. 4-6).
    SumOfFeatures,
    /// Euclidean local distance over all features jointly, one path, standard borders.
    #[default]
    Multivariate,
    /// As `multivariate`, but the first row and column of the accumulated matrix hold the local distance only: what
    /// the paper's published numbers used.
    Aquila,
}
