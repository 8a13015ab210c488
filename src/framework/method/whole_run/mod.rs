//! Methods that plan a whole run: all goals at once, every trial remembered, so that a dozen evaluations suffice.
//!
//! # Architecture Invariants
//! - State = configuration + append-only log. `ask` is a pure function of the two: its random stream is seeded by
//!   (seed, length of the log), so a checkpoint is the log, and a resumed run proposes the same bits.
//! - A method receives the observation *vector* of each trial; a trial without one, because it was lost, counts too.
//! - A measured pose serves every goal it is near; a goal no pose can serve is reported with its best residual.
//! - A method never proposes a pose that the robot may not take: forbidden poses are not in the [`Space`], and
//!   [`Stepped`] bounds the steps of every method.
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
pub use particle::ParticleSpec;
pub use planner::{Believed, FeatureMap, GoalOutcome, NextTrial, RunSetup, Trial, WholeRun, WholeRunMethod};
pub use search::SearchIet;
pub use space::{Allows, Axis, Space};
pub use steps::{StepLimits, Stepped, Targets};
pub use surface::CoverSpec;
