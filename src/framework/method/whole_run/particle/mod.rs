//! PARTICLE-IET: an accumulating effect with a simulator whose parameters are uncertain.
//!
//! Each particle is one draw of the simulator's parameters; it says which cells each pose covers and which cells the
//! accepted trials have changed ([`belief`]). The next trial is the pose with the largest expected gain, by the votes
//! of the particles: the number of new cells, or nothing if that is more than the next goal asks for. Poses come from a
//! pool spread evenly over the joints' ranges and from aims at open places ([`aim`]).

mod aim;
mod belief;
mod spec;
mod uncertain_robot;

pub use spec::ParticleSpec;

use super::planner::{RunSetup, Trial, WholeRun, WholeRunMethod};
use super::space::Space;
use super::surface::cover::Ledger;
use super::surface::covering::Covering;
use super::surface::sobol;
use crate::random::RandomStream;
use crate::world::{CellGrid, Surface, WorldError};
use belief::{Belief, Particle};
use nalgebra::Vector3;
use uncertain_robot::UncertainRobot;

/// Number of particles that aim before each trial.
const AIMING: usize = 2;
/// Number of particles of which at least one must see a gain in a pose for the others to be asked.
const SCOUTS: usize = 8;
/// Most poses kept from one trial to the next, of those that promised most.
const KEPT: usize = 64;
/// Weight below which a particle has no say, as a share of the mean.
const SILENT: f64 = 0.02;
/// Below this expected gain, in cells, any pose that may lead near an open place is tried.
const HOPELESS: f64 = 0.02;
/// After this many hopeless decisions in a row the rest is reported as out of reach, and after this many trials in a row
/// that gained nothing.
const PATIENCE: u32 = 12;
const MISSES: u32 = 40;
/// After this many the belief is doubted.
const DOUBT: u32 = 8;
/// Most trials that are looked at for a pose that was tried before.
const RECENT: usize = 64;

/// A simulator with uncertain parameters.
pub(crate) trait Simulator: Send {
    /// Standard deviations of the parameters about 0.
    fn spreads(&self) -> Vec<f64>;

    /// The surface.
    fn grid(&self) -> &CellGrid;

    /// The places of the tool at `poses` if the parameters are `parameters`, m.
    fn tools(&self, parameters: &[f64], poses: &[Vec<f64>]) -> Vec<Vector3<f64>>;
}

/// A run of PARTICLE-IET.
struct ParticleIet {
    ledger: Ledger,
    seed: u64,
    space: Space,
    belief: Belief,
    /// Poses spread evenly over the joints' ranges.
    pool: Vec<Vec<f64>>,
    /// Poses that promised most before the last trial.
    kept: Vec<Vec<f64>>,
    next: Option<Vec<f64>>,
    hopeless: u32,
}

impl ParticleIet {
    /// A run for the goals of `run` on a surface, with draws of `robot` as the prior.
    fn new(spec: &ParticleSpec, surface: Surface, robot: Box<dyn Simulator>, run: &RunSetup<'_>) -> Self {
        let mut random = RandomStream::of_run(run.seed, 0);
        let pool = sobol::poses(run.space, spec.poses as usize, &mut random);
        let mut iet = Self {
            ledger: Ledger::new(spec.max_evaluations, surface, &run.targets.goals),
            seed: run.seed,
            space: run.space.clone(),
            belief: Belief::new(robot, spec.particles as usize, &mut random),
            pool,
            kept: Vec::new(),
            next: None,
            hopeless: 0,
        };
        iet.decide(&mut random);
        iet
    }

    fn decide(&mut self, random: &mut RandomStream) {
        let candidates = self.candidates(random);
        let gains = self.gains(&candidates);
        let mut order: Vec<usize> = (0..candidates.len()).collect();
        order.sort_by(|&a, &b| gains[b].total_cmp(&gains[a]).then(a.cmp(&b)));
        let best = order.first().filter(|&&best| gains[best] >= HOPELESS);
        self.hopeless = if best.is_none() { self.hopeless + 1 } else { 0 };
        self.next = match best {
            _ if self.hopeless > PATIENCE || self.ledger.misses() >= MISSES => None,
            Some(&best) => Some(candidates[best].clone()),
            None => random.pick(if candidates.is_empty() { &self.pool } else { &candidates }).cloned(),
        };
        self.kept = order.iter().take(KEPT).map(|&index| candidates[index].clone()).collect();
    }

