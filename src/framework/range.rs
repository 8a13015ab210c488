//! Limits of a number, as a check, as words and as data: every number that a user sets is checked here, so that all
//! refusals read alike.

use serde::Serialize;
use std::fmt;
use std::ops::{RangeFrom, RangeInclusive};

/// Limits of a finite number; a limit that is absent does not bind.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
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
#[error("{parameter} is {}: give {range}{}", plain(*value), unit.map(|unit| format!(" {unit}")).unwrap_or_default())]
pub struct OutOfRange {
    /// Name of the parameter, as users write it.
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

    /// # Errors
    /// [`OutOfRange`] with the first of `values` that is outside.
    pub fn check_each(
        &self,
        parameter: &'static str,
        unit: Option<&'static str>,
        values: &[f64],
    ) -> Result<(), OutOfRange> {
        values.iter().try_for_each(|&value| self.check(parameter, unit, value))
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
        let [minimum, exclusive, maximum] =
            [self.minimum, self.exclusive_minimum, self.maximum].map(|limit| limit.map(plain));
        match (minimum, exclusive, maximum) {
            (_, Some(least), Some(most)) => write!(f, "more than {least} and at most {most}"),
            (_, Some(least), None) => write!(f, "more than {least}"),
            (Some(least), None, Some(most)) => write!(f, "{least} to {most}"),
            (Some(least), None, None) => write!(f, "at least {least}"),
            (None, None, Some(most)) => write!(f, "at most {most}"),
            (None, None, None) => f.write_str("a finite number"),
        }
    }
}

/// The number without a trailing `.0`, and with an exponent rather than a row of zeros.
pub(crate) fn plain(value: f64) -> String {
    let text = format!("{value:?}");
    text.strip_suffix(".0").map(str::to_owned).unwrap_or(text)
}

#[cfg(test)]
mod tests {
    use super::{Range, above};
    use rstest::rstest;

    #[rstest]
    #[case(Range::from(3..=100), 2.0, Some("size is 2: give 3 to 100 m"))]
    #[case(Range::from(3..=100), 3.0, None)]
    #[case(Range::from(0.0..), f64::NAN, Some("size is NaN: give at least 0 m"))]
    #[case(above(0.0), 0.0, Some("size is 0: give more than 0 m"))]
    #[case(above(0.0).up_to(0.5), 1e300, Some("size is 1e300: give more than 0 and at most 0.5 m"))]
    fn refusals_name_the_number_and_the_range(#[case] range: Range, #[case] value: f64, #[case] told: Option<&str>) {
        let refusal = range.check("size", Some("m"), value).err().map(|error| error.to_string());
        assert_eq!(refusal.as_deref(), told);
    }

    #[test]
    fn the_first_of_several_numbers_outside_is_named() {
        assert_eq!(Range::default().check_each("offset", None, &[-1e300, 0.0]), Ok(()));
        let refusal = Range::default().check_each("offset", None, &[0.0, f64::INFINITY, f64::NAN]).unwrap_err();
        assert_eq!(refusal.to_string(), "offset is inf: give a finite number");
    }
}
