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
mod state;
#[cfg(test)]
mod tests;

pub use state::SstState;

use super::{
    Batch, Best, BoundsRule, Optimizer, OptimizerError, OptimizerState, Outcome, Provenance, SearchSpace, SstSpec,
    StopReason,
};
use operators::{CROSSOVERS, Parents, mutate};
use state::{Hall, STATE_VERSION, Waiting};

/// The steady-state tournament; see the module for the algorithm.
#[derive(Debug)]
pub struct Sst {
    spec: SstSpec,
    space: SearchSpace,
    state: SstState,
    /// How many of `state.waiting` were handed out since start or resume.
    handed: usize,
    parents: [Vec<f64>; 2],
}

impl Sst {
    /// A fresh search: population drawn, nothing evaluated.
    ///
    /// # Errors
    /// [`OptimizerError::Parameter`] for a population below 3 or a probability outside 0 to 1.
    pub fn new(spec: &SstSpec, space: SearchSpace, seed: u64, stream: u64) -> Result<Self, OptimizerError> {
        check(spec)?;
        let state = SstState::new(spec.population as usize, &space, seed, stream);
        Ok(Self::with(spec, space, state))
    }

    /// Goes on from a saved state.
    ///
    /// # Errors
    /// [`OptimizerError`] if the state's version or shape does not fit.
    pub fn resume(spec: &SstSpec, space: SearchSpace, state: SstState) -> Result<Self, OptimizerError> {
        check(spec)?;
        state.check(spec.population as usize, &space)?;
        Ok(Self::with(spec, space, state))
    }

    fn with(spec: &SstSpec, space: SearchSpace, state: SstState) -> Self {
        let genes = space.lower.len();
        Self { spec: spec.clone(), space, state, handed: 0, parents: [vec![0.0; genes], vec![0.0; genes]] }
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
        for (copy, individual) in self.parents.iter_mut().zip([i1, i2]) {
            copy.copy_from_slice(&state.joints[individual * genes..(individual + 1) * genes]);
        }
        let parents = Parents {
            p1: &self.parents[0],
            p2: &self.parents[1],
            fitness: [state.fitness[i1], state.fitness[i2]],
            lower: &self.space.lower,
            upper: &self.space.upper,
            first: usize::from(self.spec.ecf_gene0_quirk),
        };
        let child = &mut state.joints[slot * genes..(slot + 1) * genes];
        let (_, crossover) = CROSSOVERS[state.rng.below(CROSSOVERS.len())];
        crossover(&parents, child, &mut state.rng);
        if state.rng.unit() < self.spec.mutation_probability {
            mutate(child, &self.space.lower, &self.space.upper, &mut state.rng);
        }
        if self.spec.bounds == BoundsRule::Clamp {
            for (gene, value) in child.iter_mut().enumerate() {
                *value = value.clamp(self.space.lower[gene], self.space.upper[gene]);
            }
        }
        state.fitness[slot] = f64::INFINITY;
        state.waiting.push(Waiting { id: state.next_id, slot });
        state.next_id += 1;
        self.handed = 0;
    }

    /// Hall of fame and stop rules; `state.generation` is the one that ends.
    fn end_generation(&mut self) {
        let best = self.best_slot();
        let state = &mut self.state;
        let best_fitness = best.map_or(f64::INFINITY, |slot| state.fitness[slot]);
        if let Some(slot) = best
            && state.hall.as_ref().is_none_or(|hall| best_fitness < hall.fitness)
        {
            let (genes, features) = (self.space.lower.len(), self.space.features);
            state.hall = Some(Hall {
                joints: state.joints[slot * genes..(slot + 1) * genes].to_vec(),
                observation: state.observations[slot * features..(slot + 1) * features].to_vec(),
                fitness: best_fitness,
                provenance: state.provenance[slot],
            });
            state.last_change = state.generation;
        }
        if self.space.target.is_some_and(|target| best_fitness <= target) {
            state.stop = Some(StopReason::Target);
        } else if state.generation - state.last_change > u64::from(self.spec.stagnation) {
            state.stop = Some(StopReason::Stagnation);
        }
        state.generation += 1;
        state.iteration = 0;
    }

    /// The best individual of the population, the last on ties; none if none was executed.
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

fn check(spec: &SstSpec) -> Result<(), OptimizerError> {
    let out = |parameter, value, expected| OptimizerError::Parameter { method: "sst", parameter, value, expected };
    if !(3..=100_000).contains(&spec.population) {
        return Err(out("population", f64::from(spec.population), "3 to 100000 are allowed"));
    }
    if !(0.0..=1.0).contains(&spec.mutation_probability) {
        return Err(out("mutation_probability", spec.mutation_probability, "0 to 1 are allowed"));
    }
    Ok(())
}

impl Optimizer for Sst {
    fn ask(&mut self, batch: &mut Batch) {
        if self.state.stop.is_some() {
            return;
        }
        if self.state.waiting.is_empty() {
            self.breed();
        }
        let genes = self.space.lower.len();
        while !batch.is_full() && self.handed < self.state.waiting.len() {
            let Waiting { id, slot } = self.state.waiting[self.handed];
            batch.push(id, &self.state.joints[slot * genes..(slot + 1) * genes]);
            self.handed += 1;
        }
    }

    fn tell(&mut self, id: u64, outcome: Outcome<'_>) {
        let Some(position) = self.state.waiting.iter().position(|w| w.id == id) else { return };
        let slot = self.state.waiting.remove(position).slot;
        self.handed -= usize::from(position < self.handed);
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
            Outcome::Failed => {
                self.state.fitness[slot] = f64::INFINITY;
                self.state.provenance[slot] = Provenance::Penalised;
            }
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
        let (genes, features) = (self.space.lower.len(), self.space.features);
        let hall = self.state.hall.as_ref().map(|hall| Best {
            joints: &hall.joints,
            fitness: hall.fitness,
            observation: &hall.observation,
            provenance: hall.provenance,
        });
        let current = self.best_slot().map(|slot| Best {
            joints: &self.state.joints[slot * genes..(slot + 1) * genes],
            fitness: self.state.fitness[slot],
            observation: &self.state.observations[slot * features..(slot + 1) * features],
            provenance: self.state.provenance[slot],
        });
        match (hall, current) {
            (Some(hall), Some(current)) => Some(if current.fitness < hall.fitness { current } else { hall }),
            (hall, current) => hall.or(current),
        }
    }

    fn stop(&self) -> Option<StopReason> {
        self.state.stop
    }

    fn state(&self) -> OptimizerState {
        debug_assert_eq!(self.state.version, STATE_VERSION);
        OptimizerState::Sst(self.state.clone())
    }
}
