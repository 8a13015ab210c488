//! Dry runs: is a job acceptable, and what would it cost?

use super::kind;
use crate::app::model::{AppError, CostEstimate, CreateJob, ErrorKind, Validation, limits};
use crate::app::{UseCases, compute};
use crate::framework::execution::{Chosen, ROBOT_TRIAL_S};
use crate::framework::range::above;
use std::sync::Arc;

impl UseCases {
    /// Checks a job as [`UseCases::create_job`] would, without creating it, and estimates its cost. A trial on a robot is
    /// assumed to take `robot_trial_s` seconds (15 if absent).
    ///
    /// # Errors
    /// Only if the service is at fault; problems of the request are part of the answer.
    pub async fn validate_job(&self, request: CreateJob, robot_trial_s: Option<f64>) -> Result<Validation, AppError> {
        match self.preview(request, robot_trial_s.unwrap_or(ROBOT_TRIAL_S)).await {
            Ok((estimate, chosen)) => {
                Ok(Validation { valid: true, errors: Vec::new(), estimate: Some(estimate), chosen })
            }
            Err(error) if error.kind == ErrorKind::Invalid => {
                Ok(Validation { valid: false, errors: error.details, estimate: None, chosen: None })
            }
            Err(error) => Err(error),
        }
    }

    async fn preview(
        &self,
        request: CreateJob,
        robot_trial_s: f64,
    ) -> Result<(CostEstimate, Option<Chosen>), AppError> {
        above(0.0)
            .up_to(limits::MAX_TRIAL_S)
            .check("robot_trial_s", Some("s"), robot_trial_s)
            .map_err(|error| AppError::field("/robot_trial_s", "out_of_range", error.to_string()))?;
        let resolved = kind::resolve(self, request).await?;
        let chosen = resolved.chosen().cloned();
        let clock = Arc::clone(&self.ports.clock);
        let estimate = compute(move || kind::estimate(&resolved, robot_trial_s, clock.as_ref())).await??;
        Ok((estimate, chosen))
    }
}
