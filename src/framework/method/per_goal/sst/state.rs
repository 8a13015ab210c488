//! State of the steady-state tournament; saved and resumed as it is.

use super::spec::SstSpec;
use crate::infinite_as_null;
use crate::method::per_goal::incumbent::Incumbent;
use crate::method::per_goal::waiting::Waiting;
use crate::method::per_goal::{OptimizerError, Provenance, SearchSpace, StopReason};
use crate::random::RandomStream;
use serde::{Deserialize, Serialize};

/// Version of [`SstState`]; changes when its meaning does.
pub(super) const STATE_VERSION: u32 = 1;

/// State of the steady-state tournament. Matrices are row-major, one row per individual.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SstState {
    pub(super) version: u32,
    pub(super) rng: RandomStream,
    pub(super) joints: Vec<f64>,
    pub(super) observations: Vec<f64>,
    /// Infinite if never executed or failed.
    #[serde(with = "infinite_as_null")]
    pub(super) fitness: Vec<f64>,
    pub(super) provenance: Vec<Provenance>,
    pub(super) waiting: Waiting,
    /// While a child waits: the n genes it overwrote, then those of its two parents.
    pub(super) family: Vec<f64>,
    pub(super) next_id: u64,
    pub(super) generation: u64,
    pub(super) iteration: u32,
    pub(super) last_change: u64,
    pub(super) hall: Option<Incumbent>,
    pub(super) stop: Option<StopReason>,
}

impl SstState {
    pub(super) fn new(population: usize, space: &SearchSpace, seed: u64, stream: u64) -> Self {
        let mut rng = RandomStream::new(seed, stream);
        let limits = || space.lower.iter().zip(&space.upper);
        let joints = (0..population).flat_map(|_| limits()).map(|(&low, &high)| rng.between(low, high)).collect();
        Self {
            version: STATE_VERSION,
            joints,
            rng,
            observations: vec![0.0; population * space.features],
            fitness: vec![f64::INFINITY; population],
            provenance: vec![Provenance::Penalised; population],
            waiting: Waiting::first(population),
            family: vec![0.0; 3 * space.lower.len()],
            next_id: population as u64,
            generation: 0,
            iteration: 0,
            last_change: 0,
            hall: None,
            stop: None,
        }
    }

    /// Whether this state was saved from a search of that shape.
    pub(super) fn check(&self, population: usize, space: &SearchSpace) -> Result<(), OptimizerError> {
        if self.version != STATE_VERSION {
            return Err(OptimizerError::Version {
                method: SstSpec::NAME,
                found: self.version,
                expected: STATE_VERSION,
            });
        }
        for (what, found, expected) in [
            ("fitness values", self.fitness.len(), population),
            ("provenances", self.provenance.len(), population),
            ("genes", self.joints.len(), population * space.lower.len()),
            ("observed values", self.observations.len(), population * space.features),
            ("genes of a family", self.family.len(), 3 * space.lower.len()),
            ("waiting individuals", self.waiting.within(population), self.waiting.len()),
            ("genes of the best", self.hall.as_ref().map_or(space.lower.len(), |h| h.joints.len()), space.lower.len()),
            (
                "features of the best",
                self.hall.as_ref().map_or(space.features, |h| h.observation.len()),
                space.features,
            ),
        ] {
            if found != expected {
                return Err(OptimizerError::Shape { method: SstSpec::NAME, what, found, expected });
            }
        }
        Ok(())
    }
}
