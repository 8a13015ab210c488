//! DE, differential evolution (DE/rand/1/bin): each member of a population is challenged by a mixture of others.
//!
//! A population of P vectors, uniform in the limits. In each generation every member x has one challenger u: with three
//! other members a, b, c drawn at random, `u_k = a_k + F (b_k - c_k)` in gene k with probability CR, and in one gene drawn
//! at random for certain; else `u_k = x_k`. The challenger takes the member's place in the next generation if its fitness
//! is at most the member's. The search stops when more than S generations brought no strict improvement.
//!
//! Invariants:
//! - `state.waiting` names exactly the vectors without a fitness; a generation is bred when none is waiting.
//! - All challengers of a generation are bred from the previous one, so that their outcomes may come in any order.
//!
//! Source: R. Storn, K. Price, "Differential Evolution - A Simple and Efficient Heuristic for Global Optimization over
//! Continuous Spaces", J. Global Optimization 11 (1997) 341-359, DOI 10.1023/A:1008202821328.

use super::waiting::Waiting;
use super::{
    Batch, Best, BoundsRule, Incumbent, Optimizer, OptimizerError, OptimizerState, Outcome, PerGoalMethod, Provenance,
    SearchSpace, StopReason,
};
use crate::infinite_as_null;
use crate::method::contract::{Method, Profile};
use crate::method::parameters::parameters;
use crate::random::RandomStream;
use crate::range::above;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Version of [`Memory`]; changes when its meaning does.
const STATE_VERSION: u32 = 1;

parameters! {
    /// Parameters of differential evolution.
    pub struct DeSpec {
        /// Members P of the population.
        pub population: u32 = 30, in 4..=100_000;
        /// S: a goal ends after S + 1 generations without strict improvement.
        pub stagnation: u32 = 10;
        /// F: weight of the difference of two members.
        pub weight: f64 = 0.7, in above(0.0).up_to(2.0);
        /// CR: probability that a gene is taken from the mixture.
        pub crossover: f64 = 0.9, in 0.0..=1.0;
        /// Treatment of genes outside their limits.
        pub bounds: BoundsRule = BoundsRule::Reflect;
    }
}

impl Method for DeSpec {
    fn profile(&self) -> Profile {
        Profile::PER_GOAL
    }
}

impl PerGoalMethod for DeSpec {
    fn start(&self, space: SearchSpace, seed: u64, goal: u64) -> Result<Box<dyn Optimizer>, OptimizerError> {
        OptimizerError::check(Self::NAME, self)?;
        let memory = Memory::new(self.population as usize, &space, seed, goal);
        Ok(Box::new(Search { spec: self.clone(), space, memory }))
    }

    fn resume(&self, space: SearchSpace, state: OptimizerState) -> Result<Box<dyn Optimizer>, OptimizerError> {
        OptimizerError::check(Self::NAME, self)?;
        let memory: Memory = state.read(Self::NAME)?;
        memory.check(self.population as usize, &space)?;
        Ok(Box::new(Search { spec: self.clone(), space, memory }))
    }
}

/// Everything the search remembers. Matrices are row-major, one row per member.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Memory {
    version: u32,
    rng: RandomStream,
    members: Vec<f64>,
    /// Infinite if never executed or failed.
    #[serde(with = "infinite_as_null")]
    fitness: Vec<f64>,
    challengers: Vec<f64>,
    #[serde(with = "infinite_as_null")]
    challenger_fitness: Vec<f64>,
    /// Per challenger, the member that the difference was added to.
    bases: Vec<usize>,
    waiting: Waiting,
    next_id: u64,
    /// 0 while the first members are evaluated: they have no rivals yet.
    generation: u64,
    last_change: u64,
    best: Option<Incumbent>,
    stop: Option<StopReason>,
}

/// A search for one goal; see the module for the algorithm.
struct Search {
    spec: DeSpec,
    space: SearchSpace,
    memory: Memory,
}

impl Memory {
    fn new(population: usize, space: &SearchSpace, seed: u64, goal: u64) -> Self {
        let mut rng = RandomStream::new(seed, goal);
        let limits = || space.lower.iter().zip(&space.upper);
        let drawn: Vec<f64> =
            (0..population).flat_map(|_| limits()).map(|(&low, &high)| rng.between(low, high)).collect();
        Self {
            version: STATE_VERSION,
            rng,
            members: drawn.clone(),
            fitness: vec![f64::INFINITY; population],
            challengers: drawn,
            challenger_fitness: vec![f64::INFINITY; population],
            bases: (0..population).collect(),
            waiting: Waiting::first(population),
            next_id: population as u64,
            generation: 0,
            last_change: 0,
            best: None,
            stop: None,
        }
    }

