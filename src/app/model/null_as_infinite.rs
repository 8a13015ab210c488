//! JSON has no infinity: a number stored without a finite value is null, and its row can still be read.

use serde::{Deserialize, Deserializer};

/// One number.
pub(super) fn number<'de, D: Deserializer<'de>>(json: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(json)?.unwrap_or(f64::INFINITY))
}

/// A list of numbers.
pub(super) fn numbers<'de, D: Deserializer<'de>>(json: D) -> Result<Vec<f64>, D::Error> {
    let numbers = Vec::<Option<f64>>::deserialize(json)?;
    Ok(numbers.into_iter().map(|number| number.unwrap_or(f64::INFINITY)).collect())
}

#[cfg(test)]
mod tests {
    use super::super::{ConvergencePoint, EventData, GoalProgress};
    use serde_json::json;

    #[test]
    fn a_stored_null_is_read_and_a_missing_number_is_not() {
        let goal = json!({"repetition": 0, "index": 2, "evaluations": 7, "discrepancy": null,
            "stop_reason": "stagnation", "joints": [0.5], "observation": [null, 1.0]});
        let found: GoalProgress = serde_json::from_value(goal.clone()).unwrap();
        assert_eq!((found.discrepancy, found.observation.as_slice()), (f64::INFINITY, &[f64::INFINITY, 1.0][..]));
        let event = json!({"type": "goal", "goal": goal});
        assert!(matches!(serde_json::from_value(event).unwrap(), EventData::Goal { goal } if goal.index == 2));
        let point = |json| serde_json::from_value::<ConvergencePoint>(json);
        assert!(point(json!({"goal_index": 0, "evaluations": 1, "discrepancy": null})).is_ok());
        assert!(point(json!({"goal_index": 0, "evaluations": 1})).is_err());
    }
}
