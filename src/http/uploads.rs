//! `POST /demonstrations`: one file as the raw body, or several recorded together as `multipart/form-data`.
//!
//! The body is counted while it streams in: one byte above the limit answers 413, whatever its declared length.

use super::answer::created;
use super::body;
use super::extract::{AsCaller, Query, unsupported};
use super::openapi::Binary;
use super::problem::Problem;
use crate::app::model::{
    AppError, DemonstrationView, ErrorKind, FieldError, UploadDemonstration, UploadFile, UploadOptions, limits,
};
use crate::framework::Feature;
use crate::framework::demonstration::{ClockPolicy, Format};
use axum::extract::multipart::{Field, Multipart};
use axum::extract::{FromRequest as _, Request};
use axum::http::header::{CONTENT_ENCODING, CONTENT_TYPE};
use axum::response::Response;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use utoipa::{IntoParams, ToSchema};

/// Treatment of the upload; a form's fields of the same names take precedence.
#[derive(Debug, Default, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct UploadParameters {
    /// Display name; derived from the file name if absent.
    name: Option<String>,
    /// File name of a raw body; it names the stream.
    file_name: Option<String>,
    /// Format of the files; recognized from the content if absent.
    #[param(value_type = Option<Format>)]
    format: Option<String>,
    /// Treatment of clocks that disagree; `as_recorded` if absent.
    #[param(value_type = Option<ClockPolicy>)]
    clock_policy: Option<String>,
    /// Name of the time column; `time`, `time_s`, `t` or `timestamp` if absent.
    time_column: Option<String>,
    /// Names of the features of files without a header, in column order, separated by commas.
    features: Option<String>,
    /// Units by feature name, `x=m,force=N`.
    units: Option<String>,
}

/// An upload of several files.
#[derive(ToSchema)]
#[expect(dead_code, reason = "documents the form, which is read field by field")]
pub struct UploadForm {
    /// Files that were recorded together; the name of each file is the name of its stream.
    #[schema(value_type = Vec<String>, format = Binary)]
    files: Vec<String>,
    /// Display name.
    name: Option<String>,
    /// Format of the files; recognized from the content if absent.
    format: Option<Format>,
    /// Treatment of clocks that disagree; `as_recorded` if absent.
    clock_policy: Option<ClockPolicy>,
    /// Name of the time column; `time`, `time_s`, `t` or `timestamp` if absent.
    time_column: Option<String>,
    /// Names of the features of files without a header, in column order, separated by commas.
    features: Option<String>,
    /// Units by feature name, `x=m,force=N`.
    units: Option<String>,
}

/// Uploads a demonstration. Each error names the stream, row and column that make a file unusable.
#[utoipa::path(post, path = "/demonstrations", operation_id = "uploadDemonstration", tag = "demonstrations",
    params(UploadParameters),
    request_body(description = "The file, whatever its content type, or a form with several.", content(
        (Binary = "application/octet-stream"), (UploadForm = "multipart/form-data"))),
    responses((status = 201, description = "The demonstration.", body = DemonstrationView)))]
pub async fn create(
    AsCaller(app): AsCaller,
    Query(parameters): Query<UploadParameters>,
    request: Request,
) -> Result<Response, Problem> {
    let upload = receive(request, parameters, app.upload_limit_bytes()).await?;
    let view = app.upload_demonstration(upload).await?;
    Ok(created("demonstrations", view.id.clone().as_str(), view))
}

async fn receive(
    request: Request,
    mut parameters: UploadParameters,
    limit: usize,
) -> Result<UploadDemonstration, Problem> {
    let headers = request.headers();
    if let Some(encoding) = headers.get(CONTENT_ENCODING) {
        return Err(unsupported(encoding.to_str().unwrap_or(""), "the body without content encoding"));
    }
    let form = headers.get(CONTENT_TYPE).is_some_and(|v| v.as_bytes().starts_with(b"multipart/"));
    let files = if form {
        let form = Multipart::from_request(request, &()).await;
        let form = form.map_err(|rejection| body::unreadable(&rejection.body_text()))?;
        files(form, &mut parameters, limit).await?
    } else {
        let file_name = parameters.file_name.clone().or_else(|| parameters.name.clone());
        let bytes = body::read(request, limit).await?;
        vec![UploadFile { file_name: file_name.unwrap_or_else(|| "demonstration".to_owned()), bytes }]
    };
    let options = options(&parameters)?;
    Ok(UploadDemonstration { name: parameters.name, files, options })
}

async fn files(
    mut form: Multipart,
    parameters: &mut UploadParameters,
    limit: usize,
) -> Result<Vec<UploadFile>, AppError> {
    let mut files: Vec<UploadFile> = Vec::new();
    let (mut left, most) = (limit, *limits::UPLOAD_FILES.end() as usize);
    while let Some(field) = form.next_field().await.map_err(|error| body::unreadable(&error.body_text()))? {
        if let Some(file_name) = field.file_name().map(str::to_owned) {
            if files.len() == most {
                let message = format!("an upload has at most {most} files");
                return Err(AppError::new(ErrorKind::TooLarge, "too_many_files", message));
            }
            let bytes = field_bytes(field, left).await?.ok_or_else(|| body::too_large(limit))?;
            left -= bytes.len();
            files.push(UploadFile { file_name, bytes });
        } else {
            let name = field.name().unwrap_or("").to_owned();
            let bytes = field_bytes(field, limits::MAX_FIELD_BYTES)
                .await?
                .ok_or_else(|| body::too_large(limits::MAX_FIELD_BYTES))?;
            let text =
                String::from_utf8(bytes).map_err(|_| field_error(&name, "not_utf8", "the field is not UTF-8"))?;
            *parameter(parameters, &name)? = Some(text);
        }
    }
    Ok(files)
}

