//! The tool-position world (the paper's wax): the observation is the position of the tool, independent of earlier
//! poses.

use super::{ToolPositionSpec, World, WorldError};
use crate::Feature;
use crate::robot::{Chain, tool_position};

/// Features x, y, z of `p_BT` in the chosen unit.
#[derive(Debug, Clone)]
pub(super) struct ToolPosition {
    chain: Chain,
    features: [Feature; 3],
    scale: f64,
}

/// Features of a tool-position world.
pub(super) fn features(spec: &ToolPositionSpec) -> Result<[Feature; 3], WorldError> {
    scale(&spec.unit)?;
    Ok(["x", "y", "z"].map(|name| Feature::new(name, spec.unit.as_str())))
}

/// Features' unit per metre.
///
/// # Errors
/// [`WorldError::Unit`] if the unit is not a length.
pub(super) fn scale(unit: &str) -> Result<f64, WorldError> {
    match unit {
        "m" => Ok(1.0),
        "mm" => Ok(1000.0),
        _ => Err(WorldError::Unit { found: unit.to_owned() }),
    }
}

impl ToolPosition {
    pub(super) fn new(spec: &ToolPositionSpec, chain: &Chain) -> Result<Self, WorldError> {
        Ok(Self { chain: chain.clone(), features: features(spec)?, scale: scale(&spec.unit)? })
    }
}

impl World for ToolPosition {
    fn features(&self) -> &[Feature] {
        &self.features
    }

    fn reset(&mut self) {}

    fn observe(&mut self, joints: &[f64], observation: &mut [f64]) {
        let p = tool_position(&self.chain, joints);
        for (value, coordinate) in observation.iter_mut().zip(p.iter()) {
            *value = coordinate * self.scale;
        }
    }

    fn commit(&mut self, joints: &[f64], observation: &mut [f64]) {
        self.observe(joints, observation);
    }
}
