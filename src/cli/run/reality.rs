//! What the simulated real world is like, and what a method is told of it.

use crate::framework::execution::Problem;
use crate::framework::method::per_goal::MethodSpec;
use crate::framework::method::whole_run::Prior;
use crate::framework::world::{RealitySpec, SurfaceView, WorldSpec};

#[derive(Debug, clap::Args)]
pub(super) struct RealityArguments {
    /// What method model believes before its first trial; with a simulator the real robot is simulated unlike it, as by
    /// --distort.
    #[arg(long, value_enum)]
    prior: Option<PriorArgument>,
    /// The real robot is simulated unlike its description: links 5 % and base 20 mm off, drawn by the seed.
    #[arg(long)]
    distort: bool,
    /// The real world is simulated with a sensor noise of 2 mm and a joint noise of 0.1 degrees, and the method is told.
    #[arg(long)]
    noise: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum PriorArgument {
    /// Nothing is known.
    None,
    /// The robot and world as described.
    Simulator,
}

impl RealityArguments {
    /// Makes the simulated real world of `problem` unlike its description, and tells the method what it may know.
    pub fn apply(&self, problem: &mut Problem) {
        if self.prior.is_none() && !self.noise && !self.distort {
            return;
        }
        let simulator = self.prior == Some(PriorArgument::Simulator);
        let per_mm = match &problem.world {
            WorldSpec::ToolPosition(tool) => Some(if tool.unit == "m" { 1e-3 } else { 1.0 }),
            WorldSpec::Coverage(_) => None,
        };
        let mut reality = problem.execution.reality.take().unwrap_or_default();
        if simulator || self.distort {
            reality = RealitySpec { link_share: 0.05, base_shift_m: 0.02, ..reality };
        }
        if self.noise {
            reality.joint_noise_deg = 0.1;
            reality.sensor_noise = per_mm.map_or(0.0, |mm| 2.0 * mm);
        }
        problem.execution.reality = Some(reality);
        // sensor, and what 0.1 degrees in a few joints do half a metre away
        self.tell(&mut problem.execution.method, per_mm.map_or(0.0, |mm| 2.5 * mm));
    }

    fn tell(&self, method: &mut MethodSpec, noise: f64) {
        let simulator = self.prior.map(|prior| prior == PriorArgument::Simulator);
        match method {
            MethodSpec::Model(model) => {
                let prior = simulator.map(|it_is| if it_is { Prior::Simulator } else { Prior::None });
                model.prior = prior.unwrap_or(model.prior);
                model.noise = if self.noise { noise } else { model.noise };
            }
            MethodSpec::Auto(wishes) => {
                wishes.simulator = simulator.unwrap_or(wishes.simulator);
                wishes.noise = if self.noise { noise } else { wishes.noise };
            }
            _ => {}
        }
    }
}

#[derive(Debug, clap::Args)]
pub(super) struct SurfaceArguments {
    /// A surface cannot be put back between trials.
    #[arg(long)]
    no_reset: bool,
    /// The painted cells of a surface are seen, not only their share.
    #[arg(long)]
    cells: bool,
}

impl SurfaceArguments {
    /// Makes a world of coverage as they say; other worlds have no surface.
    pub fn apply(&self, world: &mut WorldSpec) {
        if let WorldSpec::Coverage(coverage) = world {
            coverage.resets &= !self.no_reset;
            if self.cells {
                coverage.observes = SurfaceView::Cells;
            }
        }
    }
}
