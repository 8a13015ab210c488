//! CMA-ES, the covariance matrix adaptation evolution strategy, (mu/mu_w, lambda) with restarts.
//!
//! A generation is lambda candidates drawn from a normal distribution whose mean, step size and covariance are learnt
//! from the ranks of their fitness ([`distribution`]). The first goal's search begins anywhere; each later one at the
//! previous goal's result, with a smaller step ([`CmaEsSpec::warm_step`]): the goals of an action follow each other
//! closely. A search ends
//! - when its spread is below [`CmaEsSpec::precision`]: then the goal ends;
//! - when it stagnates before that (more than S generations without strict improvement, or a whole generation of one
//!   fitness, as on the plateaus of a painted percentage): then another begins anywhere, with twice the candidates
//!   (IPOP), until the restarts are used up.
//!
//! Candidates outside the limits are put inside and learnt from where they were executed.
//!
//! Invariant: `state.waiting` names exactly the candidates without a fitness; a generation is drawn when none is waiting.
//!
//! Sources: N. Hansen, "The CMA Evolution Strategy: A Tutorial", arXiv:1604.00772; restarts: A. Auger, N. Hansen,
//! "A restart CMA evolution strategy with increasing population size", CEC 2005, DOI 10.1109/CEC.2005.1554902.

mod distribution;
mod spec;
mod state;
#[cfg(test)]
mod tests;
mod weights;

pub use spec::CmaEsSpec;
pub use state::CmaEsState;

use super::incumbent::Incumbent;
use super::{
    Batch, Best, Optimizer, OptimizerError, OptimizerState, Outcome, PerGoalMethod, Provenance, SearchSpace, StopReason,
};
use crate::random::RandomStream;
use distribution::{Axes, Distribution};
use weights::Weights;

/// A search of one goal; see the module for the algorithm.
#[derive(Debug)]
pub struct CmaEs {
    spec: CmaEsSpec,
    space: SearchSpace,
    state: CmaEsState,
    weights: Weights,
    /// Axes of the distribution the present generation was drawn from.
    axes: Option<Axes>,
    /// The distribution's mean then, rad or m.
    mean: Vec<f64>,
}

impl CmaEs {
    /// A fresh search: the first generation drawn, nothing evaluated.
    ///
    /// # Errors
    /// [`OptimizerError::Parameter`] for a parameter out of its range.
    pub fn new(spec: &CmaEsSpec, space: SearchSpace, seed: u64, stream: u64) -> Result<Self, OptimizerError> {
        OptimizerError::check(CmaEsSpec::NAME, spec)?;
        let mut rng = RandomStream::new(seed, stream);
        let near = spec.warm_step.zip(space.near.as_deref());
        let warm = near.map(|(step, near)| Distribution::new(scaled(&space, near), step));
        let is_warm = warm.is_some();
        let distribution = warm.unwrap_or_else(|| Distribution::new(anywhere(&space, &mut rng), spec.step));
        let mut search = Self::with(spec, space, CmaEsState::new(rng, distribution, is_warm));
        search.draw();
        Ok(search)
    }

    /// Resumes a saved search.
    ///
    /// # Errors
    /// [`OptimizerError`] if the state's version or shape does not fit.
    pub fn resume(spec: &CmaEsSpec, space: SearchSpace, state: CmaEsState) -> Result<Self, OptimizerError> {
        OptimizerError::check(CmaEsSpec::NAME, spec)?;
        state.check(spec.lambda(space.lower.len(), state.restarts), &space)?;
        Ok(Self::with(spec, space, state))
    }

    fn with(spec: &CmaEsSpec, space: SearchSpace, state: CmaEsState) -> Self {
        let n = space.lower.len();
        let mut search = Self {
            weights: Weights::new(n, spec.lambda(n, state.restarts)),
            spec: spec.clone(),
            mean: Vec::new(),
            space,
            state,
            axes: None,
        };
        search.prepare();
        search
    }

    /// Derives axes and mean from the distribution.
    fn prepare(&mut self) {
        self.axes = self.state.distribution.axes();
        self.mean = self.placed(&self.state.distribution.mean);
    }

    fn lambda(&self) -> usize {
        self.weights.recombination.len()
    }

    /// Scaled coordinates as joints within the limits, rad or m.
    fn placed(&self, scaled: &[f64]) -> Vec<f64> {
        let limits = self.space.lower.iter().zip(&self.space.upper);
        let place =
            |(x, (&low, &high)): (&f64, (&f64, &f64))| self.spec.bounds.apply(low + x * (high - low), low, high);
        scaled.iter().zip(limits).map(place).collect()
    }

    /// Draws a generation.
    fn draw(&mut self) {
        let lambda = self.lambda();
        self.state.joints.clear();
        self.state.fitness = vec![f64::INFINITY; lambda];
        for slot in 0..lambda {
            let joints = self.candidate();
            self.state.joints.extend(joints);
            self.state.waiting.push(&mut self.state.next_id, slot);
        }
    }

    fn candidate(&mut self) -> Vec<f64> {
        let Some(axes) = &self.axes else { return self.mean.clone() };
        let scaled = self.state.distribution.sample(axes, &mut self.state.rng);
        self.placed(&scaled)
    }

    fn observed(&mut self, slot: usize, fitness: f64, observation: &[f64], provenance: Provenance) {
        self.state.fitness[slot] = fitness;
        let joints = self.joints(slot).to_vec();
        self.state.enter(joints, fitness, observation, provenance);
        if self.state.run_best.is_none_or(|best| fitness < best) {
            self.state.run_best = Some(fitness);
            self.state.improved = self.state.generation;
        }
    }

