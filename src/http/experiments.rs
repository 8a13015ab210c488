//! `/experiments`: many runs of many settings, their table, comparisons and files.

use super::answer::{ExportParameters, PageParameters, accepted, file};
use super::extract::{AsCaller, IdempotencyKey, Json, Path, Query};
use super::openapi::Binary;
use super::problem::Problem;
use crate::app::model::{
    ExperimentComparison, ExperimentId, ExperimentRequest, ExperimentTable, ExperimentView, JobView, Page, PageQuery,
};
use crate::framework::experiment::{Quantity, RunRow};
use axum::response::Response;
use serde::Deserialize;
use utoipa::IntoParams;

/// Submits an experiment; the job's result names it at once.
#[utoipa::path(post, path = "/experiments", operation_id = "createExperiment", tag = "experiments",
    params(("Idempotency-Key" = Option<String>, Header, description = "Same key and body: same job.")),
    request_body = ExperimentRequest,
    responses((status = 202, description = "The job that runs it.", body = JobView)))]
pub async fn create(
    AsCaller(app): AsCaller,
    IdempotencyKey(key): IdempotencyKey,
    Json(request): Json<ExperimentRequest>,
) -> Result<Response, Problem> {
    Ok(accepted(app.create_experiment(request, key).await?))
}

/// Experiments, newest first.
#[utoipa::path(get, path = "/experiments", operation_id = "listExperiments", tag = "experiments",
    params(PageParameters), responses((status = 200, description = "One page.", body = Page<ExperimentView>)))]
pub async fn list(
    AsCaller(app): AsCaller,
    Query(page): Query<PageParameters>,
) -> Result<Json<Page<ExperimentView>>, Problem> {
    Ok(Json(app.list_experiments(page.into()).await?))
}

/// One experiment with its progress.
#[utoipa::path(get, path = "/experiments/{id}", operation_id = "getExperiment", tag = "experiments",
    params(("id" = ExperimentId, Path)),
    responses((status = 200, description = "The experiment.", body = ExperimentView)))]
pub async fn get(AsCaller(app): AsCaller, Path(id): Path<ExperimentId>) -> Result<Json<ExperimentView>, Problem> {
    Ok(Json(app.get_experiment(&id).await?))
}

/// The table so far: mean, spread, 95 % interval and order statistics of each cell.
#[utoipa::path(get, path = "/experiments/{id}/table", operation_id = "getExperimentTable", tag = "experiments",
    params(("id" = ExperimentId, Path)),
    responses((status = 200, description = "One entry per cell.", body = ExperimentTable)))]
pub async fn table(AsCaller(app): AsCaller, Path(id): Path<ExperimentId>) -> Result<Json<ExperimentTable>, Problem> {
    Ok(Json(app.experiment_table(&id).await?))
}

/// Filter and page of rows.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct RowsParameters {
    /// Only rows of this cell, by its index from 0.
    cell: Option<u32>,
    /// Maximum number of items on the page.
    page_size: Option<u32>,
    /// `next_page_token` of the previous page.
    page_token: Option<String>,
}

/// The finished runs, by cell, then repetition.
#[utoipa::path(get, path = "/experiments/{id}/rows", operation_id = "listExperimentRows", tag = "experiments",
    params(("id" = ExperimentId, Path), RowsParameters),
    responses((status = 200, description = "One page.", body = Page<RunRow>)))]
pub async fn rows(
    AsCaller(app): AsCaller,
    Path(id): Path<ExperimentId>,
    Query(wanted): Query<RowsParameters>,
) -> Result<Json<Page<RunRow>>, Problem> {
    let page = PageQuery { page_size: wanted.page_size, page_token: wanted.page_token };
    Ok(Json(app.experiment_rows(&id, wanted.cell, page).await?))
}

/// The two cells and what to compare.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct CompareParameters {
    /// Index of the first cell, from 0.
    first: u32,
    /// Index of the second cell, from 0.
    second: u32,
    /// Quantity to compare.
    #[param(inline)]
    quantity: Quantity,
}

/// Comparison of two cells seed by seed: mean difference with its 95 % interval, and Wilcoxon's signed rank test.
#[utoipa::path(get, path = "/experiments/{id}:compare", operation_id = "compareExperiment", tag = "experiments",
    params(("id" = ExperimentId, Path), CompareParameters),
    responses((status = 200, description = "The comparison.", body = ExperimentComparison),
        (status = 409, description = "No seed has finished in both cells yet.")))]
pub async fn compare(
    AsCaller(app): AsCaller,
    Path(id): Path<ExperimentId>,
    Query(wanted): Query<CompareParameters>,
) -> Result<Json<ExperimentComparison>, Problem> {
    Ok(Json(app.compare_experiment(&id, wanted.first, wanted.second, wanted.quantity).await?))
}

/// The table as a file: `csv` as `cgda reproduce --csv` writes it, `full_csv` with every statistic, or `markdown`.
#[utoipa::path(get, path = "/experiments/{id}:export", operation_id = "exportExperiment", tag = "experiments",
    params(("id" = ExperimentId, Path), ExportParameters),
    responses((status = 200, description = "The file.", body = Binary, content_type = "application/octet-stream")))]
pub async fn export(
    AsCaller(app): AsCaller,
    Path(id): Path<ExperimentId>,
    Query(wanted): Query<ExportParameters>,
) -> Result<Response, Problem> {
    Ok(file(app.export_experiment(&id, &wanted.format).await?))
}
