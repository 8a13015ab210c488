//! SST, the steady-state tournament of the published runs (ECF's `SteadyStateTournament`).
//!
//! Population of P individuals, uniform in the limits. A generation is P iterations; in each, three individuals are
//! drawn with replacement, the worst (the first drawn on ties) is overwritten by a child of the other two in draw
//! order: a crossover picked among thirteen, then with probability `mutation_probability` a mutation. At the end of a
//! generation the best of the population (the last on ties) enters the hall of fame if strictly better than the one
//! there. The search stops when more than S generations have passed since the hall last changed.
//!
//! Invariant: `state.waiting` names exactly the individuals without a fitness; a child is bred when none is waiting.
//!
//! Source: R. Fernandez-Fernandez et al.'s runs; ECF, D. Jakobovic et al., <http://ecf.zemris.fer.hr>.

mod operators;
mod spec;
mod state;
#[cfg(test)]
mod tests;

pub use spec::SstSpec;
pub use state::SstState;

use super::incumbent::Incumbent;
use super::{
    Batch, Best, Optimizer, OptimizerError, OptimizerState, Outcome, PerGoalMethod, Provenance, SearchSpace, StopReason,
};
use operators::{CROSSOVERS, Parents, mutate};
use state::STATE_VERSION;

/// The steady-state tournament; see the module for the algorithm.
#[derive(Debug)]
pub struct Sst {
    spec: SstSpec,
    space: SearchSpace,
    state: SstState,
}

impl Sst {
    /// A fresh search: population drawn, nothing evaluated.
    ///
    /// # Errors
    /// [`OptimizerError::Parameter`] for a population below 3 or a probability outside 0 to 1.
    pub fn new(spec: &SstSpec, space: SearchSpace, seed: u64, stream: u64) -> Result<Self, OptimizerError> {
        OptimizerError::check(SstSpec::NAME, spec)?;
        let state = SstState::new(spec.population as usize, &space, seed, stream);
        Ok(Self::with(spec, space, state))
    }

    /// Resumes a saved search.
    ///
    /// # Errors
    /// [`OptimizerError`] if the state's version or shape does not fit.
    pub fn resume(spec: &SstSpec, space: SearchSpace, state: SstState) -> Result<Self, OptimizerError> {
        OptimizerError::check(SstSpec::NAME, spec)?;
        state.check(spec.population as usize, &space)?;
        Ok(Self::with(spec, space, state))
    }

    fn with(spec: &SstSpec, space: SearchSpace, state: SstState) -> Self {
        Self { spec: spec.clone(), space, state }
    }

    /// Overwrites the worst of three by a child of the other two, which then waits for its fitness.
    fn breed(&mut self) {
        let (population, genes) = (self.spec.population as usize, self.space.lower.len());
        let state = &mut self.state;
        let drawn = [0; 3].map(|_: i32| state.rng.below(population));
        let mut worst = 0;
        for candidate in 1..3 {
            if state.fitness[drawn[candidate]] > state.fitness[drawn[worst]] {
                worst = candidate;
            }
        }
        let slot = drawn[worst];
        let [i1, i2] = match worst {
            0 => [drawn[1], drawn[2]],
            1 => [drawn[0], drawn[2]],
            _ => [drawn[0], drawn[1]],
        };
        for (copy, individual) in state.family.chunks_exact_mut(genes).zip([slot, i1, i2]) {
            copy.copy_from_slice(&state.joints[individual * genes..(individual + 1) * genes]);
        }
        let parents = Parents {
            p1: &state.family[genes..2 * genes],
            p2: &state.family[2 * genes..],
            fitness: [state.fitness[i1], state.fitness[i2]],
            lower: &self.space.lower,
            upper: &self.space.upper,
            first: usize::from(self.spec.ecf_gene0_quirk),
            shared: [i1, i2].map(|parent| self.spec.ecf_shared_parent_quirk && parent == slot),
        };
        let child = &mut state.joints[slot * genes..(slot + 1) * genes];
        let (_, crossover) = CROSSOVERS[state.rng.below(CROSSOVERS.len())];
        crossover(&parents, child, &mut state.rng);
        if state.rng.unit() < self.spec.mutation_probability {
            mutate(child, &self.space.lower, &self.space.upper, &mut state.rng);
        }
        for (gene, value) in child.iter_mut().enumerate() {
            *value = self.spec.bounds.apply(*value, self.space.lower[gene], self.space.upper[gene]);
        }
        state.fitness[slot] = f64::INFINITY;
        if self.spec.ecf_shared_parent_quirk {
            for (parent, individual) in state.family[genes..].chunks_exact_mut(genes).zip([i1, i2]) {
                if individual == slot {
                    parent.copy_from_slice(child);
                }
            }
        }
        state.waiting.push(&mut state.next_id, slot);
    }

