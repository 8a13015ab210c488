//! State of a particle swarm; saved and resumed as it is.

use super::movement::limited;
use super::spec::SwarmSpec;
use crate::infinite_as_null;
use crate::method::per_goal::incumbent::Incumbent;
use crate::method::per_goal::waiting::Waiting;
use crate::method::per_goal::{OptimizerError, Provenance, SearchSpace, StopReason, Tally};
use crate::random::RandomStream;
use serde::{Deserialize, Serialize};

/// Version of [`SwarmState`]; changes when its meaning does.
pub(super) const STATE_VERSION: u32 = 1;

/// State of a particle swarm. Matrices are row-major, one row per particle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SwarmState {
    pub(super) version: u32,
    pub(super) rng: RandomStream,
    pub(super) x: Vec<f64>,
    pub(super) v: Vec<f64>,
    /// Positions and velocities before the last move.
    pub(super) x_before: Vec<f64>,
    pub(super) v_before: Vec<f64>,
    pub(super) memory: Vec<f64>,
    #[serde(with = "infinite_as_null")]
    pub(super) memory_fitness: Vec<f64>,
    pub(super) observations: Vec<f64>,
    /// Infinite if never executed or failed.
    #[serde(with = "infinite_as_null")]
    pub(super) fitness: Vec<f64>,
    pub(super) provenance: Vec<Provenance>,
    pub(super) waiting: Waiting,
    pub(super) next_id: u64,
    /// 0 while the first positions are evaluated.
    pub(super) generation: u64,
    /// Particles moved in this generation.
    pub(super) moved: usize,
    pub(super) last_change: u64,
    pub(super) hall: Option<Incumbent>,
    pub(super) stop: Option<StopReason>,
    pub(super) tally: Tally,
}

impl SwarmState {
    pub(super) fn new(spec: &SwarmSpec, space: &SearchSpace, seed: u64, stream: u64) -> Self {
        let population = spec.population as usize;
        let mut rng = RandomStream::new(seed, stream);
        let (mut x, mut v, mut memory) = (Vec::new(), Vec::new(), Vec::new());
        for _ in 0..population {
            let limits = || space.lower.iter().zip(&space.upper);
            let start = x.len();
            x.extend(limits().map(|(&low, &high)| rng.between(low, high)));
            let degree = 1.0_f64.to_radians();
            for ((&low, &high), &place) in limits().zip(&x[start..]) {
                v.push(if spec.ecf_velocity_quirk {
                    rng.between(0.0, degree)
                } else {
                    limited(spec, (rng.between(low, high) - place) / 2.0, high - low)
                });
                memory.push(if spec.ecf_memory_quirk { rng.between(0.0, degree) } else { place });
            }
        }
        Self {
            version: STATE_VERSION,
            rng,
            x_before: x.clone(),
            v_before: v.clone(),
            x,
            v,
            memory,
            memory_fitness: vec![f64::INFINITY; population],
            observations: vec![0.0; population * space.features],
            fitness: vec![f64::INFINITY; population],
            provenance: vec![Provenance::Penalised; population],
            waiting: Waiting::first(population),
            next_id: population as u64,
            generation: 0,
            moved: 0,
            last_change: 0,
            hall: None,
            stop: None,
            tally: Tally::default(),
        }
    }

    /// Whether this state was saved from a search of that shape.
    pub(super) fn check(
        &self,
        method: &'static str,
        population: usize,
        space: &SearchSpace,
    ) -> Result<(), OptimizerError> {
        if self.version != STATE_VERSION {
            return Err(OptimizerError::Version { method, found: self.version, expected: STATE_VERSION });
        }
        let (genes, features) = (space.lower.len(), space.features);
        for (what, found, expected) in [
            ("fitness values", self.fitness.len(), population),
            ("remembered fitness values", self.memory_fitness.len(), population),
            ("provenances", self.provenance.len(), population),
            ("genes", self.x.len(), population * genes),
            ("velocities", self.v.len(), population * genes),
            ("earlier genes", self.x_before.len(), population * genes),
            ("earlier velocities", self.v_before.len(), population * genes),
            ("remembered genes", self.memory.len(), population * genes),
            ("observed values", self.observations.len(), population * features),
            ("waiting particles", self.waiting.within(population), self.waiting.len()),
            ("moved particles", self.moved.min(population), self.moved),
            ("genes of the best", self.hall.as_ref().map_or(genes, |h| h.joints.len()), genes),
            ("features of the best", self.hall.as_ref().map_or(features, |h| h.observation.len()), features),
        ] {
            if found != expected {
                return Err(OptimizerError::Shape { method, what, found, expected });
            }
        }
        Ok(())
    }
}
