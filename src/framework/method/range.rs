//! Limits of a number, as a check, as words and as data.

use serde::Serialize;
use std::fmt;
use std::ops::{RangeFrom, RangeInclusive};
use utoipa::ToSchema;

/// Limits of a finite number; a limit that is absent does not bind.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, ToSchema)]
pub struct Range {
    /// Least value allowed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub minimum: Option<f64>,
    /// Every value must be above this one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exclusive_minimum: Option<f64>,
    /// Largest value allowed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub maximum: Option<f64>,
}

/// A number outside its range.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("{parameter} is {value}: give {range}{}", unit.map(|unit| format!(" {unit}")).unwrap_or_default())]
pub struct OutOfRange {
    /// Name of the parameter.
    pub parameter: &'static str,
    /// The value given.
    pub value: f64,
    /// The range it must keep to.
    pub range: Range,
    /// Unit of both.
    pub unit: Option<&'static str>,
}

/// The numbers above `least`.
#[must_use]
pub fn above(least: f64) -> Range {
    Range { exclusive_minimum: Some(least), ..Range::default() }
}

impl Range {
    /// The same numbers up to `most`.
    #[must_use]
    pub fn up_to(self, most: f64) -> Self {
        Self { maximum: Some(most), ..self }
    }

    /// This range, with the limits of `other` where it has none.
    #[must_use]
    pub fn or(self, other: RangeInclusive<u32>) -> Self {
        let minimum = if self.exclusive_minimum.is_some() { None } else { Some(f64::from(*other.start())) };
        Self { minimum: self.minimum.or(minimum), maximum: self.maximum.or(Some(f64::from(*other.end()))), ..self }
    }

    /// Whether `value` is finite and inside.
    #[must_use]
    pub fn contains(&self, value: f64) -> bool {
        value.is_finite()
            && self.minimum.is_none_or(|least| value >= least)
            && self.exclusive_minimum.is_none_or(|least| value > least)
            && self.maximum.is_none_or(|most| value <= most)
    }

    /// # Errors
    /// [`OutOfRange`] with all its numbers if `value` is outside.
    pub fn check(&self, parameter: &'static str, unit: Option<&'static str>, value: f64) -> Result<(), OutOfRange> {
        if self.contains(value) {
            return Ok(());
        }
        Err(OutOfRange { parameter, value, range: *self, unit })
    }
}

impl From<RangeInclusive<i32>> for Range {
    fn from(range: RangeInclusive<i32>) -> Self {
        Self::from(f64::from(*range.start())..=f64::from(*range.end()))
    }
}

impl From<RangeInclusive<f64>> for Range {
    fn from(range: RangeInclusive<f64>) -> Self {
        Self { minimum: Some(*range.start()), maximum: Some(*range.end()), ..Self::default() }
    }
}

impl From<RangeFrom<f64>> for Range {
    fn from(range: RangeFrom<f64>) -> Self {
        Self { minimum: Some(range.start), ..Self::default() }
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.minimum, self.exclusive_minimum, self.maximum) {
            (_, Some(least), Some(most)) => write!(f, "more than {least} and at most {most}"),
            (_, Some(least), None) => write!(f, "more than {least}"),
            (Some(least), None, Some(most)) => write!(f, "{least} to {most}"),
            (Some(least), None, None) => write!(f, "at least {least}"),
            (None, None, Some(most)) => write!(f, "at most {most}"),
            (None, None, None) => f.write_str("a finite number"),
        }
    }
}
