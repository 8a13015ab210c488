//! PARTICLE-IET: an accumulating effect with a simulator whose parameters are uncertain.
//!
//! Each particle is one draw of the simulator's parameters; it says which cells each pose covers and which cells the
//! accepted trials have changed (S_k). The next trial is the unused pose that most particles, by weight, expect to
//! gain exactly one cell. A trial reweighs: `log w_k -= 1.5 | |cover_k(q) minus S_k| - gain |`; if the cells are
//! seen, by the number of cells that were expected and not gained or gained and not expected, and S_k is what is seen.
//! If no pose convinces half of the weight, particles are resampled and jittered, and the log is replayed.
//!
//! Source: N. J. Gordon, D. J. Salmond, A. F. M. Smith, IEE Proceedings F 140 (1993) 107-113.

mod spec;
mod uncertain_robot;

pub use spec::ParticleSpec;

use super::planner::{RunSetup, Trial, WholeRun, WholeRunMethod};
use super::space::Space;
use super::surface::cover::{CoverSpec, Ledger, TrialEffect};
use super::surface::covering::Covering;
use super::surface::sobol;
use crate::CellSet;
use crate::random::RandomStream;
use crate::world::WorldError;
use uncertain_robot::UncertainRobot;

/// Of a renewed pool, one pose in this many lies around the liked ones; their centres; their spread, rad.
const LOCAL_SHARE: usize = 4;
const CENTRES: usize = 16;
const LOCAL_SPREAD: f64 = 0.1;
const SHARPNESS: f64 = 1.5;
/// Below this probability of gaining one cell the particles are resampled.
const CONVINCING: f64 = 0.5;
/// Below this a random unused pose is tried.
const HOPELESS: f64 = 0.02;
const RESAMPLINGS: u32 = 2;
/// After this many hopeless decisions in a row the rest is reported as out of reach.
const PATIENCE: u32 = 12;
/// Jitter of a resampled particle, in standard deviations of the prior.
const JITTER: f64 = 0.25;

/// A simulator with uncertain parameters.
pub trait Simulator: Send {
    /// Standard deviations of the parameters about 0.
    fn spreads(&self) -> Vec<f64>;

    /// Number of cells.
    fn cells(&self) -> usize;

    /// The cells that each pose covers if the parameters are `parameters`.
    fn covers(&self, parameters: &[f64], poses: &[Vec<f64>]) -> Vec<CellSet>;
}

struct Particle {
    parameters: Vec<f64>,
    log_weight: f64,
    covers: Vec<CellSet>,
    painted: CellSet,
}

/// A run of PARTICLE-IET.
pub struct ParticleIet {
    ledger: Ledger,
    seed: u64,
    space: Space,
    simulator: Box<dyn Simulator>,
    /// Poses in a pool.
    count: usize,
    poses: Vec<Vec<f64>>,
    used: Vec<bool>,
    particles: Vec<Particle>,
    verdicts: Vec<TrialEffect>,
    next: Option<usize>,
    hopeless: u32,
}

impl ParticleIet {
    /// A run for `goals` over `space` with `particles` draws of `simulator` as the prior.
    #[must_use]
    pub fn new(
        spec: CoverSpec,
        resets: bool,
        space: Space,
        goals: &[Vec<f64>],
        simulator: Box<dyn Simulator>,
        particles: usize,
        seed: u64,
    ) -> Self {
        let mut random = RandomStream::of_run(seed, 0);
        let poses = sobol::poses(&space, spec.poses as usize, &mut random);
        let spreads = simulator.spreads();
        let unpainted = CellSet::empty(simulator.cells());
        let particles = (0..particles)
            .map(|_| {
                let parameters: Vec<f64> = spreads.iter().map(|s| s * random.normal()).collect();
                let covers = simulator.covers(&parameters, &poses);
                Particle { parameters, log_weight: 0.0, covers, painted: unpainted.clone() }
            })
            .collect();
        let mut run = Self {
            count: poses.len(),
            ledger: Ledger::new(spec, resets, goals),
            seed,
            space,
            simulator,
            used: vec![false; poses.len()],
            poses,
            particles,
            verdicts: Vec::new(),
            next: None,
            hopeless: 0,
        };
        run.decide();
        run
    }

    fn weights(&self) -> Vec<f64> {
        let top = self.particles.iter().map(|p| p.log_weight).fold(f64::NEG_INFINITY, f64::max);
        let raw: Vec<f64> = self.particles.iter().map(|p| (p.log_weight - top).exp()).collect();
        let sum: f64 = raw.iter().sum();
        raw.into_iter().map(|w| w / sum).collect()
    }

    /// Each unused pose with the probability that it gains exactly one cell.
    fn chances(&self) -> Vec<(f64, usize)> {
        let weights = self.weights();
        let unused = (0..self.poses.len()).filter(|&z| !self.used[z]);
        unused
            .map(|z| {
                let agree =
                    self.particles.iter().zip(&weights).filter(|(p, _)| p.covers[z].count_beyond([&p.painted]) == 1);
                (agree.map(|(_, w)| w).sum(), z)
            })
            .collect()
    }

