//! `/demonstrations`: read, rename, exclude, delete and export; the upload is in `uploads.rs`.

use super::answer::{ExportParameters, PageParameters, file, tagged};
use super::extract::{AsCaller, IfMatch, Json, Path, Query};
use super::openapi::Binary;
use super::problem::Problem;
use crate::app::model::{
    DemonstrationId, DemonstrationReport, DemonstrationView, Page, PatchDemonstration, SamplesQuery, SamplesView,
};
use axum::http::StatusCode;
use axum::response::Response;
use serde::Deserialize;
use utoipa::IntoParams;

/// Demonstrations, newest first.
#[utoipa::path(get, path = "/demonstrations", operation_id = "listDemonstrations", tag = "demonstrations",
    params(PageParameters),
    responses((status = 200, description = "One page.", body = Page<DemonstrationView>)))]
pub async fn list(
    AsCaller(app): AsCaller,
    Query(page): Query<PageParameters>,
) -> Result<Json<Page<DemonstrationView>>, Problem> {
    Ok(Json(app.list_demonstrations(page.into()).await?))
}

/// One demonstration.
#[utoipa::path(get, path = "/demonstrations/{id}", operation_id = "getDemonstration", tag = "demonstrations",
    params(("id" = DemonstrationId, Path)),
    responses((status = 200, description = "The demonstration; its revision is the ETag.", body = DemonstrationView)))]
pub async fn get(AsCaller(app): AsCaller, Path(id): Path<DemonstrationId>) -> Result<Response, Problem> {
    let view = app.get_demonstration(&id).await?;
    Ok(tagged(view.revision, view))
}

/// Renames a demonstration or leaves it out of new actions, with a reason.
#[utoipa::path(patch, path = "/demonstrations/{id}", operation_id = "patchDemonstration", tag = "demonstrations",
    params(("id" = DemonstrationId, Path), ("If-Match" = Option<String>, Header, description = "ETag to change.")),
    request_body = PatchDemonstration,
    responses((status = 200, description = "The changed demonstration.", body = DemonstrationView)))]
pub async fn patch(
    AsCaller(app): AsCaller,
    Path(id): Path<DemonstrationId>,
    IfMatch(revision): IfMatch,
    Json(change): Json<PatchDemonstration>,
) -> Result<Response, Problem> {
    let view = app.patch_demonstration(&id, change, revision).await?;
    Ok(tagged(view.revision, view))
}

/// Deletes a demonstration; actions generalized from it keep their goals.
#[utoipa::path(delete, path = "/demonstrations/{id}", operation_id = "deleteDemonstration", tag = "demonstrations",
    params(("id" = DemonstrationId, Path), ("If-Match" = Option<String>, Header, description = "ETag to delete.")),
    responses((status = 204, description = "Deleted.")))]
pub async fn delete(
    AsCaller(app): AsCaller,
    Path(id): Path<DemonstrationId>,
    IfMatch(revision): IfMatch,
) -> Result<StatusCode, Problem> {
    app.delete_demonstration(&id, revision).await?;
    Ok(StatusCode::NO_CONTENT)
}

/// Selection of samples.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct SamplesParameters {
    /// Features by name, separated by commas; all if absent.
    features: Option<String>,
    /// Start of the section, seconds after the first sample.
    from: Option<f64>,
    /// End of the section, seconds after the first sample.
    to: Option<f64>,
    /// Maximum number of points per feature; longer series keep the minimum and the maximum of each bin.
    max_points: Option<u32>,
}

/// Samples, decimated so that no minimum and no maximum is lost.
#[utoipa::path(get, path = "/demonstrations/{id}/samples", operation_id = "getDemonstrationSamples",
    tag = "demonstrations", params(("id" = DemonstrationId, Path), SamplesParameters),
    responses((status = 200, description = "One series per feature.", body = SamplesView)))]
pub async fn samples(
    AsCaller(app): AsCaller,
    Path(id): Path<DemonstrationId>,
    Query(wanted): Query<SamplesParameters>,
) -> Result<Json<SamplesView>, Problem> {
    let features = wanted.features.map(|names| names.split(',').map(str::to_owned).collect()).unwrap_or_default();
    let query = SamplesQuery { features, from_s: wanted.from, to_s: wanted.to, max_points: wanted.max_points };
    Ok(Json(app.demonstration_samples(&id, query).await?))
}

/// Findings of the reader at upload.
#[utoipa::path(get, path = "/demonstrations/{id}/report", operation_id = "getDemonstrationReport",
    tag = "demonstrations", params(("id" = DemonstrationId, Path)),
    responses((status = 200, description = "Findings in the order of the data.", body = DemonstrationReport)))]
pub async fn report(
    AsCaller(app): AsCaller,
    Path(id): Path<DemonstrationId>,
) -> Result<Json<DemonstrationReport>, Problem> {
    Ok(Json(app.demonstration_report(&id).await?))
}

/// The samples as a file: `csv` (one stream only) or `json`.
#[utoipa::path(get, path = "/demonstrations/{id}:export", operation_id = "exportDemonstration",
    tag = "demonstrations", params(("id" = DemonstrationId, Path), ExportParameters),
    responses((status = 200, description = "The file.", body = Binary, content_type = "application/octet-stream"),
        (status = 409, description = "Several streams do not fit into one CSV file.")))]
pub async fn export(
    AsCaller(app): AsCaller,
    Path(id): Path<DemonstrationId>,
    Query(wanted): Query<ExportParameters>,
) -> Result<Response, Problem> {
    Ok(file(app.export_demonstration(&id, &wanted.format).await?))
}
