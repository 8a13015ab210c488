//! Samples of a demonstration, one series per feature.

use super::id::DemonstrationId;
use crate::framework::Feature;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Which samples.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SamplesQuery {
    /// Features by name; all when empty.
    pub features: Vec<String>,
    /// From this time on, seconds after the first sample of the demonstration.
    pub from_s: Option<f64>,
    /// Up to this time, seconds after the first sample of the demonstration.
    pub to_s: Option<f64>,
    /// At most so many points a feature (4 to 20000; 1000 when absent), by minimum and maximum of each bin.
    pub max_points: Option<u32>,
}

/// Samples of a demonstration, one series a feature.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct SamplesView {
    /// The demonstration.
    pub demonstration: DemonstrationId,
    /// One series a feature.
    pub series: Vec<Series>,
}

/// One feature's samples.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Series {
    /// Stream name.
    pub stream: String,
    /// Feature.
    pub feature: Feature,
    /// Times, seconds after the first sample of the demonstration.
    pub t_s: Vec<f64>,
    /// Values, in the feature's unit.
    pub values: Vec<f64>,
    /// Whether some samples were left out.
    pub decimated: bool,
}
