//! Worlds: what a robot's pose does to the features. Deterministic, simulated, without I/O.

mod spec;

pub use spec::{CoverageSpec, ToolPositionSpec, WorldSpec};

use crate::framework::Feature;

/// A simulated world that remembers the poses executed since its last reset (the prefix U_1..U_j-1).
pub trait World: Send {
    /// The m features an observation holds, in order.
    fn features(&self) -> &[Feature];

    /// Forgets the prefix: the world as before the first pose.
    fn reset(&mut self);

    /// Writes the observation (m values) after the prefix and then `joints` (free joints, rad or m); changes nothing
    /// but scratch space and allocates nothing.
    fn observe(&mut self, joints: &[f64], observation: &mut [f64]);

    /// As [`World::observe`], and the pose becomes part of the prefix.
    fn commit(&mut self, joints: &[f64], observation: &mut [f64]);
}
