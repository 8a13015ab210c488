//! The answer of a dry run: errors or an estimate of the cost.

use super::error::FieldError;
use crate::framework::execution::Chosen;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// The answer of a dry run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Validation {
    /// Whether the job would be accepted.
    pub valid: bool,
    /// What is wrong with it.
    pub errors: Vec<FieldError>,
    /// What it would cost, if it is valid.
    pub estimate: Option<CostEstimate>,
    /// Which method `auto` stands for, and why, if the job asks for it.
    pub chosen: Option<Chosen>,
}

/// What a job will cost, roughly.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct CostEstimate {
    /// Evaluations of all repetitions.
    pub evaluations: u64,
    /// Time on this machine in simulation, seconds.
    pub simulated_s: f64,
    /// Time if each evaluation were a trial on a robot, seconds.
    pub robot_s: f64,
    /// The cost in words, for example `about 16 evaluations; at 15 s each, 4 minutes of robot time`.
    pub text: String,
    /// How the estimate was made.
    pub basis: String,
}
