//! The particle swarm that PSO, FI-PSO and AFFG-PSO share; they differ in how a moved particle gets its fitness.
//!
//! P particles, uniform in the limits, all executed. Then each generation: (a) a particle whose fitness is below that
//! of its memory remembers its position (in generation 1 only the fitness: the position was set at the start); (b) the
//! particles move in order ([`movement`]) and get a fitness, by execution or by an [`Estimator`]. At its end the best of
//! the swarm (the last on ties) enters the hall of fame if strictly better than the one there; the search stops when
//! more than S generations have passed since the hall last changed, or [`MOST_ESTIMATES`] moves in a row were estimated.
//!
//! # Invariants
//! - The bits do not depend on how many candidates are asked for at once: a particle moves before an earlier one was
//!   told only if its move cannot depend on it (leader by memory, estimator without memory of the generation).
//! - Only executed particles enter the hall, unless `unexecuted_may_win`.

mod movement;
mod spec;
mod state;
#[cfg(test)]
mod tests;

pub use spec::{Leader, SwarmSpec, VelocityClamp};
pub use state::SwarmState;

use super::incumbent::Incumbent;
use super::{
    Batch, Best, Optimizer, OptimizerError, OptimizerState, Outcome, Provenance, SearchSpace, StopReason, Tally,
};
use crate::random::RandomStream;
use movement::{Pull, fly};

/// Number of moves, in whole generations without an execution, after which a swarm counts as stagnant. Whoever asks for a
/// candidate waits meanwhile, and S may be billions of generations.
const MOST_ESTIMATES: u64 = 1_000_000;

/// A particle that has moved, and what its fitness may be estimated from.
pub(super) struct Flight<'a> {
    /// Its new position.
    pub x: &'a [f64],
    /// Its fitness before the move.
    pub fitness: f64,
    /// Fitness of its own memory.
    pub memory: f64,
    /// Fitness of the leader's memory.
    pub leader: f64,
    /// Mean c1 R1 and c2 R2 of the move.
    pub weights: [f64; 2],
}

/// Gives moved particles a fitness without executing them.
pub(super) trait Estimator: Send {
    /// The method's name.
    const METHOD: &'static str;
    /// Origin of its estimates.
    const PROVENANCE: Provenance;

    /// Whether estimates of one generation depend on its executions.
    fn depends_on_order(&self) -> bool;
    /// Whether an estimated particle may be the result.
    fn may_win(&self) -> bool;
    /// A generation begins with these fitness values.
    fn begin(&mut self, fitness: &[f64]);
    /// A fitness for that particle; `None` if it must be executed.
    fn estimate(&mut self, flight: &Flight<'_>, rng: &mut RandomStream) -> Option<f64>;
    /// A moved particle was executed.
    fn executed(&mut self, x: &[f64], fitness: f64);
    /// State of the swarm together with the estimator.
    fn save(&self, swarm: SwarmState) -> OptimizerState;
}

/// A particle swarm with an estimator.
#[derive(Debug)]
pub(super) struct Swarm<E> {
    spec: SwarmSpec,
    space: SearchSpace,
    state: SwarmState,
    estimator: E,
}

impl<E: Estimator> Swarm<E> {
    pub fn new(
        spec: &SwarmSpec,
        estimator: E,
        space: SearchSpace,
        seed: u64,
        stream: u64,
    ) -> Result<Self, OptimizerError> {
        OptimizerError::check(E::METHOD, spec)?;
        let state = SwarmState::new(spec, &space, seed, stream);
        Ok(Self { spec: spec.clone(), space, state, estimator })
    }

    pub fn resume(
        spec: &SwarmSpec,
        estimator: E,
        space: SearchSpace,
        state: SwarmState,
    ) -> Result<Self, OptimizerError> {
        OptimizerError::check(E::METHOD, spec)?;
        state.check(E::METHOD, spec.population as usize, &space)?;
        Ok(Self { spec: spec.clone(), space, state, estimator })
    }

    fn row(&self, slot: usize) -> std::ops::Range<usize> {
        let genes = self.space.lower.len();
        slot * genes..(slot + 1) * genes
    }

