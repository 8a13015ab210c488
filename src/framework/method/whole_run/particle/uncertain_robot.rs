//! The problem's robot with uncertain link lengths and base, in its coverage world.

use super::{ParticleSpec, Simulator};
use crate::robot::{Chain, tool_position};
use crate::world::{CellGrid, CoverageSpec};
use nalgebra::Vector3;

/// A robot of which each particle draws one; parameters: relative link lengths, then the shift of the base (m).
pub(super) struct UncertainRobot {
    chain: Chain,
    grid: CellGrid,
    link_share: f64,
    base_shift_m: f64,
}

impl UncertainRobot {
    /// The robot `chain` before `surface`, off by the spreads of `spec`.
    pub fn new(spec: &ParticleSpec, chain: &Chain, surface: &CoverageSpec) -> Self {
        Self {
            chain: chain.clone(),
            grid: CellGrid::new(surface),
            link_share: spec.link_share,
            base_shift_m: spec.base_shift_m,
        }
    }
}

impl Simulator for UncertainRobot {
    fn spreads(&self) -> Vec<f64> {
        let links = vec![self.link_share; self.chain.link_count()];
        [links, vec![self.base_shift_m; 3]].concat()
    }

    fn grid(&self) -> &CellGrid {
        &self.grid
    }

    fn tools(&self, parameters: &[f64], poses: &[Vec<f64>]) -> Vec<Vector3<f64>> {
        let links = self.chain.link_count();
        let scales: Vec<f64> = parameters[..links].iter().map(|p| 1.0 + p).collect();
        let shift = [parameters[links], parameters[links + 1], parameters[links + 2]];
        let chain = self.chain.distorted(&scales, shift);
        poses.iter().map(|pose| tool_position(&chain, pose)).collect()
    }
}
