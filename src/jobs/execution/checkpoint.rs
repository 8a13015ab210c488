//! Checkpoint of an execution job: the current repetition and its state.

use crate::framework::execution::IetState;
use serde::{Deserialize, Serialize};

/// Format version, incremented whenever the meaning of a checkpoint changes.
const VERSION: u32 = 1;

/// A saved execution job.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Checkpoint {
    version: u32,
    /// Build that wrote it; another build may compute different bits.
    build: String,
    /// Current repetition; earlier ones are stored as runs.
    pub(super) repetition: u32,
    /// Number of evaluations in earlier repetitions.
    pub(super) evaluations_before: u64,
    /// State of the current repetition; `None` at its start.
    pub(super) iet: Option<IetState>,
}

/// Version of the program and its target: equal builds compute equal bits.
fn build() -> String {
    format!("{} {}", env!("CARGO_PKG_VERSION"), std::env::consts::ARCH)
}

impl Checkpoint {
    /// Checkpoint of a job at the start of `repetition`.
    pub(super) fn at_start_of(repetition: u32, evaluations_before: u64) -> Self {
        Self { version: VERSION, build: build(), repetition, evaluations_before, iet: None }
    }

    /// Checkpoint within the repetition.
    pub(super) fn within(&self, iet: IetState) -> Self {
        Self { iet: Some(iet), ..self.clone() }
    }

    /// The stored bytes.
    ///
    /// # Errors
    /// [`serde_json::Error`] for a NaN or an infinite number; no state of a search has one.
    pub(super) fn encode(&self) -> Result<Vec<u8>, serde_json::Error> {
        serde_json::to_vec(self)
    }

    /// Reads a checkpoint; `None` unless this build wrote it for that repetition. The repetition then starts again from
    /// its seed, which takes longer but gives the bits of an uninterrupted run of this build.
    pub(super) fn decode(bytes: &[u8], repetition: u32) -> Option<Self> {
        let found: Self = serde_json::from_slice(bytes).ok()?;
        (found.version == VERSION && found.build == build() && found.repetition == repetition).then_some(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_checkpoint_of_this_build_for_this_repetition_is_used() {
        let saved = Checkpoint::at_start_of(3, 700);
        let bytes = saved.encode().unwrap();
        assert_eq!(Checkpoint::decode(&bytes, 3), Some(saved.clone()));
        assert_eq!(Checkpoint::decode(&bytes, 2), None);
        assert_eq!(Checkpoint::decode(&bytes[1..], 3), None);
        let other = Checkpoint { build: "0.0.1 other".to_owned(), ..saved };
        assert_eq!(Checkpoint::decode(&other.encode().unwrap(), 3), None);
    }
}
