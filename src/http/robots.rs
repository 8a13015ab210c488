//! `/robots`: URDFs with their moving chains; every version is immutable.

use super::answer::{PageParameters, created};
use super::extract::{AsCaller, Json, Path, Query};
use super::problem::Problem;
use crate::app::model::{CreateRobot, Page, RobotId, RobotView};
use axum::http::StatusCode;
use axum::http::header::CONTENT_TYPE;
use axum::response::{IntoResponse as _, Response};

/// Checks and stores a robot; an existing name makes a new version.
#[utoipa::path(post, path = "/robots", operation_id = "createRobot", tag = "robots", request_body = CreateRobot,
    responses((status = 201, description = "The robot.", body = RobotView)))]
pub async fn create(AsCaller(app): AsCaller, Json(request): Json<CreateRobot>) -> Result<Response, Problem> {
    let view = app.create_robot(request).await?;
    Ok(created("robots", view.id.clone().as_str(), view))
}

/// Robots, newest first.
#[utoipa::path(get, path = "/robots", operation_id = "listRobots", tag = "robots", params(PageParameters),
    responses((status = 200, description = "One page.", body = Page<RobotView>)))]
pub async fn list(
    AsCaller(app): AsCaller,
    Query(page): Query<PageParameters>,
) -> Result<Json<Page<RobotView>>, Problem> {
    Ok(Json(app.list_robots(page.into()).await?))
}

/// One robot without its URDF.
#[utoipa::path(get, path = "/robots/{id}", operation_id = "getRobot", tag = "robots", params(("id" = RobotId, Path)),
    responses((status = 200, description = "The robot.", body = RobotView)))]
pub async fn get(AsCaller(app): AsCaller, Path(id): Path<RobotId>) -> Result<Json<RobotView>, Problem> {
    Ok(Json(app.get_robot(&id).await?))
}

/// The URDF of a robot, exactly as it was sent.
#[utoipa::path(get, path = "/robots/{id}/urdf", operation_id = "getRobotUrdf", tag = "robots",
    params(("id" = RobotId, Path)),
    responses((status = 200, description = "The URDF.", body = String, content_type = "text/xml")))]
pub async fn urdf(AsCaller(app): AsCaller, Path(id): Path<RobotId>) -> Result<Response, Problem> {
    let urdf = app.robot_urdf(&id).await?;
    Ok(([(CONTENT_TYPE, "text/xml; charset=utf-8")], urdf).into_response())
}

/// Deletes a robot that no job uses.
#[utoipa::path(delete, path = "/robots/{id}", operation_id = "deleteRobot", tag = "robots",
    params(("id" = RobotId, Path)),
    responses((status = 204, description = "Deleted."), (status = 409, description = "A job uses it.")))]
pub async fn delete(AsCaller(app): AsCaller, Path(id): Path<RobotId>) -> Result<StatusCode, Problem> {
    app.delete_robot(&id).await?;
    Ok(StatusCode::NO_CONTENT)
}
