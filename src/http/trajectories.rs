//! `/trajectories`: checked joint trajectories.

use super::answer::file;
use super::extract::{AsCaller, Json, Path, Query};
use super::openapi::Binary;
use super::problem::Problem;
use crate::app::model::{TrajectoryId, TrajectoryView};
use crate::app::trajectories::export_names;
use axum::response::Response;
use serde::Deserialize;
use utoipa::IntoParams;

/// Format and names of an export.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct TrajectoryParameters {
    /// `csv`, `json` or `ros2`.
    pub format: String,
    /// Text in front of each joint's name.
    pub prefix: Option<String>,
    /// Other names of joints, `OLD=NEW`, separated by commas; the prefix is put in front of them too.
    pub rename: Option<String>,
    /// Leaves out the joints that hold one value throughout.
    pub omit_held: Option<bool>,
}

/// One trajectory with its points.
#[utoipa::path(get, path = "/trajectories/{id}", operation_id = "getTrajectory", tag = "trajectories",
    params(("id" = TrajectoryId, Path)),
    responses((status = 200, description = "The trajectory.", body = TrajectoryView)))]
pub async fn get(AsCaller(app): AsCaller, Path(id): Path<TrajectoryId>) -> Result<Json<TrajectoryView>, Problem> {
    Ok(Json(app.get_trajectory(&id).await?))
}

/// The trajectory as a file: `csv`, `json` or `ros2` (trajectory_msgs/JointTrajectory).
#[utoipa::path(get, path = "/trajectories/{id}:export", operation_id = "exportTrajectory", tag = "trajectories",
    params(("id" = TrajectoryId, Path), TrajectoryParameters),
    responses((status = 200, description = "The file.", body = Binary, content_type = "application/octet-stream"),
        (status = 409, description = "The stored points are damaged: run the job again.")))]
pub async fn export(
    AsCaller(app): AsCaller,
    Path(id): Path<TrajectoryId>,
    Query(wanted): Query<TrajectoryParameters>,
) -> Result<Response, Problem> {
    let TrajectoryParameters { format, prefix, rename, omit_held } = wanted;
    let names = export_names(prefix.unwrap_or_default(), &rename.unwrap_or_default(), omit_held.unwrap_or_default())?;
    Ok(file(app.export_trajectory(&id, &format, names).await?))
}
