//! The named metrics of discrepancy. A value is always stored with its metric; there is no implicit one.

use super::dtw::Border;
use serde::{Deserialize, Serialize};

/// How dynamic time warping (DTW) turns two feature trajectories into one discrepancy.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Metric {
    /// One optimal path per feature, the normalised costs summed (paper eq. 4-6): each feature's distance is divided by
    /// I + J, the number of rows on both sides (Sakoe and Chiba's normaliser, the same for every path).
    SumOfFeatures,
    /// Euclidean local distance over all features jointly, one path, standard borders.
    #[default]
    Multivariate,
    /// Like `multivariate`, but the first row and column of the accumulated matrix hold the local distance only; the
    /// paper's published numbers use it.
    Aquila,
}

impl Metric {
    /// Border rule of the accumulated matrices.
    #[must_use]
    pub fn border(self) -> Border {
        match self {
            Self::SumOfFeatures | Self::Multivariate => Border::Accumulated,
            Self::Aquila => Border::Local,
        }
    }
}
