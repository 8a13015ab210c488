//! Worlds: the effect of a robot's pose on the features. Deterministic, simulated, without I/O.
//!
//! # Architecture Invariants
//! - A world's only memory is the prefix of poses committed since its last reset.
//! - [`World::observe`] changes nothing that can be observed, and allocates nothing.

mod cell_grid;
mod coverage;
mod disturbed;
mod error;
mod properties;
mod spec;
#[cfg(test)]
mod tests;
mod tool_distance;
mod tool_position;

pub(crate) use cell_grid::CellGrid;
pub use disturbed::{DisturbanceSpec, SimulatedRobot, build_disturbed};
pub use error::WorldError;
pub use properties::{Surface, WorldProperties};
pub use spec::{CoverageSpec, SurfaceView, ToolDistanceSpec, ToolPositionSpec, WorldSpec};

use crate::robot::Chain;
use crate::{CellSet, Feature};

/// A simulated world that remembers the poses executed since its last reset (the prefix U_1..U_j-1).
pub trait World: Send {
    /// The m features of an observation, in order.
    fn features(&self) -> &[Feature];

    /// Forgets the prefix: the world is as it was before the first pose.
    fn reset(&mut self);

    /// Writes the observation (m values) after the prefix and then `joints` (free joints, rad or m); changes nothing
    /// but scratch space and allocates nothing.
    fn observe(&mut self, joints: &[f64], observation: &mut [f64]);

    /// Writes the observation as [`World::observe`] does, and makes the pose part of the prefix.
    fn commit(&mut self, joints: &[f64], observation: &mut [f64]);

    /// The cells that the prefix has changed; `None` if the world has no cells.
    fn cells(&self) -> Option<&CellSet> {
        None
    }
}

/// Builds the world of `spec` around the robot `chain`.
///
/// # Errors
/// [`WorldError`] with the value and what is allowed.
pub fn build(spec: &WorldSpec, chain: &Chain) -> Result<Box<dyn World>, WorldError> {
    Ok(match spec {
        WorldSpec::ToolPosition(spec) => Box::new(tool_position::ToolPosition::new(spec, chain)?),
        WorldSpec::ToolDistance(spec) => Box::new(tool_distance::ToolDistance::new(spec, chain)?),
        WorldSpec::Coverage(spec) => Box::new(coverage::Coverage::new(spec, chain)?),
    })
}

/// Builds the world of `spec`, as described or disturbed; `seed` is that of the run.
///
/// # Errors
/// [`WorldError`] as for [`build`] and [`build_disturbed`].
pub fn simulated(
    spec: &WorldSpec,
    disturbance: Option<&DisturbanceSpec>,
    chain: &Chain,
    seed: u64,
) -> Result<Box<dyn World>, WorldError> {
    match disturbance {
        Some(disturbance) => build_disturbed(spec, chain, disturbance, seed),
        None => build(spec, chain),
    }
}

impl WorldSpec {
    /// Properties of this world that methods and jobs may rely on.
    #[must_use]
    pub fn properties(&self) -> WorldProperties {
        match self {
            Self::ToolPosition(_) | Self::ToolDistance(_) => WorldProperties { smooth: true, surface: None },
            Self::Coverage(spec) => WorldProperties { smooth: false, surface: Some(coverage::surface(spec)) },
        }
    }

    /// The description of the surface; `None` if the world has no surface.
    #[must_use]
    pub fn surface(&self) -> Option<&CoverageSpec> {
        match self {
            Self::Coverage(spec) => Some(spec),
            Self::ToolPosition(_) | Self::ToolDistance(_) => None,
        }
    }

    /// The description of the surface, for changes; `None` if the world has no surface.
    pub fn surface_mut(&mut self) -> Option<&mut CoverageSpec> {
        match self {
            Self::Coverage(spec) => Some(spec),
            Self::ToolPosition(_) | Self::ToolDistance(_) => None,
        }
    }
}

/// The features of the world of `spec`, which is not built.
///
/// # Errors
/// [`WorldError`] if [`build`] would refuse the description.
pub fn features(spec: &WorldSpec) -> Result<Vec<Feature>, WorldError> {
    match spec {
        WorldSpec::ToolPosition(spec) => Ok(tool_position::features(spec)?.to_vec()),
        WorldSpec::ToolDistance(spec) => Ok(tool_distance::features(spec)?.to_vec()),
        WorldSpec::Coverage(spec) => {
            coverage::check(spec)?;
            Ok(coverage::features(spec))
        }
    }
}
