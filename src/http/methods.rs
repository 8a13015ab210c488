//! `/methods`: what a job can search with.

use super::extract::{AsCaller, Json};
use crate::app::model::MethodList;

/// All methods, with what they need of a world and their parameters.
#[utoipa::path(get, path = "/methods", operation_id = "listMethods", tag = "methods",
    responses((status = 200, description = "The catalogue.", body = MethodList)))]
pub async fn list(AsCaller(app): AsCaller) -> Json<MethodList> {
    Json(app.list_methods())
}