    fn joints(&self, slot: usize) -> &[f64] {
        let n = self.space.lower.len();
        &self.state.joints[slot * n..(slot + 1) * n]
    }

    /// Learns from the generation and draws the next, restarts, or stops.
    fn end_generation(&mut self) {
        let fitness = &self.state.fitness;
        let mut order: Vec<usize> = (0..fitness.len()).collect();
        order.sort_by(|&a, &b| fitness[a].total_cmp(&fitness[b]));
        let failed = fitness.iter().filter(|f| f.is_infinite()).count();
        let flat = order.first().zip(order.last()).is_none_or(|(&best, &worst)| fitness[best] == fitness[worst]);
        if let (Some(axes), false) = (&self.axes, flat) {
            let scaled: Vec<Vec<f64>> = order.iter().map(|&slot| scaled(&self.space, self.joints(slot))).collect();
            let ranked: Vec<&[f64]> = scaled.iter().map(Vec::as_slice).collect();
            self.state.distribution.update(&self.weights, axes, &ranked, failed);
            self.prepare();
        }
        let stagnant = self.state.generation - self.state.improved > u64::from(self.spec.stagnation);
        let precise = self.state.distribution.spread() < self.spec.precision || self.axes.is_none();
        self.state.generation += 1;
        if precise && !flat {
            self.state.stop = Some(StopReason::Stagnation);
            return;
        }
        if flat || stagnant {
            if self.state.restarts == self.spec.restarts {
                self.state.stop = Some(StopReason::Stagnation);
                return;
            }
            self.restart();
        }
        self.draw();
    }

    fn restart(&mut self) {
        let state = &mut self.state;
        state.restarts += 1;
        state.distribution = Distribution::new(anywhere(&self.space, &mut state.rng), self.spec.step);
        (state.began, state.improved, state.run_best, state.warm) = (state.generation, state.generation, None, false);
        let n = self.space.lower.len();
        self.weights = Weights::new(n, self.spec.lambda(n, state.restarts));
        self.prepare();
    }
}

/// A place uniform in the limits, scaled.
fn anywhere(space: &SearchSpace, rng: &mut RandomStream) -> Vec<f64> {
    space.lower.iter().map(|_| rng.unit()).collect()
}

/// Joints (rad or m) scaled to 0..1 between their limits; a joint without range is at 0.
fn scaled(space: &SearchSpace, joints: &[f64]) -> Vec<f64> {
    let limits = space.lower.iter().zip(&space.upper);
    let scale = |(q, (&low, &high)): (&f64, (&f64, &f64))| if high > low { (q - low) / (high - low) } else { 0.0 };
    joints.iter().zip(limits).map(scale).collect()
}

impl PerGoalMethod for CmaEsSpec {
    fn start(&self, space: SearchSpace, seed: u64, goal: u64) -> Result<Box<dyn Optimizer>, OptimizerError> {
        Ok(Box::new(CmaEs::new(self, space, seed, goal)?))
    }

    fn resume(&self, space: SearchSpace, state: OptimizerState) -> Result<Box<dyn Optimizer>, OptimizerError> {
        Ok(Box::new(CmaEs::resume(self, space, state.read(Self::NAME)?)?))
    }
}

impl Optimizer for CmaEs {
    fn ask(&mut self, batch: &mut Batch) {
        if self.state.stop.is_some() {
            return;
        }
        self.state.waiting.hand_out(batch, &self.state.joints, self.space.lower.len());
    }

    fn tell(&mut self, id: u64, outcome: Outcome<'_>) {
        let Some(slot) = self.state.waiting.remove(id) else { return };
        match outcome {
            Outcome::Observed { fitness, observation, provenance } => {
                self.observed(slot, fitness, observation, provenance);
                if self.space.target.is_some_and(|target| fitness <= target) {
                    self.state.stop = Some(StopReason::Target);
                    return;
                }
            }
            Outcome::Penalised { fitness } => {
                let unseen = vec![0.0; self.space.features];
                self.observed(slot, fitness, &unseen, Provenance::Penalised);
            }
            Outcome::Failed => {}
            Outcome::Rejected => {
                let joints = self.candidate();
                let n = joints.len();
                self.state.joints[slot * n..(slot + 1) * n].copy_from_slice(&joints);
                self.state.waiting.push_next(&mut self.state.next_id, slot);
                return;
            }
        }
        if self.state.waiting.is_empty() {
            self.end_generation();
        }
    }

    fn best(&self) -> Option<Best<'_>> {
        self.state.hall.as_ref().map(Incumbent::as_best)
    }

    fn stop(&self) -> Option<StopReason> {
        self.state.stop
    }

    fn state(&self) -> OptimizerState {
        OptimizerState::of(CmaEsSpec::NAME, &self.state)
    }

    fn generation(&self) -> u64 {
        self.state.generation
    }

    fn origins(&self, id: u64) -> [Option<&[f64]>; 2] {
        let random = self.state.generation == self.state.began && !self.state.warm;
        let asked = self.state.waiting.slot(id).is_some();
        [(asked && !random).then_some(self.mean.as_slice()), None]
    }

    fn amend(&mut self, id: u64, joints: &[f64]) {
        if let Some(slot) = self.state.waiting.slot(id) {
            let n = joints.len();
            self.state.joints[slot * n..(slot + 1) * n].copy_from_slice(joints);
        }
    }
}
