//! Motions: the path of a finished run as a robot executes it, checked and replayed.
//!
//! path -> equivalent poses with the least motion ([`nearest`]) -> detours around collisions
//! ([`collision`](crate::collision)) -> time-parameterised trajectory ([`trajectory`](crate::trajectory)) -> replay of the effect at the poses and along the motion
//! ([`execution::replay`](crate::execution::replay())).
//!
//! # Architecture Invariants
//! - A motion is a function of problem, result and planning options.
//! - The effect of a motion is never taken from the search: it is replayed.

mod deliver;
mod equivalent;
mod error;
mod step;
mod way;

pub use deliver::{Motion, deliver};
pub use equivalent::nearest;
pub use error::MotionError;
pub use step::JointStep;