/// The field's bytes; `None` if there are more than `limit`.
async fn field_bytes(mut field: Field<'_>, limit: usize) -> Result<Option<Vec<u8>>, AppError> {
    let mut bytes = Vec::new();
    while let Some(chunk) = field.chunk().await.map_err(|error| body::unreadable(&error.body_text()))? {
        if bytes.len() + chunk.len() > limit {
            return Ok(None);
        }
        bytes.extend_from_slice(&chunk);
    }
    Ok(Some(bytes))
}

fn parameter<'a>(parameters: &'a mut UploadParameters, name: &str) -> Result<&'a mut Option<String>, AppError> {
    Ok(match name {
        "name" => &mut parameters.name,
        "format" => &mut parameters.format,
        "clock_policy" => &mut parameters.clock_policy,
        "time_column" => &mut parameters.time_column,
        "features" => &mut parameters.features,
        "units" => &mut parameters.units,
        _ => {
            let detail = "the form has no such field: give name, format, clock_policy, time_column, features or units; a \
                          file needs a file name";
            return Err(field_error(name, "unknown_field", detail));
        }
    })
}

fn options(parameters: &UploadParameters) -> Result<UploadOptions, AppError> {
    let list = |text: &str| text.split(',').map(|name| name.trim().to_owned()).collect::<Vec<_>>();
    let unit = |pair: String| {
        let (name, unit) = pair
            .split_once('=')
            .ok_or_else(|| field_error("units", "invalid_value", &format!("{pair:?} is not FEATURE=UNIT")))?;
        Ok::<_, AppError>((name.trim().to_owned(), unit.trim().to_owned()))
    };
    let features = parameters.features.as_deref().map(list).unwrap_or_default();
    let units = parameters.units.as_deref().filter(|text| !text.is_empty()).map(list).unwrap_or_default();
    Ok(UploadOptions {
        format: parameters.format.as_deref().map(|text| choice("format", text)).transpose()?,
        clock_policy: parameters
            .clock_policy
            .as_deref()
            .map_or(Ok(ClockPolicy::default()), |text| choice("clock_policy", text))?,
        time_column: parameters.time_column.clone(),
        features: features.into_iter().map(|name| Feature::new(name, "")).collect(),
        units: units.into_iter().map(unit).collect::<Result<_, _>>()?,
        ..UploadOptions::default()
    })
}

/// One of the names that the type has in JSON.
fn choice<T: DeserializeOwned>(name: &str, text: &str) -> Result<T, AppError> {
    serde_json::from_value(serde_json::Value::from(text))
        .map_err(|error| field_error(name, "invalid_value", &error.to_string()))
}

fn field_error(name: &str, code: &str, detail: &str) -> AppError {
    AppError::invalid(vec![FieldError::new(format!("/{name}"), code, detail)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use axum::body::Body;
    use axum::http::header::CONTENT_LENGTH;

    async fn read(request: axum::http::request::Builder, body: impl Into<Body>) -> Result<UploadDemonstration, u16> {
        let request = request.uri("/").body(body.into()).unwrap();
        receive(request, UploadParameters::default(), 100).await.map_err(|problem| problem.status.as_u16())
    }

    #[tokio::test]
    async fn a_raw_body_is_one_file_up_to_the_limit() {
        let upload = read(Request::builder(), "t,x\n0,1\n").await.unwrap();
        assert_eq!((upload.files.len(), upload.files[0].bytes.as_slice()), (1, &b"t,x\n0,1\n"[..]));
        assert!(read(Request::builder(), "x".repeat(100)).await.is_ok());
        assert_eq!(read(Request::builder(), "x".repeat(101)).await, Err(413));
        let declared = Request::builder().header(CONTENT_LENGTH, 101);
        assert_eq!(read(declared, "short").await, Err(413));
        let chunks = futures_util::stream::iter((0..11).map(|_| Ok::<_, std::io::Error>("0123456789")));
        assert_eq!(read(Request::builder(), Body::from_stream(chunks)).await, Err(413));
        assert_eq!(read(Request::builder().header(CONTENT_ENCODING, "gzip"), "x").await, Err(415));
    }

    #[tokio::test]
    async fn a_form_holds_several_files_and_the_options() {
        let form = |parts: &[(&str, &str)]| {
            let part = |(head, body): &(&str, &str)| {
                format!("--B\r\ncontent-disposition: form-data; {head}\r\n\r\n{body}\r\n")
            };
            parts.iter().map(part).collect::<String>() + "--B--\r\n"
        };
        let request = || Request::builder().header(CONTENT_TYPE, "multipart/form-data; boundary=B");
        let good = [
            ("name=\"files\"; filename=\"a.csv\"", "1"),
            ("name=\"files\"; filename=\"b.csv\"", "2"),
            ("name=\"units\"", "x=m, f = N"),
            ("name=\"name\"", "both"),
        ];
        let upload = read(request(), form(&good)).await.unwrap();
        assert_eq!((upload.files.len(), upload.name.as_deref()), (2, Some("both")));
        assert_eq!(upload.options.units["f"], "N");
        assert_eq!(read(request(), form(&[("name=\"nmae\"", "x")])).await, Err(422));
        assert_eq!(read(request(), form(&[("name=\"units\"", "x")])).await, Err(422));
        let long = "x".repeat(60);
        let two = [("name=\"f\"; filename=\"a\"", long.as_str()), ("name=\"f\"; filename=\"b\"", long.as_str())];
        assert_eq!(read(request(), form(&two)).await, Err(413));
        assert_eq!(read(request(), "no form").await, Err(400));
    }
}
