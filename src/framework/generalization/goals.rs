//! The generalized action's matrix X: n intermediate goals of m features.

use crate::Feature;
use crate::range::above;
use serde::{Deserialize, Serialize};

/// n goals (rows) x m features (columns), finite, at least 1 x 1.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "RawGoals", into = "RawGoals")]
pub struct Goals {
    features: Vec<Feature>,
    values: Vec<f64>,
    interval_s: Option<f64>,
}

/// Reasons why rows do not form a matrix of goals.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GoalsError {
    /// There is no goal or no feature.
    #[error("an action needs at least 1 goal of 1 feature, not {goals} goals of {features} features")]
    Empty {
        /// Number of goals found.
        goals: usize,
        /// Number of features found.
        features: usize,
    },
    /// A row has the wrong length.
    #[error("goal {goal} has {found} values for {expected} features")]
    Ragged {
        /// Goal index from 0.
        goal: usize,
        /// Number of values in the row.
        found: usize,
        /// Number of features.
        expected: usize,
    },
    /// A value is NaN or infinite.
    #[error("goal {goal}, feature {feature:?} is {value}, not a finite number")]
    NonFinite {
        /// Goal index from 0.
        goal: usize,
        /// Feature name.
        feature: String,
        /// The non-finite value.
        value: f64,
    },
}

impl Goals {
    /// Builds goals from rows, each with `features.len()` values in the features' units.
    ///
    /// # Errors
    /// [`GoalsError`] names the first goal that breaks a rule.
    pub fn new(features: Vec<Feature>, rows: &[Vec<f64>]) -> Result<Self, GoalsError> {
        if rows.is_empty() || features.is_empty() {
            return Err(GoalsError::Empty { goals: rows.len(), features: features.len() });
        }
        for (goal, row) in rows.iter().enumerate() {
            if row.len() != features.len() {
                return Err(GoalsError::Ragged { goal, found: row.len(), expected: features.len() });
            }
            if let Some((f, &value)) = features.iter().zip(row).find(|(_, v)| !v.is_finite()) {
                return Err(GoalsError::NonFinite { goal, feature: f.name.clone(), value });
            }
        }
        Ok(Self { values: rows.concat(), features, interval_s: None })
    }

    /// The same goals, `interval_s` apart in their demonstrations; `None` if that is unknown. An interval that is not
    /// above 0 and finite counts as unknown.
    #[must_use]
    pub fn spaced(self, interval_s: Option<f64>) -> Self {
        Self { interval_s: interval_s.filter(|interval| above(0.0).contains(*interval)), ..self }
    }

    /// Time between two goals of the demonstrations, s; `None` if it is unknown.
    #[must_use]
    pub fn interval_s(&self) -> Option<f64> {
        self.interval_s
    }

    /// The m features, in column order.
    #[must_use]
    pub fn features(&self) -> &[Feature] {
        &self.features
    }

    /// Number of goals n (at least 1).
    #[must_use]
    pub fn len(&self) -> usize {
        self.values.len() / self.features.len()
    }

    /// Never true: there is at least one goal.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// The m values of goal `index` (from 0).
    #[must_use]
    pub fn row(&self, index: usize) -> &[f64] {
        let m = self.features.len();
        &self.values[index * m..(index + 1) * m]
    }

    /// All values, row-major, goals x features.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Iterates over the rows, one per goal.
    #[must_use]
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.values.chunks_exact(self.features.len())
    }
}

/// Serialized form of [`Goals`]: n rows with one value per feature, and the interval if it is known.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawGoals {
    features: Vec<Feature>,
    goals: Vec<Vec<f64>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    interval_s: Option<f64>,
}

impl TryFrom<RawGoals> for Goals {
    type Error = GoalsError;
    fn try_from(raw: RawGoals) -> Result<Self, GoalsError> {
        Ok(Self::new(raw.features, &raw.goals)?.spaced(raw.interval_s))
    }
}

impl From<Goals> for RawGoals {
    fn from(goals: Goals) -> Self {
        Self {
            goals: goals.rows().map(<[f64]>::to_vec).collect(),
            interval_s: goals.interval_s,
            features: goals.features,
        }
    }
}