    /// The likeliest of them, the first on ties.
    fn best(&self) -> Option<(f64, usize)> {
        self.chances().into_iter().reduce(|best, next| if next.0 > best.0 { next } else { best })
    }

    fn decide(&mut self) {
        let mut random = RandomStream::of_run(self.seed, self.ledger.log.len() as u64 + 1);
        let mut best = self.best();
        for _ in 0..RESAMPLINGS {
            if best.is_none_or(|b| b.0 >= CONVINCING) || self.ledger.log.is_empty() {
                break;
            }
            self.resample(&mut random);
            best = self.best();
        }
        let is_hopeless = best.is_none_or(|b| b.0 < HOPELESS);
        self.hopeless = if is_hopeless { self.hopeless + 1 } else { 0 };
        self.next = match best {
            _ if self.hopeless > PATIENCE => None,
            Some((chance, z)) if chance >= HOPELESS => Some(z),
            Some(_) => {
                let unused: Vec<usize> = (0..self.poses.len()).filter(|&z| !self.used[z]).collect();
                random.pick(&unused).copied()
            }
            None => None,
        };
    }

    fn resample(&mut self, random: &mut RandomStream) {
        let weights = self.weights();
        let spreads = self.simulator.spreads();
        let start = random.unit();
        let (mut sum, mut index) = (weights[0], 0);
        let count = self.particles.len();
        let drawn: Vec<Vec<f64>> = (0..count)
            .map(|k| {
                let at = (k as f64 + start) / count as f64;
                while sum < at && index + 1 < count {
                    index += 1;
                    sum += weights[index];
                }
                let parent = &self.particles[index].parameters;
                parent.iter().zip(&spreads).map(|(p, s)| p + JITTER * s * random.normal()).collect()
            })
            .collect();
        self.renew_poses(random);
        let tried: Vec<Vec<f64>> = self.ledger.log.iter().map(|t| t.joints.clone()).collect();
        for (particle, parameters) in self.particles.iter_mut().zip(drawn) {
            let replay = self.simulator.covers(&parameters, &tried);
            particle.covers = self.simulator.covers(&parameters, &self.poses);
            particle.parameters = parameters;
            particle.painted.clear();
            particle.log_weight = 0.0;
            for (cover, verdict) in replay.iter().zip(&self.verdicts) {
                particle.learn(cover, verdict);
            }
        }
    }

    /// A new pool: an even cover with another shift, and poses around those the old particles liked best.
    fn renew_poses(&mut self, random: &mut RandomStream) {
        let mut liked = self.chances();
        liked.sort_by(|a, b| b.0.total_cmp(&a.0));
        liked.truncate(CENTRES);
        let local = self.count / LOCAL_SHARE;
        let mut pool = sobol::poses(&self.space, self.count - local, random);
        let mut pose = self.space.home();
        for (_, centre) in liked.iter().cycle().take(local) {
            self.space.near(&self.poses[*centre], LOCAL_SPREAD, random, &mut pose);
            if self.space.allows(&pose) {
                pool.push(pose.clone());
            }
        }
        self.used = vec![false; pool.len()];
        self.poses = pool;
    }
}

impl WholeRunMethod for ParticleSpec {
    fn start(&self, run: &RunSetup<'_>) -> Result<Box<dyn WholeRun>, WorldError> {
        let limit = CoverSpec { max_evaluations: self.max_evaluations, poses: self.poses, max_step_deg: None };
        let robot = Box::new(UncertainRobot::new(self, run.chain, run.world));
        let (resets, particles) = (run.world.properties().resets(), self.particles as usize);
        let space = run.space.clone();
        Ok(Box::new(ParticleIet::new(limit, resets, space, &run.targets.goals, robot, particles, run.seed)))
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
        self.next.map(|z| self.poses[z].clone())
    }

    fn learn(&mut self, trial: Trial) {
        let tried = [trial.joints.clone()];
        let verdict = self.ledger.tell(trial);
        if let Some(z) = self.poses.iter().position(|p| *p == tried[0]) {
            self.used[z] = true;
        }
        for particle in &mut self.particles {
            let cover = self.simulator.covers(&particle.parameters, &tried);
            particle.learn(&cover[0], &verdict);
        }
        self.verdicts.push(verdict);
        if !self.ledger.is_over() {
            self.decide();
        }
    }
}

impl Particle {
    /// Judges what it expected of a trial by the cells that were seen gained, or else by their number.
    fn learn(&mut self, cover: &CellSet, verdict: &TrialEffect) {
        let expected = cover.count_beyond([&self.painted]);
        let wrong = match (&verdict.fresh, verdict.gain) {
            (Some(seen), _) => {
                let missed = cover.count_beyond([&self.painted, seen]);
                let unexpected = seen.count_beyond([cover]);
                f64::from(missed + unexpected)
            }
            (None, Some(gain)) => (f64::from(expected) - gain).abs(),
            (None, None) => 0.0,
        };
        self.log_weight -= SHARPNESS * wrong;
        if verdict.accepted {
            self.painted.extend(verdict.fresh.as_ref().unwrap_or(cover));
        }
    }
}
