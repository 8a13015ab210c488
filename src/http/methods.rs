//! `/methods`: the methods with which a job can search.

use super::extract::{AsCaller, Json};
use crate::app::model::MethodList;

/// All methods with their parameters and their requirements on a world.
#[utoipa::path(get, path = "/methods", operation_id = "listMethods", tag = "methods",
    responses((status = 200, description = "The catalogue.", body = MethodList)))]
pub async fn list(AsCaller(app): AsCaller) -> Json<MethodList> {
    Json(app.list_methods())
}
