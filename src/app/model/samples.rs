//! Samples of a demonstration, one series per feature.

use super::id::DemonstrationId;
use crate::framework::Feature;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Selection of samples.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SamplesQuery {
    /// Names of features; all if empty.
    pub features: Vec<String>,
    /// Start of the window, seconds after the first sample of the demonstration.
    pub from_s: Option<f64>,
    /// End of the window, seconds after the first sample of the demonstration.
    pub to_s: Option<f64>,
    /// Maximum number of points per feature: the minimum and maximum of each bin.
    pub max_points: Option<u32>,
}

/// Samples of a demonstration, one series per feature.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct SamplesView {
    /// Id of the demonstration.
    pub demonstration: DemonstrationId,
    /// One series per feature.
    pub series: Vec<Series>,
}

/// One feature's samples.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Series {
    /// Stream name.
    pub stream: String,
    /// Name and unit of the feature.
    pub feature: Feature,
    /// Times in seconds after the first sample of the demonstration.
    pub t_s: Vec<f64>,
    /// Values, in the feature's unit.
    pub values: Vec<f64>,
    /// Whether samples were left out.
    pub decimated: bool,
}
