//! `/jobs`: submit, read, pause, resume, cancel, clone; the events of a job are in `events.rs`.

use super::answer::accepted;
use super::extract::{AsCaller, IdempotencyKey, Json, Path, Query};
use super::problem::Problem;
use crate::app::model::{
    AppError, CreateJob, ErrorKind, JobFilter, JobId, JobKind, JobView, Page, PageQuery, Validation,
};
use crate::framework::job::State as JobState;
use axum::response::Response;
use serde::Deserialize;
use utoipa::IntoParams;

/// Submits a job.
#[utoipa::path(post, path = "/jobs", operation_id = "createJob", tag = "jobs",
    params(("Idempotency-Key" = Option<String>, Header, description = "Same key and body: same job.")),
    request_body = CreateJob,
    responses((status = 202, description = "The job.", body = JobView)))]
pub async fn create(
    AsCaller(app): AsCaller,
    IdempotencyKey(key): IdempotencyKey,
    Json(request): Json<CreateJob>,
) -> Result<Response, Problem> {
    Ok(accepted(app.create_job(request, key).await?))
}

/// Dry run of a job: its errors, or its estimated cost.
#[utoipa::path(post, path = "/jobs:validate", operation_id = "validateJob", tag = "jobs", params(DryRunParameters),
    request_body = CreateJob, responses((status = 200, description = "Errors, or an estimate.", body = Validation)))]
pub async fn validate(
    AsCaller(app): AsCaller,
    Query(wanted): Query<DryRunParameters>,
    Json(request): Json<CreateJob>,
) -> Result<Json<Validation>, Problem> {
    Ok(Json(app.validate_job(request, wanted.robot_trial_s).await?))
}

/// Assumptions of a dry run.
#[derive(Debug, Clone, Copy, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct DryRunParameters {
    /// Duration of a trial on a robot, seconds; 15 if absent.
    robot_trial_s: Option<f64>,
}

/// Filter and page of jobs.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct JobsParameters {
    /// Only jobs in one of these states, separated by commas, for example `QUEUED,RUNNING`; all if absent.
    state: Option<String>,
    /// Only jobs of this kind.
    #[param(inline)]
    kind: Option<JobKind>,
    /// Maximum number of items on the page.
    page_size: Option<u32>,
    /// `next_page_token` of the previous page.
    page_token: Option<String>,
}

/// Jobs, newest first.
#[utoipa::path(get, path = "/jobs", operation_id = "listJobs", tag = "jobs", params(JobsParameters),
    responses((status = 200, description = "One page.", body = Page<JobView>)))]
pub async fn list(
    AsCaller(app): AsCaller,
    Query(wanted): Query<JobsParameters>,
) -> Result<Json<Page<JobView>>, Problem> {
    let filter = JobFilter { states: states(wanted.state.as_deref())?, kind: wanted.kind };
    let page = PageQuery { page_size: wanted.page_size, page_token: wanted.page_token };
    Ok(Json(app.list_jobs(filter, page).await?))
}

fn states(text: Option<&str>) -> Result<Vec<JobState>, AppError> {
    let names = text.unwrap_or("").split(',').filter(|name| !name.is_empty());
    names.map(state).collect()
}

fn state(name: &str) -> Result<JobState, AppError> {
    serde_json::from_value(serde_json::Value::from(name)).map_err(|_| {
        let message = format!("{name:?} is not a state of a job: give for example QUEUED, RUNNING or SUCCEEDED");
        AppError::new(ErrorKind::Malformed, "invalid_query", message)
    })
}

/// One job.
#[utoipa::path(get, path = "/jobs/{id}", operation_id = "getJob", tag = "jobs", params(("id" = JobId, Path)),
    responses((status = 200, description = "The job.", body = JobView)))]
pub async fn get(AsCaller(app): AsCaller, Path(id): Path<JobId>) -> Result<Json<JobView>, Problem> {
    Ok(Json(app.get_job(&id).await?))
}

/// Asks a job to pause at its next checkpoint.
#[utoipa::path(post, path = "/jobs/{id}:pause", operation_id = "pauseJob", tag = "jobs",
    params(("id" = JobId, Path)),
    responses((status = 200, description = "The job.", body = JobView),
        (status = 409, description = "It cannot be paused in its present state.")))]
pub async fn pause(AsCaller(app): AsCaller, Path(id): Path<JobId>) -> Result<Json<JobView>, Problem> {
    Ok(Json(app.pause_job(&id).await?))
}

/// Resumes a paused job.
#[utoipa::path(post, path = "/jobs/{id}:resume", operation_id = "resumeJob", tag = "jobs",
    params(("id" = JobId, Path)),
    responses((status = 200, description = "The job.", body = JobView),
        (status = 409, description = "It is not paused.")))]
pub async fn resume(AsCaller(app): AsCaller, Path(id): Path<JobId>) -> Result<Json<JobView>, Problem> {
    Ok(Json(app.resume_job(&id).await?))
}

/// Asks a job to stop without a result; its finished runs are kept.
#[utoipa::path(post, path = "/jobs/{id}:cancel", operation_id = "cancelJob", tag = "jobs",
    params(("id" = JobId, Path)),
    responses((status = 200, description = "The job.", body = JobView),
        (status = 409, description = "It has already ended.")))]
pub async fn cancel(AsCaller(app): AsCaller, Path(id): Path<JobId>) -> Result<Json<JobView>, Problem> {
    Ok(Json(app.cancel_job(&id).await?))
}

/// Submits the same job again, with the same seed.
#[utoipa::path(post, path = "/jobs/{id}:clone", operation_id = "cloneJob", tag = "jobs",
    params(("id" = JobId, Path),
        ("Idempotency-Key" = Option<String>, Header, description = "Same key and body: same job.")),
    responses((status = 202, description = "The new job.", body = JobView)))]
pub async fn clone(
    AsCaller(app): AsCaller,
    Path(id): Path<JobId>,
    IdempotencyKey(key): IdempotencyKey,
) -> Result<Response, Problem> {
    Ok(accepted(app.clone_job(&id, key).await?))
}
