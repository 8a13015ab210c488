//! Candidates on their way from optimiser to world: flat and reused, so that a batch needs no allocation.

/// Up to `capacity` candidates of n genes.
#[derive(Debug, Clone, PartialEq)]
pub struct Batch {
    genes: usize,
    capacity: usize,
    ids: Vec<u64>,
    joints: Vec<f64>,
}

impl Batch {
    /// An empty batch for candidates of `genes` genes (at least 1).
    #[must_use]
    pub fn new(genes: usize, capacity: usize) -> Self {
        let genes = genes.max(1);
        Self { genes, capacity, ids: Vec::with_capacity(capacity), joints: Vec::with_capacity(capacity * genes) }
    }

    /// Empties the batch and sets its capacity.
    pub fn clear(&mut self, capacity: usize) {
        self.ids.clear();
        self.joints.clear();
        self.capacity = capacity;
    }

    /// Adds a candidate.
    ///
    /// # Panics
    /// If `joints` does not have as many values as the batch has genes.
    pub fn push(&mut self, id: u64, joints: &[f64]) {
        assert_eq!(joints.len(), self.genes, "a candidate has one value per gene");
        self.ids.push(id);
        self.joints.extend_from_slice(joints);
    }

    /// Whether the capacity is reached.
    #[must_use]
    pub fn is_full(&self) -> bool {
        self.ids.len() >= self.capacity
    }

    /// Number of candidates.
    #[must_use]
    pub fn len(&self) -> usize {
        self.ids.len()
    }

    /// Whether there are no candidates.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.ids.is_empty()
    }

    /// Iterates over the candidates: id and joints (rad or m).
    #[must_use]
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (u64, &[f64])> {
        self.ids.iter().copied().zip(self.joints.chunks_exact(self.genes))
    }
}
