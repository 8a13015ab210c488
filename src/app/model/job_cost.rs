//! The answer of a dry run: errors or an estimate of the cost.

use super::error::FieldError;
use crate::framework::execution::Chosen;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Result of a dry run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Validation {
    /// Whether the job would be accepted.
    pub valid: bool,
    /// Errors in the request; empty if it is valid.
    pub errors: Vec<FieldError>,
    /// Estimated cost; absent if the job is invalid.
    #[schema(required = true)]
    pub estimate: Option<CostEstimate>,
    /// Method chosen for `auto`, with the reason; absent if the job names a method.
    #[schema(required = true)]
    pub chosen: Option<Chosen>,
}

/// Estimated cost of a job.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct CostEstimate {
    /// Number of evaluations over all repetitions.
    pub evaluations: u64,
    /// Duration in simulation on this machine, seconds.
    pub simulated_s: f64,
    /// Duration if each evaluation were a trial on a robot, seconds.
    pub robot_s: f64,
    /// The cost in words, for example `about 16 evaluations; at 15 s each, 4 minutes of robot time`.
    pub text: String,
    /// Description of how the estimate was made.
    pub basis: String,
}