    /// Whether this memory was saved from a search of that shape.
    fn check(&self, population: usize, space: &SearchSpace) -> Result<(), OptimizerError> {
        if self.version != STATE_VERSION {
            return Err(OptimizerError::Version { method: DeSpec::NAME, found: self.version, expected: STATE_VERSION });
        }
        let (genes, best) = (space.lower.len(), self.best.as_ref());
        for (what, found, expected) in [
            ("fitness values", self.fitness.len(), population),
            ("challengers' fitness values", self.challenger_fitness.len(), population),
            ("genes", self.members.len(), population * genes),
            ("challengers' genes", self.challengers.len(), population * genes),
            ("bases", self.bases.iter().filter(|base| **base < population).count(), population),
            ("waiting vectors", self.waiting.within(population), self.waiting.len()),
            ("genes of the best", best.map_or(genes, |best| best.joints.len()), genes),
            ("features of the best", best.map_or(space.features, |best| best.observation.len()), space.features),
        ] {
            if found != expected {
                return Err(OptimizerError::Shape { method: DeSpec::NAME, what, found, expected });
            }
        }
        Ok(())
    }
}

impl Search {
    fn row(&self, slot: usize) -> Range<usize> {
        let genes = self.space.lower.len();
        slot * genes..(slot + 1) * genes
    }

    /// Makes a challenger of member `slot`.
    fn challenge(&mut self, slot: usize) {
        let (genes, population) = (self.space.lower.len(), self.spec.population as usize);
        let own = self.row(slot);
        let memory = &mut self.memory;
        let mut others = [slot; 3];
        for index in 0..others.len() {
            while others[index] == slot || others[..index].contains(&others[index]) {
                others[index] = memory.rng.below(population);
            }
        }
        let [a, b, c] = others;
        let certain = memory.rng.below(genes);
        for gene in 0..genes {
            let of = |member: usize| memory.members[member * genes + gene];
            let mixed = of(a) + self.spec.weight * (of(b) - of(c));
            let kept = of(slot);
            let takes = memory.rng.unit() < self.spec.crossover || gene == certain;
            let bounded = self.spec.bounds.apply(mixed, self.space.lower[gene], self.space.upper[gene]);
            memory.challengers[own.start + gene] = if takes { bounded } else { kept };
        }
        memory.bases[slot] = a;
        memory.challenger_fitness[slot] = f64::INFINITY;
    }

    /// Replaces a rejected vector by another, made in the same way and next in turn.
    fn again(&mut self, slot: usize) {
        if self.memory.generation > 0 {
            self.challenge(slot);
        } else {
            for gene in 0..self.space.lower.len() {
                let drawn = self.memory.rng.between(self.space.lower[gene], self.space.upper[gene]);
                let place = self.row(slot).start + gene;
                self.memory.challengers[place] = drawn;
            }
        }
        self.memory.waiting.push_next(&mut self.memory.next_id, slot);
    }

    /// Keeps the best: an executed vector beats a penalised one, and the earlier outcome wins a tie.
    fn remember(&mut self, slot: usize, fitness: f64, observation: &[f64], provenance: Provenance) {
        let executed = provenance.is_executed();
        let is_better = |best: &Incumbent| match (executed, best.provenance.is_executed()) {
            (true, false) => true,
            (false, true) => false,
            _ => fitness < best.fitness,
        };
        if self.memory.best.as_ref().is_none_or(is_better) {
            let joints = self.memory.challengers[self.row(slot)].to_vec();
            self.memory.best = Some(Incumbent { joints, observation: observation.to_vec(), fitness, provenance });
            self.memory.last_change = self.memory.generation;
        }
    }

