//! The hall of fame: the best individual over all generations.

use super::{Best, Provenance};
use serde::{Deserialize, Serialize};

/// The best individual so far, kept whole: joints (rad or m), observation and fitness (features' unit).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Incumbent {
    pub joints: Vec<f64>,
    pub observation: Vec<f64>,
    pub fitness: f64,
    pub provenance: Provenance,
}

impl Incumbent {
    pub fn as_best(&self) -> Best<'_> {
        Best {
            joints: &self.joints,
            fitness: self.fitness,
            observation: &self.observation,
            provenance: self.provenance,
        }
    }

    /// The better of the hall of fame and the current population's best; the former on ties.
    pub fn or_better<'a>(hall: Option<&'a Self>, current: Option<Best<'a>>) -> Option<Best<'a>> {
        match (hall.map(Self::as_best), current) {
            (Some(hall), Some(current)) => Some(if current.fitness < hall.fitness { current } else { hall }),
            (hall, current) => hall.or(current),
        }
    }
}

impl From<Best<'_>> for Incumbent {
    fn from(best: Best<'_>) -> Self {
        Self {
            joints: best.joints.to_vec(),
            observation: best.observation.to_vec(),
            fitness: best.fitness,
            provenance: best.provenance,
        }
    }
}
