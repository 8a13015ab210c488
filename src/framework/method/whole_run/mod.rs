//! Methods that own a whole run: all goals at once, every trial remembered, so that a dozen evaluations can do.
//!
//! # Architecture Invariants
//! - State = configuration + append-only log. `ask` is a pure function of the two: its random stream is seeded by
//!   (seed, length of the log), so a checkpoint is the log, and a resumed run proposes the same bits.
//! - A trial is told with its observation *vector*; a trial whose observation was lost is told too, and costs one.
//! - A measured pose serves every goal it is near; a goal no pose can serve is reported with its best residual.
//! - What a robot may not take is never proposed: forbidden poses are not in the [`Space`], steps are bounded by
//!   [`Stepped`] around every method.
//! - No kinematics is needed: joints in, features out, limits known. A simulator is a prior, not a requirement.

mod broyden;
mod distance;
mod model;
mod particle;
mod refine;
mod search;
mod space;
mod steps;
mod surface;

pub use broyden::{Broyden, BroydenSpec};
pub use model::{ModelIet, ModelSpec, Prior};
pub use particle::{ParticleIet, ParticleSpec, Simulator};
pub use search::SearchIet;
pub use space::{Allows, Axis, Space};
pub use steps::{StepLimits, Stepped, Targets};
pub use surface::{CoverSpec, Grid};

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// A map from joints to features: a simulated world, right or wrong, as a prior mean.
pub trait FeatureMap: Send {
    /// Writes the m features expected at `joints` (rad or m).
    fn predict(&mut self, joints: &[f64], features: &mut [f64]);
}

impl<F: FnMut(&[f64], &mut [f64]) + Send> FeatureMap for F {
    fn predict(&mut self, joints: &[f64], features: &mut [f64]) {
        self(joints, features);
    }
}

/// One executed pose and what was seen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Trial {
    /// Joints as commanded, rad or m.
    pub joints: Vec<f64>,
    /// The m features seen; none when the observation was lost.
    pub observation: Option<Vec<f64>>,
    /// The cells seen affected after it, 64 a word, row-major, lowest bit first; none where cells are not seen.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cells: Option<Vec<u64>>,
    /// The goal the pose was tried for.
    pub goal: usize,
}

/// What a method wants next.
#[derive(Debug, Clone, PartialEq)]
pub enum Proposal {
    /// Execute this pose.
    Execute {
        /// Joints, rad or m.
        joints: Vec<f64>,
        /// The goal it is meant for.
        goal: usize,
    },
    /// No pose is expected to improve any goal.
    Finished,
}

/// The result for one goal.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// Index of the trial whose pose serves the goal best; none when nothing was observed.
    pub trial: Option<usize>,
    /// Its distance from the goal, features' unit (with noise: of the model's mean there).
    pub distance: f64,
    /// Whether the goal is reached; otherwise `distance` is the best residual.
    pub reached: bool,
}

/// A method that owns a whole run. Its state is its configuration and its log: tell a fresh one the log to resume.
pub trait WholeRun: Send {
    /// The next pose, a function of configuration, seed and log alone.
    fn ask(&mut self) -> Proposal;

    /// Appends a trial and learns from it.
    fn tell(&mut self, trial: Trial);

    /// The trials so far.
    fn log(&self) -> &[Trial];

    /// Indices of the trials whose effect stays: what is executed before the next trial where a world was put back.
    fn accepted(&self) -> &[usize] {
        &[]
    }

    /// The best own trial of each goal.
    fn outcomes(&mut self) -> Vec<Outcome>;

    /// Whether the goal ended because its trials were used up, with hope left.
    fn is_used_up(&self, goal: usize) -> bool;
}
