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
mod model;
mod particle;
mod planner;
mod refine;
mod search;
mod space;
mod steps;
mod surface;

pub use broyden::{Broyden, BroydenSpec};
pub use model::{ModelIet, ModelSpec, Prior};
pub use particle::{ParticleIet, ParticleSpec, Simulator};
pub use planner::{FeatureMap, GoalOutcome, NextTrial, RunSetup, Trial, WholeRun, WholeRunMethod};
pub use search::SearchIet;
pub use space::{Allows, Axis, Space};
pub use steps::{StepLimits, Stepped, Targets};
pub use surface::{CoverSpec, Grid};
