//! Steps from poses that covered something to places nearby, for surfaces of many small cells.
//!
//! Most poses near one that covered something lead to the surface too, and a step as long as the tool is wide covers
//! new cells. Each such pose is a base; the gain expected of a step from it is the mean of its own gain and of those of
//! the steps made from it. The length of a step is the one that has gained most on average so far.

use crate::method::whole_run::Space;
use crate::random::RandomStream;

/// Lengths of steps, rad (or the equivalent share of a stroke).
const LENGTHS: [f64; 5] = [0.02, 0.04, 0.08, 0.16, 0.32];
/// Share of steps whose length is drawn at random.
const CURIOUS: f64 = 0.15;
/// Draws of a step, until one leads to an allowed pose away from all that were tried.
const DRAWS: usize = 32;
/// Least distance from poses tried, as a share of the step's length.
const AWAY: f64 = 0.4;

/// A pose that covered something.
#[derive(Debug, Clone)]
struct Base {
    joints: Vec<f64>,
    /// Cells that it and the steps from it gained.
    gain: f64,
    /// Number of these steps, and itself.
    steps: f64,
}

/// A step that was proposed.
#[derive(Debug, Clone)]
pub(super) struct Step {
    pub joints: Vec<f64>,
    base: usize,
    length: usize,
}

/// All bases, and the gains of steps by their length.
#[derive(Debug, Clone, Default)]
pub(super) struct Walk {
    bases: Vec<Base>,
    /// Sum and number of gains of each length.
    gains: [(f64, f64); LENGTHS.len()],
    tried: Vec<Vec<f64>>,
}

impl Walk {
    /// Enters the gain of a trial at `joints`, which was `step` if it was one.
    pub fn tell(&mut self, joints: &[f64], gain: f64, step: Option<&Step>) {
        if let Some(step) = step {
            self.bases[step.base].gain += gain;
            self.bases[step.base].steps += 1.0;
            self.gains[step.length].0 += gain;
            self.gains[step.length].1 += 1.0;
        }
        if gain > 0.5 {
            self.bases.push(Base { joints: joints.to_vec(), gain, steps: 1.0 });
        }
        self.tried.push(joints.to_vec());
    }

    /// The base whose steps promise most, the latest on ties, with the cells they are expected to gain.
    fn best(&self) -> Option<(usize, f64)> {
        let promise = |base: &Base| base.gain / base.steps;
        let bases = self.bases.iter().map(promise).enumerate();
        bases.reduce(|best, next| if next.1 >= best.1 { next } else { best })
    }

    /// A step that is expected to gain more than `least` cells; `None` if there is none.
    pub fn propose(&self, least: f64, space: &Space, random: &mut RandomStream) -> Option<Step> {
        let (base, _) = self.best().filter(|best| best.1 > least)?;
        let mean = |length: usize| (self.gains[length].0 + 1.0) / (self.gains[length].1 + 1.0);
        let longest = (0..LENGTHS.len()).reduce(|best, next| if mean(next) > mean(best) { next } else { best })?;
        let centre = &self.bases[base].joints;
        let mut joints = centre.clone();
        for _ in 0..DRAWS {
            let length = if random.unit() < CURIOUS { random.below(LENGTHS.len()) } else { longest };
            space.near(centre, LENGTHS[length] / (space.len() as f64).sqrt(), random, &mut joints);
            let least = (AWAY * LENGTHS[length]).powi(2);
            if space.allows(&joints) && self.tried.iter().all(|tried| squared(space, tried, &joints) >= least) {
                return Some(Step { joints, base, length });
            }
        }
        Some(Step { joints, base, length: longest }).filter(|step| space.allows(&step.joints))
    }
}

/// Squared distance of two poses, rad.
fn squared(space: &Space, a: &[f64], b: &[f64]) -> f64 {
    let part = |((x, y), axis): ((&f64, &f64), &crate::method::whole_run::Axis)| ((x - y) * axis.scale()).powi(2);
    a.iter().zip(b).zip(&space.axes).map(part).sum()
}
