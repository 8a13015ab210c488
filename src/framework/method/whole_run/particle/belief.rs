//! The belief about the simulator's parameters: a population of particles, each with the likelihood of the whole log.
//!
//! A particle is as likely as its parameters are under the prior, times `exp(-1.5 e)`, where e is the number of cells by
//! which its expectation of each trial was wrong: `| |cover(q) minus S| - gain |`, or, if the cells are seen, the number
//! of cells that were expected and not gained or gained and not expected. S holds the cells that the accepted trials
//! have changed. As soon as few particles bear all the weight, they are drawn anew by tempered weights and moved by
//! differential evolution Markov chains, which leave the posterior as it is and take their scale from the population.
//!
//! Sources: N. J. Gordon, D. J. Salmond, A. F. M. Smith, IEE Proceedings F 140 (1993) 107-113; C. J. F. ter Braak,
//! Statistics and Computing 16 (2006) 239-249, DOI 10.1007/s11222-006-8769-1.

use super::Simulator;
use crate::CellSet;
use crate::method::whole_run::surface::cover::TrialEffect;
use crate::random::RandomStream;
use nalgebra::Vector3;

/// Logarithm of the likelihood that a cell's error costs.
const SHARPNESS: f64 = 1.5;
/// Least effective number of particles, as a share of all: below it they are drawn anew.
const FEW: f64 = 0.5;
/// Cells by which a trial may be other than expected before particles are drawn anew.
const SURPRISE: f64 = 0.5;
/// Effective number of particles that votes and draws are tempered to, as a share of all.
const VOTERS: f64 = 0.2;
/// Number of replayed trials that moves may cost at a time.
const MOVES: f64 = 40_000.0;
/// Most moves of one particle at a time.
const SWEEPS: f64 = 12.0;
/// Both limits rise by this factor per cell and trial by which the best particle is wrong.
const MORE: f64 = 8.0;
/// Of a belief in doubt, one particle in this many stays; the power of the posterior from which all are moved, and the
/// number of moves of each.
const BELIEVED: usize = 4;
const COOL: f64 = 0.02;
const FRESH: f64 = 40.0;
/// Share of moves that change one parameter alone, by at most this many standard deviations of the prior, down to this
/// many powers of ten less.
const SINGLE: f64 = 0.3;
const JITTER: f64 = 0.5;
const FINEST: f64 = 2.0;
/// Noise of the other moves, in standard deviations of the prior.
const NOISE: f64 = 0.01;

/// One draw of the simulator's parameters.
#[derive(Debug, Clone)]
pub(super) struct Particle {
    pub parameters: Vec<f64>,
    /// The cells it believes changed by the accepted trials.
    pub painted: CellSet,
    /// Logarithm of prior times likelihood, up to a constant.
    log_posterior: f64,
}

/// All particles, with the poses tried and their effects.
pub(super) struct Belief {
    pub simulator: Box<dyn Simulator>,
    pub particles: Vec<Particle>,
    spreads: Vec<f64>,
    tried: Vec<Vec<f64>>,
    effects: Vec<TrialEffect>,
}

impl Belief {
    pub fn new(simulator: Box<dyn Simulator>, count: usize, random: &mut RandomStream) -> Self {
        let spreads = simulator.spreads();
        let mut belief = Self { simulator, particles: Vec::new(), spreads, tried: Vec::new(), effects: Vec::new() };
        for _ in 0..count {
            let parameters = belief.spreads.iter().map(|s| s * random.normal()).collect();
            belief.particles.push(belief.particle(parameters));
        }
        belief
    }

    /// A particle with `parameters` that has seen every trial.
    fn particle(&self, parameters: Vec<f64>) -> Particle {
        let deviation = |(p, s): (&f64, &f64)| if *s > 0.0 { (p / s).powi(2) } else { 0.0 };
        let log_posterior = -0.5 * parameters.iter().zip(&self.spreads).map(deviation).sum::<f64>();
        let tools = self.simulator.tools(&parameters, &self.tried);
        let painted = CellSet::empty(self.simulator.grid().cells());
        let mut particle = Particle { parameters, painted, log_posterior };
        for (tool, effect) in tools.iter().zip(&self.effects) {
            particle.learn(self.simulator.as_ref(), tool, effect);
        }
        particle
    }

    /// Enters the effect of a trial at `joints` and moves the particles, if few are left that expected it.
    pub fn tell(&mut self, joints: Vec<f64>, effect: TrialEffect, random: &mut RandomStream) {
        let tried = [joints];
        let mut surprise = 0.0;
        let votes = self.votes();
        for (particle, vote) in self.particles.iter_mut().zip(votes) {
            let tools = self.simulator.tools(&particle.parameters, &tried);
            surprise += vote * particle.learn(self.simulator.as_ref(), &tools[0], &effect);
        }
        self.tried.extend(tried);
        self.effects.push(effect);
        if surprise > SURPRISE || effective(&self.weights(1.0)) < FEW * self.particles.len() as f64 {
            self.renew(random);
        }
    }

