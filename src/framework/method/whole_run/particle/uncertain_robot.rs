//! The problem's robot with uncertain link lengths and base, in its coverage world.

use super::{ParticleSpec, Simulator};
use crate::CellSet;
use crate::robot::Chain;
use crate::world::{self, WorldSpec};

/// A robot of which each particle draws one; parameters: relative link lengths, then the shift of the base (m).
pub(super) struct UncertainRobot {
    chain: Chain,
    world: WorldSpec,
    cells: usize,
    link_share: f64,
    base_shift_m: f64,
}

impl UncertainRobot {
    /// The robot `chain` in `world`, off by the spreads of `spec`.
    pub fn new(spec: &ParticleSpec, chain: &Chain, world: &WorldSpec) -> Self {
        Self {
            chain: chain.clone(),
            world: world.clone(),
            cells: world.properties().surface.map_or(0, |surface| surface.cells()),
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

    fn cells(&self) -> usize {
        self.cells
    }

    fn covers(&self, parameters: &[f64], poses: &[Vec<f64>]) -> Vec<CellSet> {
        let links = self.chain.link_count();
        let scales: Vec<f64> = parameters[..links].iter().map(|p| 1.0 + p).collect();
        let shift = [parameters[links], parameters[links + 1], parameters[links + 2]];
        let Ok(mut world) = world::build(&self.world, &self.chain.distorted(&scales, shift)) else {
            return vec![CellSet::empty(self.cells); poses.len()];
        };
        let mut seen = vec![0.0; world.features().len()];
        let mut cover = |pose: &Vec<f64>| {
            world.reset();
            world.commit(pose, &mut seen);
            world.cells().cloned().unwrap_or_default()
        };
        poses.iter().map(&mut cover).collect()
    }
}
