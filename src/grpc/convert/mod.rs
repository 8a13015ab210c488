//! Between messages and the service's own types: one file per resource; here what several share.
//!
//! # Architecture Invariants
//! - A conversion takes its source apart without `..` and names every field of its result: a new field does not compile
//!   until it is converted.
//! - A message is checked where JSON would have been: ids, enumerations, lengths of vectors, finite numbers.
//! - An error names the JSON pointer that the same field has over HTTP.

mod action;
mod catalogue;
mod constraint;
pub mod demonstration;
mod enumeration;
mod event;
pub mod experiment;
mod experiment_view;
pub mod file;
pub mod job;
mod json;
mod method;
mod planning;
pub mod recognition;
pub mod robot;
mod run;
pub mod trajectory;
pub mod work;
pub mod world;

use super::proto;
use crate::app::model::{AppError, ErrorKind, FieldError, IdError, Page, PageQuery, Timestamp};
use crate::framework::Feature;
use std::str::FromStr;

/// The id that names the resource of a call; a malformed one is not found, exactly like an unknown one.
pub fn resource<T: FromStr<Err = IdError>>(text: &str) -> Result<T, AppError> {
    text.parse().map_err(|error: IdError| AppError::new(ErrorKind::NotFound, "not_found", error.to_string()))
}

/// Id inside a request.
pub fn reference<T: FromStr<Err = IdError>>(pointer: &str, text: &str) -> Result<T, AppError> {
    text.parse().map_err(|error: IdError| AppError::field(pointer, "invalid_value", error.to_string()))
}

/// Ids inside a request.
pub fn references<T: FromStr<Err = IdError>>(pointer: &str, texts: &[String]) -> Result<Vec<T>, AppError> {
    texts.iter().enumerate().map(|(i, text)| reference(&format!("{pointer}/{i}"), text)).collect()
}

/// A message that is required.
pub fn required<T>(pointer: &str, value: Option<T>) -> Result<T, AppError> {
    value.ok_or_else(|| AppError::field(pointer, "missing", "this field is required"))
}

/// A number that JSON could represent.
pub fn finite(pointer: &str, value: f64) -> Result<f64, AppError> {
    if value.is_finite() {
        return Ok(value);
    }
    Err(AppError::field(pointer, "non_finite", format!("{value} is not a finite number")))
}

/// A number that JSON could hold, if there is one.
pub fn finite_or_none(pointer: &str, value: Option<f64>) -> Result<Option<f64>, AppError> {
    value.map(|value| finite(pointer, value)).transpose()
}

/// Three coordinates.
pub fn triple(pointer: &str, values: &[f64]) -> Result<[f64; 3], AppError> {
    let found: [f64; 3] = values.try_into().map_err(|_| {
        AppError::field(pointer, "invalid_length", format!("{} values, but 3 are needed: x, y, z", values.len()))
    })?;
    values.iter().try_for_each(|value| finite(pointer, *value).map(drop))?;
    Ok(found)
}

/// Rows of finite numbers.
pub fn rows(pointer: &str, rows: Vec<proto::Row>) -> Result<Vec<Vec<f64>>, AppError> {
    let row = |(i, row): (usize, proto::Row)| {
        row.values.iter().enumerate().try_for_each(|(j, value)| {
            let place = format!("{pointer}/{i}/{j}");
            finite(&place, *value).map(drop)
        })?;
        Ok(row.values)
    };
    rows.into_iter().enumerate().map(row).collect()
}

/// Treats an empty text as absent.
pub fn text(value: String) -> Option<String> {
    if value.is_empty() { None } else { Some(value) }
}

/// Treats an empty list as absent.
pub fn list<T>(values: Vec<T>) -> Option<Vec<T>> {
    if values.is_empty() { None } else { Some(values) }
}

/// A page of a list; a size of 0 is absent.
pub fn page(page_size: u32, page_token: String) -> PageQuery {
    PageQuery { page_size: if page_size == 0 { None } else { Some(page_size) }, page_token: text(page_token) }
}

/// Items and next token of a page.
pub fn items<T, M: From<T>>(page: Page<T>) -> (Vec<M>, String) {
    let Page { items, next_page_token } = page;
    (all(items), next_page_token)
}

/// A point in time.
pub fn time(time: Timestamp) -> prost_types::Timestamp {
    let Timestamp(ms) = time;
    // 0 to 999 ms
    let nanos = i32::try_from(ms.rem_euclid(1000)).unwrap_or_default() * 1_000_000;
    prost_types::Timestamp { seconds: ms.div_euclid(1000), nanos }
}

impl From<Feature> for proto::Feature {
    fn from(feature: Feature) -> Self {
        let Feature { name, unit } = feature;
        Self { name, unit }
    }
}

impl From<proto::Feature> for Feature {
    fn from(feature: proto::Feature) -> Self {
        let proto::Feature { name, unit } = feature;
        Self { name, unit }
    }
}

impl From<Vec<f64>> for proto::Row {
    fn from(values: Vec<f64>) -> Self {
        Self { values }
    }
}

impl From<FieldError> for proto::FieldError {
    fn from(error: FieldError) -> Self {
        let FieldError { pointer, code, detail } = error;
        Self { pointer, code, detail }
    }
}

/// Converts every value into its message.
pub fn all<T, M: From<T>>(values: Vec<T>) -> Vec<M> {
    values.into_iter().map(M::from).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::model::JobId;

    #[test]
    fn what_json_could_not_hold_is_refused_at_its_pointer() {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let error = rows("/rows", vec![vec![0.0].into(), vec![1.0, value].into()]).unwrap_err();
            assert_eq!((error.kind, error.details[0].pointer.as_str()), (ErrorKind::Invalid, "/rows/1/1"));
            assert!(triple("/origin_m", &[0.0, value, 0.0]).is_err());
        }
        assert!(triple("/origin_m", &[0.0, 1.0]).is_err());
        assert_eq!(format!("{:?}", triple("/origin_m", &[0.0, 1.0, -2.0]).unwrap()), "[0.0, 1.0, -2.0]");
    }

    #[test]
    fn an_id_of_a_call_is_not_found_and_one_in_a_request_is_invalid() {
        assert_eq!(resource::<JobId>("nobody").unwrap_err().kind, ErrorKind::NotFound);
        assert_eq!(reference::<JobId>("/job", "nobody").unwrap_err().kind, ErrorKind::Invalid);
    }

    #[test]
    fn a_time_before_1970_has_a_positive_fraction() {
        for (ms, seconds, nanos) in [(0, 0, 0), (1_500, 1, 500_000_000), (-1, -1, 999_000_000), (-1_000, -1, 0)] {
            let found = time(Timestamp(ms));
            assert_eq!((found.seconds, found.nanos), (seconds, nanos));
        }
    }
}
