//! `/runs`: finished repetitions of execution jobs.

use super::extract::{AsCaller, Json, Path, Query};
use super::problem::Problem;
use crate::app::model::{
    Convergence, JobId, Page, PageQuery, RunFilter, RunGoals, RunId, RunTrials, RunView, TrajectoryView,
};
use serde::Deserialize;
use utoipa::IntoParams;

/// Filter and page of runs.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct RunsParameters {
    /// Only runs of this job.
    #[param(value_type = Option<String>)]
    job: Option<JobId>,
    /// Maximum number of items on the page.
    page_size: Option<u32>,
    /// `next_page_token` of the previous page.
    page_token: Option<String>,
}

/// Runs, newest first.
#[utoipa::path(get, path = "/runs", operation_id = "listRuns", tag = "runs", params(RunsParameters),
    responses((status = 200, description = "One page.", body = Page<RunView>)))]
pub async fn list(
    AsCaller(app): AsCaller,
    Query(wanted): Query<RunsParameters>,
) -> Result<Json<Page<RunView>>, Problem> {
    let page = PageQuery { page_size: wanted.page_size, page_token: wanted.page_token };
    Ok(Json(app.list_runs(RunFilter { job: wanted.job }, page).await?))
}

/// One run.
#[utoipa::path(get, path = "/runs/{id}", operation_id = "getRun", tag = "runs", params(("id" = RunId, Path)),
    responses((status = 200, description = "The run.", body = RunView)))]
pub async fn get(AsCaller(app): AsCaller, Path(id): Path<RunId>) -> Result<Json<RunView>, Problem> {
    Ok(Json(app.get_run(&id).await?))
}

/// The goals of a run, with target and observation.
#[utoipa::path(get, path = "/runs/{id}/goals", operation_id = "getRunGoals", tag = "runs",
    params(("id" = RunId, Path)),
    responses((status = 200, description = "One entry per goal.", body = RunGoals)))]
pub async fn goals(AsCaller(app): AsCaller, Path(id): Path<RunId>) -> Result<Json<RunGoals>, Problem> {
    Ok(Json(app.run_goals(&id).await?))
}

/// All trials of a run; empty unless its method records them.
#[utoipa::path(get, path = "/runs/{id}/trials", operation_id = "getRunTrials", tag = "runs",
    params(("id" = RunId, Path)),
    responses((status = 200, description = "In the order they were made.", body = RunTrials)))]
pub async fn trials(AsCaller(app): AsCaller, Path(id): Path<RunId>) -> Result<Json<RunTrials>, Problem> {
    Ok(Json(app.run_trials(&id).await?))
}

/// Number of points of a convergence curve.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct ConvergenceParameters {
    /// Maximum number of points.
    max_points: Option<u32>,
}

/// Discrepancy over evaluations.
#[utoipa::path(get, path = "/runs/{id}/convergence", operation_id = "getRunConvergence", tag = "runs",
    params(("id" = RunId, Path), ConvergenceParameters),
    responses((status = 200, description = "Points in the order of evaluations.", body = Convergence)))]
pub async fn convergence(
    AsCaller(app): AsCaller,
    Path(id): Path<RunId>,
    Query(wanted): Query<ConvergenceParameters>,
) -> Result<Json<Convergence>, Problem> {
    Ok(Json(app.run_convergence(&id, wanted.max_points).await?))
}

/// The trajectory of a run.
#[utoipa::path(get, path = "/runs/{id}/trajectory", operation_id = "getRunTrajectory", tag = "runs",
    params(("id" = RunId, Path)),
    responses((status = 200, description = "The trajectory with its points.", body = TrajectoryView)))]
pub async fn trajectory(AsCaller(app): AsCaller, Path(id): Path<RunId>) -> Result<Json<TrajectoryView>, Problem> {
    Ok(Json(app.run_trajectory(&id).await?))
}