    /// Updates the hall of fame and applies the stop rules; `state.generation` is the generation that ends.
    fn end_generation(&mut self) {
        let best = self.best_slot();
        let best_fitness = best.map_or(f64::INFINITY, |slot| self.state.fitness[slot]);
        if let Some(slot) = best
            && self.state.hall.as_ref().is_none_or(|hall| best_fitness < hall.fitness)
        {
            self.state.hall = Some(self.as_best(slot).into());
            self.state.last_change = self.state.generation;
        }
        let state = &mut self.state;
        if self.space.target.is_some_and(|target| best_fitness <= target) {
            state.stop = Some(StopReason::Target);
        } else if state.generation - state.last_change > u64::from(self.spec.stagnation) {
            state.stop = Some(StopReason::Stagnation);
        }
        state.generation += 1;
        state.iteration = 0;
    }

    /// The best individual of the population, the last on ties; `None` if none was executed.
    fn best_slot(&self) -> Option<usize> {
        let fitness = &self.state.fitness;
        let mut best = None;
        let mut smallest = f64::INFINITY;
        for (slot, &value) in fitness.iter().enumerate() {
            if value <= smallest && value < f64::INFINITY {
                (best, smallest) = (Some(slot), value);
            }
        }
        best
    }
}

impl Sst {
    fn as_best(&self, slot: usize) -> Best<'_> {
        let (genes, features) = (self.space.lower.len(), self.space.features);
        Best {
            joints: &self.state.joints[slot * genes..(slot + 1) * genes],
            fitness: self.state.fitness[slot],
            observation: &self.state.observations[slot * features..(slot + 1) * features],
            provenance: self.state.provenance[slot],
        }
    }

    /// Replaces a rejected candidate: a random individual is drawn anew, a child's tournament is held again.
    fn again(&mut self, slot: usize) {
        let genes = self.space.lower.len();
        let state = &mut self.state;
        let own = slot * genes..(slot + 1) * genes;
        if state.generation > 0 {
            state.joints[own].copy_from_slice(&state.family[..genes]);
            return;
        }
        for (gene, value) in state.joints[own].iter_mut().enumerate() {
            *value = state.rng.between(self.space.lower[gene], self.space.upper[gene]);
        }
        state.waiting.push_next(&mut state.next_id, slot);
    }
}

impl PerGoalMethod for SstSpec {
    fn start(&self, space: SearchSpace, seed: u64, goal: u64) -> Result<Box<dyn Optimizer>, OptimizerError> {
        Ok(Box::new(Sst::new(self, space, seed, goal)?))
    }

    fn resume(&self, space: SearchSpace, state: OptimizerState) -> Result<Box<dyn Optimizer>, OptimizerError> {
        Ok(Box::new(Sst::resume(self, space, state.read(Self::NAME)?)?))
    }
}

impl Optimizer for Sst {
    fn ask(&mut self, batch: &mut Batch) {
        if self.state.stop.is_some() {
            return;
        }
        if self.state.waiting.is_empty() {
            self.breed();
        }
        self.state.waiting.hand_out(batch, &self.state.joints, self.space.lower.len());
    }

    fn tell(&mut self, id: u64, outcome: Outcome<'_>) {
        let Some(slot) = self.state.waiting.remove(id) else { return };
        let features = self.space.features;
        match outcome {
            Outcome::Observed { fitness, observation, provenance } => {
                self.state.fitness[slot] = fitness;
                self.state.provenance[slot] = provenance;
                self.state.observations[slot * features..(slot + 1) * features].copy_from_slice(observation);
                let early = !self.spec.ecf_target_at_generation_end;
                if early && self.space.target.is_some_and(|target| fitness <= target) {
                    self.state.stop = Some(StopReason::Target);
                    return;
                }
            }
            Outcome::Penalised { fitness } => {
                self.state.fitness[slot] = fitness;
                self.state.provenance[slot] = Provenance::Penalised;
            }
            Outcome::Failed => {
                self.state.fitness[slot] = f64::INFINITY;
                self.state.provenance[slot] = Provenance::Penalised;
            }
            Outcome::Rejected => return self.again(slot),
        }
        if !self.state.waiting.is_empty() {
            return;
        }
        if self.state.generation > 0 {
            self.state.iteration += 1;
        }
        if self.state.generation == 0 || self.state.iteration == self.spec.population {
            self.end_generation();
        }
    }

    fn best(&self) -> Option<Best<'_>> {
        Incumbent::or_better(self.state.hall.as_ref(), self.best_slot().map(|slot| self.as_best(slot)))
    }

    fn stop(&self) -> Option<StopReason> {
        self.state.stop
    }

    fn state(&self) -> OptimizerState {
        debug_assert_eq!(self.state.version, STATE_VERSION);
        OptimizerState::of(SstSpec::NAME, &self.state)
    }

    fn generation(&self) -> u64 {
        self.state.generation
    }

    fn origins(&self, id: u64) -> [Option<&[f64]>; 2] {
        let genes = self.space.lower.len();
        let bred = self.state.generation > 0 && self.state.waiting.slot(id).is_some();
        let parent = |index: usize| bred.then(|| &self.state.family[index * genes..(index + 1) * genes]);
        [parent(1), parent(2)]
    }

    fn amend(&mut self, id: u64, joints: &[f64]) {
        if let Some(slot) = self.state.waiting.slot(id) {
            let genes = self.space.lower.len();
            self.state.joints[slot * genes..(slot + 1) * genes].copy_from_slice(joints);
        }
    }
}
