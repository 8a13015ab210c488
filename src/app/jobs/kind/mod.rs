//! Job kinds, one file each: from a request to a job that can be submitted, its cost, and the same job once more.
//!
//! # Architecture Invariants
//! - Outside of this folder no use-case asks for the kind of a job. A new kind is a file here and an arm in each of the
//!   three functions of this module; the compiler names them.
//! - A resolved job is self-contained: references are looked up, defaults filled in, and everything is checked as the
//!   worker will. A dry run uses the same code.

mod cost;
mod execution;
pub(super) mod experiment;
mod generalization;

use crate::app::UseCases;
use crate::app::model::{AppError, CostEstimate, CreateJob, ExperimentId, JobProgress, JobView, Work};
use crate::app::ports::{Clock, Usage};
use crate::framework::execution::Chosen;
use crate::framework::experiment::Plan;
use cost::TrialCost;

/// A job that is ready to be submitted.
pub(super) struct Resolved {
    pub name: String,
    /// The request with its defaults filled in.
    pub request: CreateJob,
    pub work: Work,
    pub uses: Usage,
    pub progress: JobProgress,
    /// The experiment to store with it.
    pub experiment: Option<(ExperimentId, Plan)>,
}

impl Resolved {
    /// The method that `auto` stands for, if the job asks for it.
    pub(super) fn chosen(&self) -> Option<&Chosen> {
        match &self.work {
            Work::Execution(work) => work.problem.execution.chosen.as_ref(),
            Work::Generalization(_) | Work::Experiment { .. } => None,
        }
    }
}

/// Checks and completes a request.
///
/// # Errors
/// `Invalid` with every wrong place of the request.
pub(super) async fn resolve(app: &UseCases, request: CreateJob) -> Result<Resolved, AppError> {
    match request {
        CreateJob::Generalization(request) => generalization::resolve(app, request).await,
        CreateJob::Execution(request) => execution::resolve(app, *request).await,
        CreateJob::Experiment(request) => experiment::resolve(app, request).await,
    }
}

/// The same job once more: `work` is that of `job`.
///
/// # Errors
/// As the store.
pub(super) async fn again(app: &UseCases, job: JobView, work: Work) -> Result<Resolved, AppError> {
    let JobView { name, request, .. } = job;
    Ok(match work {
        Work::Generalization(work) => generalization::again(name, request, work),
        Work::Execution(work) => execution::again(name, request, *work),
        Work::Experiment { experiment } => experiment::again(app, name, request, &experiment).await?,
    })
}

/// The cost of a job if a trial on a robot takes `robot_trial_s` seconds.
///
/// # Errors
/// `Invalid` if a preview breaks off.
pub(super) fn estimate(resolved: &Resolved, robot_trial_s: f64, clock: &dyn Clock) -> Result<CostEstimate, AppError> {
    let cost = TrialCost { robot_trial_s, clock };
    match (&resolved.work, &resolved.experiment) {
        (Work::Generalization(_), _) | (Work::Experiment { .. }, None) => Ok(generalization::estimate()),
        (Work::Execution(work), _) => execution::estimate(work, cost),
        (Work::Experiment { .. }, Some((_, plan))) => experiment::estimate(plan, cost),
    }
}
