//! JSON has no infinity: a number that is not finite is written as null, and null is read as infinity.
//!
//! `#[serde(with = "infinite_as_null")]` for a list, `#[serde(with = "infinite_as_null::number")]` for one number. A
//! number that is missing is an error, not infinity.

use serde::{Deserialize, Deserializer, Serializer};

/// Writes a list.
///
/// # Errors
/// Those of the serializer.
pub fn serialize<S: Serializer>(values: &[f64], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(values.iter().map(|v| v.is_finite().then_some(*v)))
}

/// Reads a list.
///
/// # Errors
/// Anything but a list of numbers and nulls.
pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<f64>, D::Error> {
    let values = Vec::<Option<f64>>::deserialize(deserializer)?;
    Ok(values.into_iter().map(|v| v.unwrap_or(f64::INFINITY)).collect())
}

/// One number.
pub mod number {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    /// Writes a number.
    ///
    /// # Errors
    /// Those of the serializer.
    pub fn serialize<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        value.is_finite().then_some(*value).serialize(serializer)
    }

    /// Reads a number.
    ///
    /// # Errors
    /// Anything but a number or null.
    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        Ok(Option::deserialize(deserializer)?.unwrap_or(f64::INFINITY))
    }
}

#[cfg(test)]
mod tests {
    #[derive(Debug, PartialEq, serde::Serialize, serde::Deserialize)]
    struct Goal {
        #[serde(with = "super::number")]
        discrepancy: f64,
        #[serde(with = "super")]
        observation: Vec<f64>,
    }

    #[test]
    fn infinity_is_null_and_back_and_a_missing_number_is_an_error() {
        let goal = Goal { discrepancy: f64::INFINITY, observation: vec![f64::INFINITY, 0.1 + 0.2] };
        let text = serde_json::to_string(&goal).unwrap();
        assert_eq!(text, r#"{"discrepancy":null,"observation":[null,0.30000000000000004]}"#);
        assert_eq!(serde_json::from_str::<Goal>(&text).unwrap(), goal);
        assert!(serde_json::from_str::<Goal>(r#"{"observation":[]}"#).is_err());
    }
}
