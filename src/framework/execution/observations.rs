//! What was seen of candidates, on its way back to the run: flat and reused, as batches are.

use crate::method::per_goal::Provenance;

/// What was seen of a candidate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Seen<'a> {
    /// All features of the world.
    Features(&'a [f64]),
    /// It was executed, but a value is not finite: the observation is lost. An evaluation all the same.
    Lost,
    /// It could not be executed: no evaluation.
    Failed,
}

impl<'a> Seen<'a> {
    /// The features, where there are any.
    #[must_use]
    pub fn features(self) -> Option<&'a [f64]> {
        match self {
            Self::Features(values) => Some(values),
            Self::Lost | Self::Failed => None,
        }
    }
}

/// Observations (all features of the world) of candidates, or their failures.
#[derive(Debug, Clone, PartialEq)]
pub struct Observations {
    genes: usize,
    features: usize,
    provenance: Provenance,
    ids: Vec<u64>,
    failed: Vec<bool>,
    joints: Vec<f64>,
    values: Vec<f64>,
}

impl Observations {
    /// None yet, for candidates of `genes` genes and observations of `features` values, executed as `provenance` says.
    #[must_use]
    pub fn new(genes: usize, features: usize, provenance: Provenance) -> Self {
        Self {
            genes,
            features,
            provenance,
            ids: Vec::new(),
            failed: Vec::new(),
            joints: Vec::new(),
            values: Vec::new(),
        }
    }

    /// Forgets all.
    pub fn clear(&mut self) {
        self.ids.clear();
        self.failed.clear();
        self.joints.clear();
        self.values.clear();
    }

    /// Candidate `id` was executed at `joints`; the caller writes what was seen into the returned row.
    ///
    /// # Panics
    /// If `joints` has another length than genes.
    pub fn observed(&mut self, id: u64, joints: &[f64]) -> &mut [f64] {
        self.push(id, joints, false)
    }

    /// Candidate `id` could not be executed at `joints`.
    ///
    /// # Panics
    /// If `joints` has another length than genes.
    pub fn failed(&mut self, id: u64, joints: &[f64]) {
        self.push(id, joints, true);
    }

    fn push(&mut self, id: u64, joints: &[f64], failed: bool) -> &mut [f64] {
        assert_eq!(joints.len(), self.genes, "a candidate has one value a gene");
        self.ids.push(id);
        self.failed.push(failed);
        self.joints.extend_from_slice(joints);
        let start = self.values.len();
        self.values.resize(start + self.features, 0.0);
        &mut self.values[start..]
    }

    /// Where the candidates were executed.
    #[must_use]
    pub fn provenance(&self) -> Provenance {
        self.provenance
    }

    /// Id, joints and fate of each candidate.
    pub fn iter(&self) -> impl Iterator<Item = (u64, &[f64], Seen<'_>)> {
        let rows = self.joints.chunks_exact(self.genes).zip(self.values.chunks_exact(self.features));
        self.ids.iter().zip(&self.failed).zip(rows).map(|((&id, &failed), (joints, values))| {
            let seen = match failed {
                true => Seen::Failed,
                false if values.iter().all(|v| v.is_finite()) => Seen::Features(values),
                false => Seen::Lost,
            };
            (id, joints, seen)
        })
    }
}
