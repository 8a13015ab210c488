//! A saved optimiser: JSON under the name of its method, which alone knows the shape.

use super::OptimizerError;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;

/// Memory of an optimiser, under its method's name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(into = "BTreeMap<String, Value>", try_from = "BTreeMap<String, Value>")]
pub struct OptimizerState {
    method: String,
    memory: Value,
}

/// A document that is not one method's state.
#[derive(Debug, thiserror::Error)]
#[error("a saved optimiser is an object with the name of its method as the only key; found {keys} keys")]
pub struct NotOneMethod {
    keys: usize,
}

impl OptimizerState {
    /// The memory of a search by `method`.
    ///
    /// A memory that JSON cannot express is saved as null, which no method reads back.
    #[must_use]
    pub fn of(method: &str, memory: &impl Serialize) -> Self {
        Self { method: method.to_owned(), memory: serde_json::to_value(memory).unwrap_or_default() }
    }

    /// Name of the method it was saved from.
    #[must_use]
    pub fn method(&self) -> &str {
        &self.method
    }

    /// The memory, as `method` saved it.
    ///
    /// # Errors
    /// [`OptimizerError::Method`] for the state of another method, [`OptimizerError::Memory`] if it cannot be read.
    pub fn read<T: DeserializeOwned>(self, method: &'static str) -> Result<T, OptimizerError> {
        if self.method != method {
            return Err(OptimizerError::Method { found: self.method, expected: method });
        }
        serde_json::from_value(self.memory).map_err(|source| OptimizerError::Memory { method, source })
    }
}

impl From<OptimizerState> for BTreeMap<String, Value> {
    fn from(state: OptimizerState) -> Self {
        Self::from([(state.method, state.memory)])
    }
}

impl TryFrom<BTreeMap<String, Value>> for OptimizerState {
    type Error = NotOneMethod;

    fn try_from(document: BTreeMap<String, Value>) -> Result<Self, NotOneMethod> {
        let keys = document.len();
        match document.into_iter().next() {
            Some((method, memory)) if keys == 1 => Ok(Self { method, memory }),
            _ => Err(NotOneMethod { keys }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_state_is_an_object_named_after_its_method() {
        let state = OptimizerState::of("own", &[1.5, 0.1 + 0.2]);
        let text = serde_json::to_string(&state).unwrap();
        assert_eq!(text, r#"{"own":[1.5,0.30000000000000004]}"#);
        assert_eq!(serde_json::from_str::<OptimizerState>(&text).unwrap(), state);
        let error = serde_json::from_str::<OptimizerState>(r#"{"sst":1,"pso":2}"#).unwrap_err().to_string();
        assert!(error.contains("found 2 keys"), "{error}");
    }

    #[test]
    fn only_its_own_method_reads_it() {
        let state = OptimizerState::of("own", &7_u64);
        assert_eq!(state.clone().read::<u64>("own").unwrap(), 7);
        let error = state.clone().read::<u64>("sst").unwrap_err().to_string();
        assert!(error.contains("one of own, the method is sst"), "{error}");
        assert!(state.read::<String>("own").unwrap_err().to_string().contains("cannot be read"));
    }
}
