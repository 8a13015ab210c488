//! Candidates that wait for their fitness, in the order in which they are handed out.
//!
//! # Invariants
//! - The candidates already handed out come first. A saved list does not say how many those are: whoever resumes hands
//!   all of them out again, in the same order.
//! - A candidate keeps its id for life; each new one takes the next id of its search.

use super::batch::Batch;
use serde::{Deserialize, Serialize};

/// A candidate without a fitness: the id it is handed out under, and its row in the population.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
struct Pending {
    id: u64,
    slot: usize,
}

/// The candidates that wait; saved as their plain list.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub(super) struct Waiting {
    pending: Vec<Pending>,
    /// How many of them were handed out since start or resume.
    #[serde(skip)]
    handed: usize,
}

impl Waiting {
    /// A first population, one candidate per slot, with the slots' numbers as ids.
    pub fn first(population: usize) -> Self {
        Self { pending: (0..population).map(|slot| Pending { id: slot as u64, slot }).collect(), handed: 0 }
    }

    pub fn len(&self) -> usize {
        self.pending.len()
    }

    pub fn is_empty(&self) -> bool {
        self.pending.is_empty()
    }

    /// Whether some were not handed out yet.
    pub fn has_more(&self) -> bool {
        self.handed < self.pending.len()
    }

    /// Number of candidates in the first `population` slots.
    pub fn within(&self, population: usize) -> usize {
        self.pending.iter().filter(|candidate| candidate.slot < population).count()
    }

    /// Lets `slot` wait under id `next_id`, to be handed out after all others.
    pub fn push(&mut self, next_id: &mut u64, slot: usize) {
        self.insert(self.pending.len(), next_id, slot);
    }

    /// Lets `slot` wait under id `next_id`, to be handed out before all others.
    pub fn push_next(&mut self, next_id: &mut u64, slot: usize) {
        self.insert(self.handed, next_id, slot);
    }

    fn insert(&mut self, place: usize, next_id: &mut u64, slot: usize) {
        self.pending.insert(place, Pending { id: *next_id, slot });
        *next_id += 1;
    }

    /// Hands candidates out until `batch` is full; row `slot` of `joints` holds the n genes of a candidate.
    pub fn hand_out(&mut self, batch: &mut Batch, joints: &[f64], genes: usize) {
        while let Some(Pending { id, slot }) = self.pending.get(self.handed).filter(|_| !batch.is_full()) {
            batch.push(*id, &joints[slot * genes..(slot + 1) * genes]);
            self.handed += 1;
        }
    }

    /// The slot of candidate `id`; `None` if it does not wait.
    pub fn slot(&self, id: u64) -> Option<usize> {
        self.pending.iter().find(|candidate| candidate.id == id).map(|candidate| candidate.slot)
    }

    /// Ends the wait of candidate `id` and returns its slot; `None` if it does not wait.
    pub fn remove(&mut self, id: u64) -> Option<usize> {
        let place = self.pending.iter().position(|candidate| candidate.id == id)?;
        self.handed -= usize::from(place < self.handed);
        Some(self.pending.remove(place).slot)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ids(waiting: &mut Waiting, most: usize) -> Vec<u64> {
        let mut batch = Batch::new(1, most);
        waiting.hand_out(&mut batch, &[0.0; 8], 1);
        batch.iter().map(|(id, _)| id).collect()
    }

    #[test]
    fn a_replacement_is_next_in_turn_and_a_new_candidate_the_last() {
        let (mut waiting, mut next_id) = (Waiting::first(4), 4);
        assert_eq!(ids(&mut waiting, 2), [0, 1]);
        assert_eq!(waiting.remove(0), Some(0));
        waiting.push(&mut next_id, 5);
        waiting.push_next(&mut next_id, 0);
        assert_eq!(ids(&mut waiting, 9), [5, 2, 3, 4]);
        assert!(!waiting.has_more());
        assert_eq!((waiting.slot(5), waiting.slot(0), waiting.remove(0)), (Some(0), None, None));
    }

    #[test]
    fn a_saved_list_is_handed_out_again() {
        let mut waiting = Waiting::first(3);
        assert_eq!(ids(&mut waiting, 2), [0, 1]);
        let saved = serde_json::to_string(&waiting).unwrap();
        assert_eq!(saved, r#"[{"id":0,"slot":0},{"id":1,"slot":1},{"id":2,"slot":2}]"#);
        let mut resumed: Waiting = serde_json::from_str(&saved).unwrap();
        assert_eq!(ids(&mut resumed, 9), [0, 1, 2]);
        assert_eq!((resumed.len(), resumed.within(2)), (3, 2));
    }
}