    fn leader(&self) -> usize {
        let (values, last_on_ties) = match self.spec.leader {
            Leader::BestMemory => (&self.state.memory_fitness, false),
            Leader::CurrentBest => (&self.state.fitness, true),
        };
        let mut leader = 0;
        for (slot, value) in values.iter().enumerate() {
            if *value < values[leader] || (last_on_ties && *value == values[leader]) {
                leader = slot;
            }
        }
        leader
    }

    /// Moves particle `slot`; it then waits for its fitness, next in turn, unless it `may_estimate` and is estimated.
    fn move_particle(&mut self, slot: usize, may_estimate: bool) {
        let leader = self.leader();
        let (own, leads) = (self.row(slot), self.row(leader));
        let state = &mut self.state;
        state.x_before[own.clone()].copy_from_slice(&state.x[own.clone()]);
        state.v_before[own.clone()].copy_from_slice(&state.v[own.clone()]);
        let pull = Pull { memory: &state.memory[own.clone()], leader: &state.memory[leads] };
        let (x, v) = (&mut state.x[own.clone()], &mut state.v[own.clone()]);
        let weights = fly(&self.spec, &self.space, &pull, x, v, &mut state.rng);
        let flight = Flight {
            x: &state.x[own],
            fitness: state.fitness[slot],
            memory: state.memory_fitness[slot],
            leader: state.memory_fitness[leader],
            weights,
        };
        if may_estimate && let Some(fitness) = self.estimator.estimate(&flight, &mut state.rng) {
            state.fitness[slot] = fitness;
            state.provenance[slot] = E::PROVENANCE;
            match E::PROVENANCE {
                Provenance::Granule => state.tally.granule += 1,
                _ => state.tally.inherited += 1,
            }
            return;
        }
        state.waiting.push_next(&mut state.next_id, slot);
    }

    /// Once every particle has its fitness: updates the hall of fame, applies the stop rules and starts the next
    /// generation.
    fn end_generation_if_settled(&mut self) {
        let population = self.spec.population as usize;
        if !self.state.waiting.is_empty() || (self.state.generation > 0 && self.state.moved < population) {
            return;
        }
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
        state.moved = 0;
        if state.stop.is_none() {
            self.remember();
            self.estimator.begin(&self.state.fitness);
        }
    }

    fn remember(&mut self) {
        for slot in 0..self.spec.population as usize {
            let own = self.row(slot);
            let state = &mut self.state;
            if state.generation == 1 {
                state.memory_fitness[slot] = state.fitness[slot];
            } else if state.fitness[slot] < state.memory_fitness[slot] {
                state.memory_fitness[slot] = state.fitness[slot];
                state.memory[own.clone()].copy_from_slice(&state.x[own]);
            }
        }
    }

    /// The best particle that may win, the last on ties; `None` if none has a finite fitness.
    fn best_slot(&self) -> Option<usize> {
        let may_win = |provenance: Provenance| provenance != E::PROVENANCE || self.estimator.may_win();
        let (mut best, mut smallest) = (None, f64::INFINITY);
        for (slot, (&value, &provenance)) in self.state.fitness.iter().zip(&self.state.provenance).enumerate() {
            if value <= smallest && value < f64::INFINITY && may_win(provenance) {
                (best, smallest) = (Some(slot), value);
            }
        }
        best
    }

    fn as_best(&self, slot: usize) -> Best<'_> {
        let features = self.space.features;
        Best {
            joints: &self.state.x[self.row(slot)],
            fitness: self.state.fitness[slot],
            observation: &self.state.observations[slot * features..(slot + 1) * features],
            provenance: self.state.provenance[slot],
        }
    }

    /// Proposes another position for a rejected one.
    fn again(&mut self, slot: usize) {
        let own = self.row(slot);
        let state = &mut self.state;
        if state.generation > 0 {
            state.x[own.clone()].copy_from_slice(&state.x_before[own.clone()]);
            state.v[own.clone()].copy_from_slice(&state.v_before[own]);
            self.move_particle(slot, false); // an estimate would let it pass unjudged
            return;
        }
        for gene in 0..self.space.lower.len() {
            let drawn = state.rng.between(self.space.lower[gene], self.space.upper[gene]);
            let place = own.start + gene;
            state.x[place] = drawn;
            state.x_before[place] = drawn;
            if !self.spec.ecf_memory_quirk {
                state.memory[place] = drawn;
            }
        }
        state.waiting.push_next(&mut state.next_id, slot);
    }
}

