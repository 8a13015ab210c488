//! Options for the simulated real world and for what the method knows about it.

use crate::framework::execution::Problem;
use crate::framework::method::Knowledge;
use crate::framework::world::{self, DisturbanceSpec, SurfaceView, WorldSpec};

#[derive(Debug, clap::Args)]
pub(super) struct RealityArguments {
    /// Prior knowledge of method model; with a simulator, the simulated real robot differs from its description as with
    /// --distort.
    #[arg(long, value_enum)]
    prior: Option<PriorArgument>,
    /// Simulate a real robot that differs from its description: link lengths off by up to 5 %, base by up to 20 mm,
    /// drawn from the seed.
    #[arg(long)]
    distort: bool,
    /// Simulate 2 mm of sensor noise and 0.1 degrees of joint noise, and tell the method about it.
    #[arg(long)]
    noise: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum PriorArgument {
    /// No prior knowledge.
    None,
    /// The robot and world as described, used as a simulator.
    Simulator,
}

impl RealityArguments {
    /// Applies the options to the simulated real world of `problem` and to the method's knowledge of it.
    pub fn apply(&self, problem: &mut Problem) {
        if self.prior.is_none() && !self.noise && !self.distort {
            return;
        }
        let simulator = self.prior == Some(PriorArgument::Simulator);
        let per_mm = per_mm(&problem.world);
        let mut reality = problem.execution.reality.take().unwrap_or_default();
        if simulator || self.distort {
            reality = DisturbanceSpec { link_share: 0.05, base_shift_m: 0.02, ..reality };
        }
        if self.noise {
            reality.joint_noise_deg = 0.1;
            reality.sensor_noise = per_mm.map_or(0.0, |mm| 2.0 * mm);
        }
        problem.execution.reality = Some(reality);
        // Sensor noise plus the effect of 0.1 degrees in a few joints half a metre away.
        let noise = self.noise.then(|| per_mm.map_or(0.0, |mm| 2.5 * mm));
        let simulator = self.prior.map(|prior| prior == PriorArgument::Simulator);
        problem.execution.method.assume(&Knowledge { simulator, noise });
    }
}

/// Features' unit per millimetre; `None` if the features are not lengths.
fn per_mm(world: &WorldSpec) -> Option<f64> {
    let features = world::features(world).unwrap_or_default();
    match features.first()?.unit.as_str() {
        "m" => Some(1e-3),
        "mm" => Some(1.0),
        _ => None,
    }
}

#[derive(Debug, clap::Args)]
pub(super) struct SurfaceArguments {
    /// The surface cannot be reset between trials.
    #[arg(long)]
    no_reset: bool,
    /// The painted cells of a surface are observed, not only their percentage.
    #[arg(long)]
    cells: bool,
}

impl SurfaceArguments {
    /// Applies the options to the surface of a world, if it has one.
    pub fn apply(&self, world: &mut WorldSpec) {
        if let Some(surface) = world.surface_mut() {
            surface.resets &= !self.no_reset;
            if self.cells {
                surface.observes = SurfaceView::Cells;
            }
        }
    }
}
