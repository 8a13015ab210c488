//! State of CMA-ES; saved and resumed as it is.

use super::distribution::Distribution;
use super::spec::CmaEsSpec;
use crate::infinite_as_null;
use crate::method::per_goal::incumbent::Incumbent;
use crate::method::per_goal::waiting::Waiting;
use crate::method::per_goal::{OptimizerError, Provenance, SearchSpace, StopReason};
use crate::random::RandomStream;
use serde::{Deserialize, Serialize};

/// Version of [`CmaEsState`]; changes when its meaning does.
pub(super) const STATE_VERSION: u32 = 1;

/// State of CMA-ES. Matrices are row-major, one row per candidate of the present generation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CmaEsState {
    pub(super) version: u32,
    pub(super) rng: RandomStream,
    pub(super) distribution: Distribution,
    /// Executed joints, rad or m.
    pub(super) joints: Vec<f64>,
    /// Infinite if unknown or failed.
    #[serde(with = "infinite_as_null")]
    pub(super) fitness: Vec<f64>,
    pub(super) waiting: Waiting,
    pub(super) next_id: u64,
    pub(super) generation: u64,
    /// The generation in which the present search began, and the one in which it last improved.
    pub(super) began: u64,
    pub(super) improved: u64,
    /// Best fitness of the present search; `None` before the first.
    pub(super) run_best: Option<f64>,
    pub(super) restarts: u32,
    /// Whether the present search began at the previous goal's result.
    pub(super) warm: bool,
    pub(super) hall: Option<Incumbent>,
    pub(super) stop: Option<StopReason>,
}

impl CmaEsState {
    pub(super) fn new(rng: RandomStream, distribution: Distribution, warm: bool) -> Self {
        Self {
            version: STATE_VERSION,
            rng,
            distribution,
            joints: Vec::new(),
            fitness: Vec::new(),
            waiting: Waiting::default(),
            next_id: 0,
            generation: 0,
            began: 0,
            improved: 0,
            run_best: None,
            restarts: 0,
            warm,
            hall: None,
            stop: None,
        }
    }

    /// Whether the candidate enters the hall of fame: the best so far, executed ones before penalties.
    pub(super) fn enter(&mut self, joints: Vec<f64>, fitness: f64, observation: &[f64], provenance: Provenance) {
        let better = |hall: &Incumbent| match (provenance.is_executed(), hall.provenance.is_executed()) {
            (true, false) => true,
            (false, true) => false,
            _ => fitness < hall.fitness,
        };
        if self.hall.as_ref().is_none_or(better) {
            self.hall = Some(Incumbent { joints, observation: observation.to_vec(), fitness, provenance });
        }
    }

    /// Whether this state was saved from a search of that shape.
    pub(super) fn check(&self, lambda: usize, space: &SearchSpace) -> Result<(), OptimizerError> {
        if self.version != STATE_VERSION {
            let (found, expected) = (self.version, STATE_VERSION);
            return Err(OptimizerError::Version { method: CmaEsSpec::NAME, found, expected });
        }
        let n = space.lower.len();
        let hall = self.hall.as_ref();
        for (what, found, expected) in [
            ("fitness values", self.fitness.len(), lambda),
            ("genes", self.joints.len(), lambda * n),
            ("genes of the mean", self.distribution.mean.len(), n),
            ("covariances", self.distribution.covariance.len(), n * n),
            ("genes of a path", self.distribution.path_sigma.len().max(self.distribution.path_c.len()), n),
            ("waiting candidates", self.waiting.within(lambda), self.waiting.len()),
            ("genes of the best", hall.map_or(n, |h| h.joints.len()), n),
            ("features of the best", hall.map_or(space.features, |h| h.observation.len()), space.features),
        ] {
            if found != expected {
                return Err(OptimizerError::Shape { method: CmaEsSpec::NAME, what, found, expected });
            }
        }
        Ok(())
    }
}
