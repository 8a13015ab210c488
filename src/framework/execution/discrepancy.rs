//! Discrepancy of a growing observation O_1..O_j against X_1..X_j, computing one row of the DTW matrix per candidate.
//!
//! The row of O_1..O_j-1 is kept over all n goals, so that a candidate costs j local distances and one row. The bits
//! equal those of warping the whole observation anew.

use crate::generalization::Goals;
use crate::recognition::Metric;
use crate::recognition::dtw::{Border, extend_row, local_distances};

/// Partial observation of one run under one metric.
#[derive(Debug, Clone)]
pub struct PartialDiscrepancy {
    border: Border,
    /// Number of features per path: m, or 1 if each feature has its own path.
    width: usize,
    /// Whether a path's cost is divided by its length, as in `sum_of_features`.
    normalised: bool,
    planes: Vec<Plane>,
    local: Vec<f64>,
    row: Vec<f64>,
    observed: usize,
}

#[derive(Debug, Clone)]
struct Plane {
    /// Goals, n x width, row-major.
    goals: Vec<f64>,
    /// Row j-1 of the accumulated matrix over all n goals; empty before the first observation.
    previous: Vec<f64>,
}

impl PartialDiscrepancy {
    /// Starts without observations.
    #[must_use]
    pub fn new(goals: &Goals, metric: Metric) -> Self {
        let m = goals.features().len();
        let (border, planes): (_, Vec<Vec<f64>>) = match metric {
            Metric::Multivariate => (Border::Accumulated, vec![goals.values().to_vec()]),
            Metric::Aquila => (Border::Local, vec![goals.values().to_vec()]),
            Metric::SumOfFeatures => {
                let column = |k| goals.rows().map(|row| row[k]).collect();
                (Border::Accumulated, (0..m).map(column).collect())
            }
        };
        Self {
            border,
            width: if metric == Metric::SumOfFeatures { 1 } else { m },
            normalised: metric == Metric::SumOfFeatures,
            planes: planes.into_iter().map(|goals| Plane { goals, previous: Vec::new() }).collect(),
            local: vec![0.0; goals.len()],
            row: vec![0.0; goals.len()],
            observed: 0,
        }
    }

    /// Discrepancy (features' unit) of O_1..O_j-1 followed by `observation` (m values) against X_1..X_j, where j - 1
    /// observations have been appended before; does not allocate.
    ///
    /// # Panics
    /// If all n observations have been appended or `observation` does not have m values.
    #[must_use]
    pub fn of(&mut self, observation: &[f64]) -> f64 {
        let columns = self.observed + 1;
        // Sum of features: each path is normalised by its number of rows, observed plus goals.
        let length = if self.normalised { 2.0 * columns as f64 } else { 1.0 };
        let mut sum = 0.0;
        for (plane, part) in self.planes.iter().zip(observation.chunks_exact(self.width)) {
            local_distances(part, &plane.goals, &mut self.local[..columns]);
            extend_row(&plane.previous, &self.local[..columns], self.border, &mut self.row[..columns]);
            sum += self.row[columns - 1] / length;
        }
        sum
    }

    /// Appends `observation` (m values) as O_j.
    ///
    /// # Panics
    /// As for [`PartialDiscrepancy::of`].
    pub fn append(&mut self, observation: &[f64]) {
        for (plane, part) in self.planes.iter_mut().zip(observation.chunks_exact(self.width)) {
            local_distances(part, &plane.goals, &mut self.local);
            extend_row(&plane.previous, &self.local, self.border, &mut self.row);
            plane.previous.clear();
            plane.previous.extend_from_slice(&self.row);
        }
        self.observed += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Feature;
    use crate::recognition::discrepancy;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn incremental_equals_whole_to_the_last_bit(
            goals in prop::collection::vec(prop::collection::vec(-9.0..9.0_f64, 2), 1..8),
            seen in prop::collection::vec(-9.0..9.0_f64, 16)
        ) {
            let features = vec![Feature::new("a", ""), Feature::new("b", "")];
            let matrix = Goals::new(features, &goals).unwrap();
            for metric in [Metric::Multivariate, Metric::Aquila, Metric::SumOfFeatures] {
                let mut partial = PartialDiscrepancy::new(&matrix, metric);
                for j in 1..=goals.len() {
                    let observation = &seen[2 * (j - 1)..2 * j];
                    let whole = discrepancy(metric, &seen[..2 * j], &matrix.values()[..2 * j], 2);
                    prop_assert_eq!(partial.of(observation).to_bits(), whole.to_bits());
                    partial.append(observation);
                }
            }
        }
    }
}
