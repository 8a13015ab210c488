//! Observations of candidates on their way back to the run; flat and reused, like batches.

use crate::method::per_goal::Provenance;

/// Result of executing a candidate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Seen<'a> {
    /// It was executed and observed: all features of the world.
    Observed(&'a [f64]),
    /// It was executed, but a value is missing or not finite. An evaluation all the same.
    Lost,
    /// Rejected before it started: does not count as an evaluation.
    Failed,
    /// It may or may not have been executed. The run learns nothing and asks for it again once it is resumed, so the
    /// caller must stop there.
    Unknown,
}

/// Fate of a candidate before its values are checked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Fate {
    Executed,
    Failed,
    Unknown,
}

impl<'a> Seen<'a> {
    /// The features, if it was observed.
    #[must_use]
    pub fn features(self) -> Option<&'a [f64]> {
        match self {
            Self::Observed(values) => Some(values),
            Self::Lost | Self::Failed | Self::Unknown => None,
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
    fates: Vec<Fate>,
    joints: Vec<f64>,
    values: Vec<f64>,
}

impl Observations {
    /// An empty list for candidates of `genes` values and observations of `features` values, executed where
    /// `provenance` says.
    #[must_use]
    pub fn new(genes: usize, features: usize, provenance: Provenance) -> Self {
        Self { genes, features, provenance, ids: Vec::new(), fates: Vec::new(), joints: Vec::new(), values: Vec::new() }
    }

    /// Removes all observations.
    pub fn clear(&mut self) {
        self.ids.clear();
        self.fates.clear();
        self.joints.clear();
        self.values.clear();
    }

    /// Records that candidate `id` was executed at `joints`; the caller writes the observation into the returned row.
    ///
    /// # Panics
    /// If `joints` does not have `genes` values.
    pub fn observed(&mut self, id: u64, joints: &[f64]) -> &mut [f64] {
        self.push(id, joints, Fate::Executed)
    }

    /// Records that candidate `id` could not be executed at `joints`.
    ///
    /// # Panics
    /// If `joints` does not have `genes` values.
    pub fn failed(&mut self, id: u64, joints: &[f64]) {
        self.push(id, joints, Fate::Failed);
    }

    /// Records that candidate `id` was executed at `joints`, but that its observation is missing.
    ///
    /// # Panics
    /// If `joints` does not have `genes` values.
    pub fn lost(&mut self, id: u64, joints: &[f64]) {
        self.observed(id, joints).fill(f64::NAN);
    }

    /// Records that nobody knows whether candidate `id` was executed at `joints`.
    ///
    /// # Panics
    /// If `joints` does not have `genes` values.
    pub fn unknown(&mut self, id: u64, joints: &[f64]) {
        self.push(id, joints, Fate::Unknown);
    }

    fn push(&mut self, id: u64, joints: &[f64], fate: Fate) -> &mut [f64] {
        assert_eq!(joints.len(), self.genes, "a candidate has one value per gene");
        self.ids.push(id);
        self.fates.push(fate);
        self.joints.extend_from_slice(joints);
        let start = self.values.len();
        self.values.resize(start + self.features, 0.0);
        &mut self.values[start..]
    }

    /// Place of execution: in simulation or on a robot.
    #[must_use]
    pub fn provenance(&self) -> Provenance {
        self.provenance
    }

    /// Iterates over id, joints and result of each candidate.
    pub fn iter(&self) -> impl Iterator<Item = (u64, &[f64], Seen<'_>)> {
        let rows = self.joints.chunks_exact(self.genes).zip(self.values.chunks_exact(self.features));
        self.ids.iter().zip(&self.fates).zip(rows).map(|((&id, &fate), (joints, values))| {
            let seen = match fate {
                Fate::Executed if values.iter().all(|v| v.is_finite()) => Seen::Observed(values),
                Fate::Executed => Seen::Lost,
                Fate::Failed => Seen::Failed,
                Fate::Unknown => Seen::Unknown,
            };
            (id, joints, seen)
        })
    }
}
