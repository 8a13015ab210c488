//! `/worlds`: simulations of the effects.

use super::answer::{PageParameters, created};
use super::extract::{AsCaller, Json, Path, Query};
use super::problem::Problem;
use crate::app::model::{CreateWorld, Page, WorldId, WorldView};
use axum::http::StatusCode;
use axum::response::Response;

/// Checks and stores a world.
#[utoipa::path(post, path = "/worlds", operation_id = "createWorld", tag = "worlds", request_body = CreateWorld,
    responses((status = 201, description = "The world.", body = WorldView)))]
pub async fn create(AsCaller(app): AsCaller, Json(request): Json<CreateWorld>) -> Result<Response, Problem> {
    let view = app.create_world(request).await?;
    Ok(created("worlds", view.id.clone().as_str(), view))
}

/// Worlds, newest first.
#[utoipa::path(get, path = "/worlds", operation_id = "listWorlds", tag = "worlds", params(PageParameters),
    responses((status = 200, description = "One page.", body = Page<WorldView>)))]
pub async fn list(
    AsCaller(app): AsCaller,
    Query(page): Query<PageParameters>,
) -> Result<Json<Page<WorldView>>, Problem> {
    Ok(Json(app.list_worlds(page.into()).await?))
}

/// One world.
#[utoipa::path(get, path = "/worlds/{id}", operation_id = "getWorld", tag = "worlds", params(("id" = WorldId, Path)),
    responses((status = 200, description = "The world.", body = WorldView)))]
pub async fn get(AsCaller(app): AsCaller, Path(id): Path<WorldId>) -> Result<Json<WorldView>, Problem> {
    Ok(Json(app.get_world(&id).await?))
}

/// Deletes a world that no job uses.
#[utoipa::path(delete, path = "/worlds/{id}", operation_id = "deleteWorld", tag = "worlds",
    params(("id" = WorldId, Path)),
    responses((status = 204, description = "Deleted."), (status = 409, description = "A job uses it.")))]
pub async fn delete(AsCaller(app): AsCaller, Path(id): Path<WorldId>) -> Result<StatusCode, Problem> {
    app.delete_world(&id).await?;
    Ok(StatusCode::NO_CONTENT)
}
