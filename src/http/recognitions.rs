//! `/recognitions`: finds the action that an observation shows, if any.

use super::extract::{AsCaller, Json};
use super::problem::Problem;
use crate::app::model::{RecognitionView, RecognizeRequest};

/// Ranks actions by their discrepancy from an observation.
#[utoipa::path(post, path = "/recognitions", operation_id = "recognize", tag = "recognitions",
    request_body = RecognizeRequest,
    responses((status = 200, description = "Candidates, best first.", body = RecognitionView)))]
pub async fn create(
    AsCaller(app): AsCaller,
    Json(request): Json<RecognizeRequest>,
) -> Result<Json<RecognitionView>, Problem> {
    Ok(Json(app.recognize(request).await?))
}
