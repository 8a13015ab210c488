//! `/trajectories`: checked joint trajectories.

use super::answer::{ExportParameters, file};
use super::extract::{AsCaller, Json, Path, Query};
use super::openapi::Binary;
use super::problem::Problem;
use crate::app::model::{TrajectoryId, TrajectoryView};
use axum::response::Response;

/// One trajectory with its points.
#[utoipa::path(get, path = "/trajectories/{id}", operation_id = "getTrajectory", tag = "trajectories",
    params(("id" = TrajectoryId, Path)),
    responses((status = 200, description = "The trajectory.", body = TrajectoryView)))]
pub async fn get(AsCaller(app): AsCaller, Path(id): Path<TrajectoryId>) -> Result<Json<TrajectoryView>, Problem> {
    Ok(Json(app.get_trajectory(&id).await?))
}

/// The trajectory as a file: `csv`, `json` or `ros2` (trajectory_msgs/JointTrajectory).
#[utoipa::path(get, path = "/trajectories/{id}:export", operation_id = "exportTrajectory", tag = "trajectories",
    params(("id" = TrajectoryId, Path), ExportParameters),
    responses((status = 200, description = "The file.", body = Binary, content_type = "application/octet-stream"),
        (status = 409, description = "This version plans it differently: run the job again.")))]
pub async fn export(
    AsCaller(app): AsCaller,
    Path(id): Path<TrajectoryId>,
    Query(wanted): Query<ExportParameters>,
) -> Result<Response, Problem> {
    Ok(file(app.export_trajectory(&id, &wanted.format).await?))
}