    /// Poses to choose from, none of them tried lately.
    fn candidates(&self, random: &mut RandomStream) -> Vec<Vec<f64>> {
        let votes = self.belief.votes();
        let mut scouts = vec![leader(&votes)];
        scouts.resize_with(SCOUTS, || drawn(&votes, random));
        let scouts: Vec<&Particle> = scouts.into_iter().map(|index| &self.belief.particles[index]).collect();
        let known: Vec<Vec<f64>> = self.pool.iter().chain(&self.kept).cloned().collect();
        let promising = self.promising(&scouts, &known);
        let mut candidates: Vec<Vec<f64>> = promising.map(|index| known[index].clone()).collect();
        for particle in &scouts[..AIMING] {
            candidates.extend(aim::poses(self.belief.simulator.as_ref(), particle, &self.space, &known, random));
        }
        let recent = self.ledger.log.iter().rev().take(RECENT);
        let tried: Vec<&Vec<f64>> = recent.map(|trial| &trial.joints).collect();
        candidates.retain(|pose| !tried.contains(&pose));
        candidates
    }

    /// Indices of the poses in which one of `scouts` sees a gain.
    fn promising(&self, scouts: &[&Particle], poses: &[Vec<f64>]) -> impl Iterator<Item = usize> {
        let grid = self.belief.simulator.grid();
        let mut gains = vec![false; poses.len()];
        for scout in scouts {
            let tools = self.belief.simulator.tools(&scout.parameters, poses);
            for (tool, gains) in tools.iter().zip(&mut gains) {
                grid.near(tool, |cell| *gains |= !scout.painted.contains(cell));
            }
        }
        (0..gains.len()).filter(move |&index| gains[index])
    }

    /// The gain expected of each pose, in cells.
    fn gains(&self, poses: &[Vec<f64>]) -> Vec<f64> {
        let votes = self.belief.votes();
        let mut gains = vec![0.0; poses.len()];
        let asked = self.ledger.asked();
        let grid = self.belief.simulator.grid();
        let silent = SILENT / votes.len() as f64;
        for (particle, vote) in self.belief.particles.iter().zip(&votes).filter(|(_, vote)| **vote > silent) {
            let tools = self.belief.simulator.tools(&particle.parameters, poses);
            for (tool, sum) in tools.iter().zip(&mut gains) {
                let mut gain = 0.0;
                grid.near(tool, |cell| gain += f64::from(u8::from(!particle.painted.contains(cell))));
                if gain <= asked {
                    *sum += vote * gain;
                }
            }
        }
        gains
    }
}

/// The particle with the most votes, the first on ties.
fn leader(votes: &[f64]) -> usize {
    (0..votes.len()).reduce(|best, next| if votes[next] > votes[best] { next } else { best }).unwrap_or(0)
}

/// A particle drawn by its votes.
fn drawn(votes: &[f64], random: &mut RandomStream) -> usize {
    let at = random.unit();
    let mut sum = 0.0;
    let found = votes.iter().position(|vote| {
        sum += vote;
        sum > at
    });
    found.unwrap_or(votes.len() - 1)
}

impl WholeRunMethod for ParticleSpec {
    fn start(&self, run: &RunSetup<'_>) -> Result<Box<dyn WholeRun>, WorldError> {
        let surface = run.world.properties().surface.ok_or(WorldError::NoSurface)?;
        let described = run.world.surface().ok_or(WorldError::NoSurface)?;
        let robot = Box::new(UncertainRobot::new(self, run.chain, described));
        Ok(Box::new(ParticleIet::new(self, surface, robot, run)))
    }

    fn max_step_deg(&self) -> Option<f64> {
        self.max_step_deg
    }
}

impl Covering for ParticleIet {
    fn ledger(&self) -> &Ledger {
        &self.ledger
    }

    fn pose(&mut self) -> Option<Vec<f64>> {
        self.next.clone()
    }

    fn learn(&mut self, trial: Trial) {
        let joints = trial.joints.clone();
        let effect = self.ledger.tell(trial);
        let mut random = RandomStream::of_run(self.seed, self.ledger.log.len() as u64 + 1);
        self.belief.tell(joints, effect, &mut random);
        if self.ledger.misses() % DOUBT == DOUBT - 1 {
            self.belief.doubt(&mut random);
        }
        if !self.ledger.is_over() {
            self.decide(&mut random);
        }
    }
}
