//! `/actions`: demonstrations generalized into goals; every version is immutable.

use super::answer::{ExportParameters, PageParameters, accepted, file};
use super::extract::{AsCaller, IdempotencyKey, Json, Path, Query};
use super::openapi::Binary;
use super::problem::Problem;
use crate::app::model::{ActionGoals, ActionId, ActionView, GeneralizationRequest, Interpolation, JobView, Page};
use axum::response::Response;
use serde::Deserialize;
use utoipa::IntoParams;

/// Starts the generalization of demonstrations; the action is in the job's result.
#[utoipa::path(post, path = "/actions", operation_id = "createAction", tag = "actions",
    params(("Idempotency-Key" = Option<String>, Header, description = "Same key and body: same job.")),
    request_body = GeneralizationRequest,
    responses((status = 202, description = "The job that generalizes them.", body = JobView)))]
pub async fn create(
    AsCaller(app): AsCaller,
    IdempotencyKey(key): IdempotencyKey,
    Json(request): Json<GeneralizationRequest>,
) -> Result<Response, Problem> {
    Ok(accepted(app.create_action(request, key).await?))
}

/// Actions, newest first.
#[utoipa::path(get, path = "/actions", operation_id = "listActions", tag = "actions", params(PageParameters),
    responses((status = 200, description = "One page.", body = Page<ActionView>)))]
pub async fn list(
    AsCaller(app): AsCaller,
    Query(page): Query<PageParameters>,
) -> Result<Json<Page<ActionView>>, Problem> {
    Ok(Json(app.list_actions(page.into()).await?))
}

/// One action without its goals.
#[utoipa::path(get, path = "/actions/{id}", operation_id = "getAction", tag = "actions",
    params(("id" = ActionId, Path)),
    responses((status = 200, description = "The action.", body = ActionView)))]
pub async fn get(AsCaller(app): AsCaller, Path(id): Path<ActionId>) -> Result<Json<ActionView>, Problem> {
    Ok(Json(app.get_action(&id).await?))
}

/// The goals of an action.
#[utoipa::path(get, path = "/actions/{id}/goals", operation_id = "getActionGoals", tag = "actions",
    params(("id" = ActionId, Path)),
    responses((status = 200, description = "One row per goal, one column per feature.", body = ActionGoals)))]
pub async fn goals(AsCaller(app): AsCaller, Path(id): Path<ActionId>) -> Result<Json<ActionGoals>, Problem> {
    Ok(Json(app.action_goals(&id).await?))
}

/// Number of points of the curve.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct InterpolateParameters {
    /// Number of points.
    n: u32,
}

/// Points of the curve through the goals (paper eq. 3).
#[utoipa::path(get, path = "/actions/{id}:interpolate", operation_id = "interpolateAction", tag = "actions",
    params(("id" = ActionId, Path), InterpolateParameters),
    responses((status = 200, description = "The curve.", body = Interpolation),
        (status = 409, description = "The goals do not define a curve.")))]
pub async fn interpolate(
    AsCaller(app): AsCaller,
    Path(id): Path<ActionId>,
    Query(wanted): Query<InterpolateParameters>,
) -> Result<Json<Interpolation>, Problem> {
    Ok(Json(app.interpolate_action(&id, wanted.n).await?))
}

/// The goals as a file: `csv` or `json`.
#[utoipa::path(get, path = "/actions/{id}:export", operation_id = "exportAction", tag = "actions",
    params(("id" = ActionId, Path), ExportParameters),
    responses((status = 200, description = "The file.", body = Binary, content_type = "application/octet-stream")))]
pub async fn export(
    AsCaller(app): AsCaller,
    Path(id): Path<ActionId>,
    Query(wanted): Query<ExportParameters>,
) -> Result<Response, Problem> {
    Ok(file(app.export_action(&id, &wanted.format).await?))
}