    /// Lets challengers that are no worse replace their members; then breeds the next generation or stops the search.
    fn end_generation(&mut self) {
        for slot in 0..self.spec.population as usize {
            let own = self.row(slot);
            let memory = &mut self.memory;
            if memory.generation == 0 || memory.challenger_fitness[slot] <= memory.fitness[slot] {
                memory.fitness[slot] = memory.challenger_fitness[slot];
                memory.members[own.clone()].copy_from_slice(&memory.challengers[own]);
            }
        }
        if self.memory.generation - self.memory.last_change > u64::from(self.spec.stagnation) {
            self.memory.stop = Some(StopReason::Stagnation);
            return;
        }
        self.memory.generation += 1;
        for slot in 0..self.spec.population as usize {
            self.challenge(slot);
            self.memory.waiting.push(&mut self.memory.next_id, slot);
        }
    }
}

impl Optimizer for Search {
    fn ask(&mut self, batch: &mut Batch) {
        if self.memory.stop.is_some() {
            return;
        }
        self.memory.waiting.hand_out(batch, &self.memory.challengers, self.space.lower.len());
    }

    fn tell(&mut self, id: u64, outcome: Outcome<'_>) {
        let Some(slot) = self.memory.waiting.remove(id) else { return };
        match outcome {
            Outcome::Observed { fitness, observation, provenance } => {
                self.memory.challenger_fitness[slot] = fitness;
                self.remember(slot, fitness, observation, provenance);
                if self.space.target.is_some_and(|target| fitness <= target) {
                    self.memory.stop = Some(StopReason::Target);
                    return;
                }
            }
            Outcome::Penalised { fitness } => {
                self.memory.challenger_fitness[slot] = fitness;
                let unseen = vec![0.0; self.space.features];
                self.remember(slot, fitness, &unseen, Provenance::Penalised);
            }
            Outcome::Failed => {}
            Outcome::Rejected => return self.again(slot),
        }
        if self.memory.waiting.is_empty() {
            self.end_generation();
        }
    }