    /// Draws the particles anew by their weights and moves them.
    fn renew(&mut self, random: &mut RandomStream) {
        let (temper, votes) = self.tempered();
        let drawn = systematic(&votes, random);
        self.particles = drawn.iter().map(|&index| self.particles[index].clone()).collect();
        let best = self.particles.iter().map(|p| p.log_posterior).fold(f64::NEG_INFINITY, f64::max);
        let misfit = (-best / (SHARPNESS * self.tried.len() as f64 + 1.0)).min(1.0);
        let more = 1.0 + MORE * misfit;
        let moves = MOVES * more / (self.particles.len() * self.tried.len().max(1)) as f64;
        self.anneal(temper, moves.clamp(1.0, SWEEPS * more).floor(), random);
    }

    /// Draws most particles from the prior, in the place of the least likely, and moves all: for a belief that has taken
    /// the wrong robot for the true one.
    pub fn doubt(&mut self, random: &mut RandomStream) {
        self.particles.sort_by(|a, b| b.log_posterior.total_cmp(&a.log_posterior));
        for index in self.particles.len().div_ceil(BELIEVED)..self.particles.len() {
            let parameters = self.spreads.iter().map(|s| s * random.normal()).collect();
            self.particles[index] = self.particle(parameters);
        }
        self.anneal(COOL, FRESH, random);
    }

    /// Moves every particle in each of `sweeps`, from the power `temper` of the posterior, at which the population spreads,
    /// to the posterior itself.
    fn anneal(&mut self, temper: f64, sweeps: f64, random: &mut RandomStream) {
        let mut sweep = 0.0;
        while sweep < sweeps {
            sweep += 1.0;
            let power = temper.powf(1.0 - sweep / sweeps);
            for index in 0..self.particles.len() {
                let moved = self.particle(self.proposal(index, random));
                let gain = moved.log_posterior - self.particles[index].log_posterior;
                if random.unit() < (power * gain).exp() {
                    self.particles[index] = moved;
                }
            }
        }
    }

    fn proposal(&self, index: usize, random: &mut RandomStream) -> Vec<f64> {
        let count = self.particles.len();
        let mut parameters = self.particles[index].parameters.clone();
        if random.unit() < SINGLE {
            let one = random.below(parameters.len());
            let scale = JITTER * 10.0_f64.powf(-FINEST * random.unit());
            parameters[one] += scale * self.spreads[one] * random.normal();
            return parameters;
        }
        let [a, b] = [0; 2].map(|_| self.particles[random.below(count)].parameters.clone());
        let scale = 2.38 / (2.0 * parameters.len() as f64).sqrt() * random.unit();
        for (k, value) in parameters.iter_mut().enumerate() {
            *value += scale * (a[k] - b[k]) + NOISE * self.spreads[k] * random.normal();
        }
        parameters
    }

    /// Weights of the particles, those of the posterior to the power `temper`.
    fn weights(&self, temper: f64) -> Vec<f64> {
        let top = self.particles.iter().map(|p| p.log_posterior).fold(f64::NEG_INFINITY, f64::max);
        let raw: Vec<f64> = self.particles.iter().map(|p| (temper * (p.log_posterior - top)).exp()).collect();
        let sum: f64 = raw.iter().sum();
        raw.into_iter().map(|w| w / sum).collect()
    }

    /// Weights of the particles, tempered until enough of them have a say.
    pub fn votes(&self) -> Vec<f64> {
        self.tempered().1
    }

    /// The power of the posterior at which enough particles have a say, and their weights.
    fn tempered(&self) -> (f64, Vec<f64>) {
        let least = VOTERS * self.particles.len() as f64;
        let mut temper = 1.0;
        let mut weights = self.weights(temper);
        while effective(&weights) < least {
            temper *= 0.7;
            weights = self.weights(temper);
        }
        (temper, weights)
    }
}

impl Particle {
    /// Judges what it expected of a trial that led the tool to `tool`; returns by how many cells it was wrong.
    fn learn(&mut self, simulator: &dyn Simulator, tool: &Vector3<f64>, effect: &TrialEffect) -> f64 {
        let mut expected = 0;
        let mut agreed = 0;
        let (painted, fresh) = (&mut self.painted, effect.fresh.as_ref());
        simulator.grid().near(tool, |cell| {
            if fresh.is_some_and(|fresh| fresh.contains(cell)) {
                agreed += 1;
                expected += 1;
            } else if !painted.contains(cell) {
                expected += 1;
            }
            if effect.accepted && fresh.is_none() {
                painted.insert(cell);
            }
        });
        let wrong = match (fresh, effect.gain) {
            (Some(fresh), _) => f64::from(expected + fresh.count() - 2 * agreed),
            (None, Some(gain)) => (f64::from(expected) - gain).abs(),
            (None, None) => 0.0,
        };
        self.log_posterior -= SHARPNESS * wrong;
        if let Some(fresh) = fresh.filter(|_| effect.accepted) {
            self.painted.extend(fresh);
        }
        wrong
    }
}

/// Effective number of particles of `weights`, which sum to 1.
fn effective(weights: &[f64]) -> f64 {
    1.0 / weights.iter().map(|w| w * w).sum::<f64>()
}

/// As many indices as there are weights, each about as often as its weight says.
fn systematic(weights: &[f64], random: &mut RandomStream) -> Vec<usize> {
    let (count, start) = (weights.len(), random.unit());
    let (mut sum, mut index) = (weights[0], 0);
    (0..count)
        .map(|k| {
            while sum < (k as f64 + start) / count as f64 && index + 1 < count {
                index += 1;
                sum += weights[index];
            }
            index
        })
        .collect()
}