impl<E: Estimator> Optimizer for Swarm<E> {
    fn ask(&mut self, batch: &mut Batch) {
        let ahead = self.spec.leader == Leader::BestMemory && !self.estimator.depends_on_order();
        let mut idle_moves = 0;
        while self.state.stop.is_none() && !batch.is_full() {
            if self.state.waiting.has_more() {
                self.state.waiting.hand_out(batch, &self.state.x, self.space.lower.len());
                continue;
            }
            let all_moved = self.state.generation == 0 || self.state.moved == self.spec.population as usize;
            if all_moved || !(ahead || self.state.waiting.is_empty()) {
                return;
            }
            let slot = self.state.moved;
            self.state.moved += 1;
            self.move_particle(slot, true);
            let generation = self.state.generation;
            self.end_generation_if_settled();
            if self.state.generation > generation {
                let idle = self.state.provenance.iter().all(|&provenance| provenance == E::PROVENANCE);
                idle_moves = if idle { idle_moves + u64::from(self.spec.population) } else { 0 };
            }
            if idle_moves >= MOST_ESTIMATES {
                self.state.stop = self.state.stop.or(Some(StopReason::Stagnation));
            }
        }
    }

    fn tell(&mut self, id: u64, outcome: Outcome<'_>) {
        let Some(slot) = self.state.waiting.remove(id) else { return };
        let (own, features) = (self.row(slot), self.space.features);
        let state = &mut self.state;
        match outcome {
            Outcome::Observed { fitness, observation, provenance } => {
                state.fitness[slot] = fitness;
                state.provenance[slot] = provenance;
                state.observations[slot * features..(slot + 1) * features].copy_from_slice(observation);
                if state.generation > 0 {
                    self.estimator.executed(&state.x[own], fitness);
                }
                let early = !self.spec.ecf_target_at_generation_end;
                if early && self.space.target.is_some_and(|target| fitness <= target) {
                    state.stop = Some(StopReason::Target);
                    return;
                }
            }
            Outcome::Penalised { fitness } => {
                state.fitness[slot] = fitness;
                state.provenance[slot] = Provenance::Penalised;
            }
            Outcome::Failed => {
                state.fitness[slot] = f64::INFINITY;
                state.provenance[slot] = Provenance::Penalised;
            }
            Outcome::Rejected => self.again(slot),
        }
        self.end_generation_if_settled();
    }

    fn best(&self) -> Option<Best<'_>> {
        Incumbent::or_better(self.state.hall.as_ref(), self.best_slot().map(|slot| self.as_best(slot)))
    }

    fn stop(&self) -> Option<StopReason> {
        self.state.stop
    }

    fn state(&self) -> OptimizerState {
        self.estimator.save(self.state.clone())
    }

    fn generation(&self) -> u64 {
        self.state.generation
    }

    fn origins(&self, id: u64) -> [Option<&[f64]>; 2] {
        let moved = self.state.waiting.slot(id).filter(|_| self.state.generation > 0);
        [moved.map(|slot| &self.state.x_before[self.row(slot)]), None]
    }

    fn amend(&mut self, id: u64, joints: &[f64]) {
        let Some(slot) = self.state.waiting.slot(id) else { return };
        let own = self.row(slot);
        let state = &mut self.state;
        state.x[own.clone()].copy_from_slice(joints);
        if state.generation == 0 {
            state.x_before[own.clone()].copy_from_slice(joints);
            if !self.spec.ecf_memory_quirk {
                state.memory[own].copy_from_slice(joints);
            }
            return;
        }
        for place in own {
            state.v[place] = state.x[place] - state.x_before[place];
        }
    }

    fn tally(&self) -> Tally {
        self.state.tally
    }
}
