//! Responses that are more than a JSON body: created, accepted, a file, a tagged revision.

use super::API;
use super::extract::Json;
use crate::app::model::{Export, JobView, PageQuery};
use axum::http::StatusCode;
use axum::http::header::{CONTENT_DISPOSITION, CONTENT_TYPE, ETAG, HeaderValue, LOCATION};
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use utoipa::IntoParams;

/// Paging parameters of a list.
#[derive(Debug, Default, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct PageParameters {
    /// Maximum number of items on the page.
    pub page_size: Option<u32>,
    /// `next_page_token` of the previous page.
    pub page_token: Option<String>,
}

impl From<PageParameters> for PageQuery {
    fn from(page: PageParameters) -> Self {
        Self { page_size: page.page_size, page_token: page.page_token }
    }
}

/// Format of an export.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct ExportParameters {
    /// `csv` or `json`; for experiments `csv`, `full_csv` or `markdown`.
    pub format: String,
}

/// 201 with the address of the new resource.
pub fn created<T: Serialize>(collection: &str, id: &str, view: T) -> Response {
    (StatusCode::CREATED, [(LOCATION, format!("{API}/{collection}/{id}"))], Json(view)).into_response()
}

/// 202 with the address of the job that does the work.
pub fn accepted(job: JobView) -> Response {
    (StatusCode::ACCEPTED, [(LOCATION, format!("{API}/jobs/{}", job.id))], Json(job)).into_response()
}

/// 200 with the revision as `ETag`.
pub fn tagged<T: Serialize>(revision: u64, view: T) -> Response {
    ([(ETAG, format!("\"{revision}\""))], Json(view)).into_response()
}

/// A file as a download.
pub fn file(export: Export) -> Response {
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '-' | '_');
    let name: String = export.file_name.chars().map(|c| if plain(c) { c } else { '_' }).collect();
    let disposition = HeaderValue::from_str(&format!("attachment; filename=\"{name}\""))
        .unwrap_or_else(|_| HeaderValue::from_static("attachment"));
    let headers = [(CONTENT_TYPE, HeaderValue::from_static(export.content_type)), (CONTENT_DISPOSITION, disposition)];
    (headers, export.bytes).into_response()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_files_name_cannot_leave_its_header() {
        let export =
            Export { content_type: "text/csv", file_name: "a\"; b\r\n/../ä.csv".to_owned(), bytes: Vec::new() };
        assert_eq!(file(export).headers()[CONTENT_DISPOSITION], "attachment; filename=\"a___b___..__.csv\"");
    }
}