    fn best(&self) -> Option<Best<'_>> {
        self.memory.best.as_ref().map(Incumbent::as_best)
    }

    fn stop(&self) -> Option<StopReason> {
        self.memory.stop
    }

    fn state(&self) -> OptimizerState {
        OptimizerState::of(DeSpec::NAME, &self.memory)
    }

    fn generation(&self) -> u64 {
        self.memory.generation
    }

    fn origins(&self, id: u64) -> [Option<&[f64]>; 2] {
        let bred = self.memory.waiting.slot(id).filter(|_| self.memory.generation > 0);
        let member = |slot: usize| &self.memory.members[self.row(slot)];
        [bred.map(member), bred.map(|slot| member(self.memory.bases[slot]))]
    }

    fn amend(&mut self, id: u64, joints: &[f64]) {
        if let Some(slot) = self.memory.waiting.slot(id) {
            let own = self.row(slot);
            self.memory.challengers[own].copy_from_slice(joints);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn space(n: usize) -> SearchSpace {
        SearchSpace { lower: vec![-2.0; n], upper: vec![2.0; n], features: 1, target: None, near: None }
    }

    fn sphere(q: &[f64]) -> f64 {
        q.iter().map(|q| (q - 0.4).powi(2)).sum()
    }

    /// Minimum 0 at (1, .., 1), at the end of a bent valley.
    fn rosenbrock(q: &[f64]) -> f64 {
        q.windows(2).map(|w| 100.0 * (w[1] - w[0] * w[0]).powi(2) + (1.0 - w[0]).powi(2)).sum()
    }

    /// Tells at most `most` candidates, asked `size` at a time; every candidate by id, to the bit.
    fn drive(search: &mut dyn Optimizer, size: usize, most: usize, of: fn(&[f64]) -> f64) -> Vec<(u64, Vec<u64>)> {
        let (mut batch, mut seen) = (Batch::new(3, size), Vec::new());
        while search.stop().is_none() && seen.len() < most {
            batch.clear(size.min(most - seen.len()));
            search.ask(&mut batch);
            for (id, joints) in batch.iter() {
                seen.push((id, joints.iter().map(|q| q.to_bits()).collect()));
                let (fitness, provenance) = (of(joints), Provenance::Simulated);
                search.tell(id, Outcome::Observed { fitness, observation: &[fitness], provenance });
            }
        }
        seen.sort();
        seen
    }

    fn fresh(seed: u64) -> Box<dyn Optimizer> {
        DeSpec::default().start(space(3), seed, 0).unwrap()
    }

    #[test]
    fn finds_known_minima() {
        for (of, at) in [(sphere as fn(&[f64]) -> f64, 0.4), (rosenbrock, 1.0)] {
            for seed in 0..5 {
                let mut search = DeSpec { stagnation: 40, ..DeSpec::default() }.start(space(3), seed, 0).unwrap();
                let told = drive(search.as_mut(), 8, 20_000, of).len();
                let best = search.best().unwrap();
                assert!(best.joints.iter().all(|q| (q - at).abs() < 1e-2), "seed {seed}: {:?}", best.joints);
                assert_eq!((search.stop(), told < 20_000), (Some(StopReason::Stagnation), true));
            }
        }
    }

    #[test]
    fn stops_after_stagnation_plus_one_generations_without_strict_improvement() {
        let spec = DeSpec { population: 10, stagnation: 3, ..DeSpec::default() };
        let mut flat = spec.start(space(3), 1, 0).unwrap();
        assert_eq!(drive(flat.as_mut(), 7, usize::MAX, |_| 5.0).len(), 50);
    }

    #[test]
    fn a_target_ends_the_search_at_once() {
        let target = SearchSpace { target: Some(9.0), ..space(3) };
        let mut search = DeSpec::default().start(target, 1, 0).unwrap();
        assert_eq!(drive(search.as_mut(), 1, usize::MAX, |_| 9.0).len(), 1);
        assert_eq!(search.stop(), Some(StopReason::Target));
    }

    #[test]
    fn rejected_candidates_are_replaced_in_place_and_failures_never_win() {
        let mut search = fresh(3);
        let mut batch = Batch::new(3, 1);
        for round in 0..400 {
            batch.clear(1);
            search.ask(&mut batch);
            let (id, joints) = batch.iter().next().unwrap();
            let (fitness, provenance) = (sphere(joints), Provenance::Simulated);
            match round % 3 {
                0 => search.tell(id, Outcome::Rejected),
                1 => search.tell(id, Outcome::Failed),
                _ => search.tell(id, Outcome::Observed { fitness, observation: &[fitness], provenance }),
            }
        }
        let best = search.best().unwrap();
        assert_eq!(best.fitness, sphere(best.joints));
        assert!(search.generation() > 3);
    }

    proptest! {
        #[test]
        fn bits_do_not_depend_on_batch_sizes(seed: u64, size in 2_usize..50) {
            prop_assert_eq!(
                drive(fresh(seed).as_mut(), 1, usize::MAX, sphere),
                drive(fresh(seed).as_mut(), size, usize::MAX, sphere)
            );
        }

        #[test]
        fn interrupted_anywhere_the_search_ends_with_the_same_bits(
            seed: u64, cuts in prop::collection::vec(1_usize..90, 1..6)
        ) {
            let mut whole = fresh(seed);
            drive(whole.as_mut(), 1, usize::MAX, sphere);
            let mut cut = fresh(seed);
            for most in cuts {
                drive(cut.as_mut(), 4, most, sphere);
                cut.ask(&mut Batch::new(3, 5)); // asked and lost
                let saved = serde_json::to_string(&cut.state()).unwrap();
                cut = DeSpec::default().resume(space(3), serde_json::from_str(&saved).unwrap()).unwrap();
            }
            drive(cut.as_mut(), 4, usize::MAX, sphere);
            prop_assert_eq!(cut.state(), whole.state());
        }

        #[test]
        fn closed_bounds_are_kept(seed: u64) {
            let seen = drive(fresh(seed).as_mut(), 8, 2000, rosenbrock);
            prop_assert!(seen.iter().flat_map(|s| &s.1).all(|q| (-2.0..=2.0).contains(&f64::from_bits(*q))));
        }
    }

    #[test]
    fn golden() {
        let mut search = fresh(2024);
        let told = drive(search.as_mut(), 1, usize::MAX, rosenbrock).len();
        assert_eq!((told, search.best().unwrap().fitness), (720, 0.562_708_506_044_261_8));
    }

    #[test]
    fn parameters_and_states_that_do_not_fit_are_named() {
        let error = DeSpec { population: 3, ..DeSpec::default() }.start(space(3), 1, 0).err().unwrap().to_string();
        assert_eq!(error, "de: population is 3: give 4 to 100000");
        let error = DeSpec::default().resume(space(4), fresh(1).state()).err().unwrap().to_string();
        assert!(error.contains("belongs to another job"), "{error}");
    }
}
