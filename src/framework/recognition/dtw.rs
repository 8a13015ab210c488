//! Dynamic time warping: the row kernel, the full matrix with its optimal path, and the distance in O(J) memory.
//!
//! Symbols: observation O of I rows, goals X of J rows, both over the same m features; local distance
//! `d[i][j] = |O_i - X_j|` (Euclidean); accumulated matrix
//! `D[i][j] = d[i][j] + min(D[i-1][j-1], D[i-1][j], D[i][j-1])`; the distance is `D[I-1][J-1]`, in the features' unit.
//! Row i of D depends on rows 0..i of O only: a caller that appends to O keeps the last row and calls [`extend_row`].
//!
//! Invariants: matrix, distance only, and row by row give the same bits, because all three run [`extend_row`].
//!
//! Source: H. Sakoe, S. Chiba, "Dynamic programming algorithm optimization for spoken word recognition", IEEE Trans.
//! ASSP 26 (1978), DOI 10.1109/TASSP.1978.1163055; `Border::Local` follows the Aquila library used for the paper.

use crate::distance::distance as euclidean;

/// Content of the first row and the first column of the accumulated matrix.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Border {
    /// Standard DTW: the running sum of local distances.
    Accumulated,
    /// Aquila's variant: the local distance alone.
    Local,
}

/// Local distances of one observation to each goal: `out[j] = sqrt(sum_k (observation[k] - goals[j][k])^2)`.
///
/// `observation` holds m values; `goals` is row-major with at least `out.len()` rows of m values.
///
/// # Panics
/// If `observation` is empty or `goals` has fewer than `out.len()` rows.
pub fn local_distances(observation: &[f64], goals: &[f64], out: &mut [f64]) {
    let m = observation.len();
    assert!(m > 0 && goals.len() >= out.len() * m, "{} goal values for {} goals of {m}", goals.len(), out.len());
    for (distance, goal) in out.iter_mut().zip(goals.chunks_exact(m)) {
        *distance = euclidean(observation, goal);
    }
}

/// Computes one row of the accumulated matrix from the previous one; does not allocate.
///
/// `previous` is row i-1, or empty for the first row; `local` holds `d[i][0..J]`; `out` receives `D[i][0..J]`. If
/// `previous` is longer than `local`, only its first `local.len()` columns are read, so a caller may keep full rows and
/// ask for the first j columns of the next.
///
/// # Panics
/// If `local` is empty, `out.len() != local.len()`, or `previous` is neither empty nor at least as long as `local`.
pub fn extend_row(previous: &[f64], local: &[f64], border: Border, out: &mut [f64]) {
    let columns = local.len();
    assert!(columns > 0 && out.len() == columns, "{} output cells for {columns} local distances", out.len());
    if previous.is_empty() {
        first_row(local, border, out);
        return;
    }
    assert!(previous.len() >= columns, "{} cells in the previous row for {columns} local distances", previous.len());
    let mut left = match border {
        Border::Accumulated => previous[0] + local[0],
        Border::Local => local[0],
    };
    out[0] = left;
    let mut diagonal = previous[0];
    for ((&above, &distance), cell) in previous[1..columns].iter().zip(&local[1..]).zip(&mut out[1..]) {
        left = distance + diagonal.min(above).min(left);
        *cell = left;
        diagonal = above;
    }
}

fn first_row(local: &[f64], border: Border, out: &mut [f64]) {
    match border {
        Border::Local => out.copy_from_slice(local),
        Border::Accumulated => {
            let mut sum = 0.0;
            for (&distance, cell) in local.iter().zip(out) {
                sum += distance;
                *cell = sum;
            }
        }
    }
}

/// Distance `D[I-1][J-1]` in O(J) memory.
///
/// `observed` and `goals` are row-major with `features` columns.
///
/// # Panics
/// If either is empty or not a whole number of rows.
#[must_use]
pub fn distance(observed: &[f64], goals: &[f64], features: usize, border: Border) -> f64 {
    let columns = check_shape(observed, goals, features);
    let mut local = vec![0.0; columns];
    let mut row = vec![0.0; columns];
    let mut previous: Vec<f64> = Vec::new();
    for observation in observed.chunks_exact(features) {
        local_distances(observation, goals, &mut local);
        extend_row(&previous, &local, border, &mut row);
        if previous.is_empty() {
            previous = vec![0.0; columns];
        }
        std::mem::swap(&mut previous, &mut row);
    }
    previous[columns - 1]
}

/// A distance with its optimal path.
#[derive(Debug, Clone, PartialEq)]
pub struct Alignment {
    /// `D[I-1][J-1]`, features' unit.
    pub distance: f64,
    /// Pairs (observed row, goal) from first to last; each step advances one of the two, or both, by one.
    pub path: Vec<(usize, usize)>,
}

/// Full matrix and optimal path; O(I x J) memory.
///
/// Ties are broken towards the diagonal, then towards the observation's previous row. With [`Border::Local`] the
/// accumulated value starts at a border cell, but the path still continues along the border to (0, 0), so that every
/// row and every goal is matched.
///
/// # Panics
/// If either is empty or not a whole number of rows.
#[must_use]
pub fn align(observed: &[f64], goals: &[f64], features: usize, border: Border) -> Alignment {
    let columns = check_shape(observed, goals, features);
    let rows = observed.len() / features;
    let mut local = vec![0.0; columns];
    let mut matrix: Vec<f64> = vec![0.0; rows * columns];
    for (i, observation) in observed.chunks_exact(features).enumerate() {
        local_distances(observation, goals, &mut local);
        let (done, rest) = matrix.split_at_mut(i * columns);
        let previous = if i == 0 { &[][..] } else { &done[(i - 1) * columns..] };
        extend_row(previous, &local, border, &mut rest[..columns]);
    }
    Alignment { distance: matrix[rows * columns - 1], path: backtrack(&matrix, rows, columns) }
}

fn backtrack(matrix: &[f64], rows: usize, columns: usize) -> Vec<(usize, usize)> {
    let at = |i: usize, j: usize| matrix[i * columns + j];
    let (mut i, mut j) = (rows - 1, columns - 1);
    let mut path = vec![(i, j)];
    while (i, j) != (0, 0) {
        (i, j) = match (i, j) {
            (0, _) => (0, j - 1),
            (_, 0) => (i - 1, 0),
            _ if at(i - 1, j - 1) <= at(i - 1, j) && at(i - 1, j - 1) <= at(i, j - 1) => (i - 1, j - 1),
            _ if at(i - 1, j) <= at(i, j - 1) => (i - 1, j),
            _ => (i, j - 1),
        };
        path.push((i, j));
    }
    path.reverse();
    path
}

fn check_shape(observed: &[f64], goals: &[f64], features: usize) -> usize {
    assert!(
        features > 0
            && !observed.is_empty()
            && !goals.is_empty()
            && observed.len().is_multiple_of(features)
            && goals.len().is_multiple_of(features),
        "{} observed and {} goal values are not rows of {features} features",
        observed.len(),
        goals.len()
    );
    goals.len() / features
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const OBSERVED: [f64; 3] = [0.0, 2.0, 3.0];
    const GOALS: [f64; 4] = [1.0, 1.0, 2.0, 5.0];

    #[test]
    fn known_value_with_standard_borders() {
        // D = [1 2 4 9; 2 2 2 5; 4 4 3 4]
        let alignment = align(&OBSERVED, &GOALS, 1, Border::Accumulated);
        assert_eq!(alignment.distance.to_bits(), 4.0_f64.to_bits());
        assert_eq!(alignment.path, [(0, 0), (0, 1), (1, 2), (2, 3)]);
    }

    #[test]
    fn known_value_with_local_borders() {
        // D = [1 1 2 5; 1 2 1 4; 2 3 2 3]
        let alignment = align(&OBSERVED, &GOALS, 1, Border::Local);
        assert_eq!(alignment.distance.to_bits(), 3.0_f64.to_bits());
        assert_eq!(alignment.path.first(), Some(&(0, 0)));
        assert_eq!(alignment.path.last(), Some(&(2, 3)));
    }

    #[test]
    fn rows_extend_over_the_first_columns_of_longer_rows() {
        let local = [0.5, 1.5];
        let mut short = [0.0; 2];
        extend_row(&[1.0, 2.0, 3.0], &local, Border::Accumulated, &mut short);
        let mut exact = [0.0; 2];
        extend_row(&[1.0, 2.0], &local, Border::Accumulated, &mut exact);
        assert_eq!(short.map(f64::to_bits), exact.map(f64::to_bits));
        assert_eq!(short.map(f64::to_bits), [1.5_f64, 2.5].map(f64::to_bits));
    }

    /// Reference implementation without the kernel: the cheapest of all monotone paths.
    fn cheapest_path(observed: &[f64], goals: &[f64], i: usize, j: usize) -> f64 {
        let here = (observed[i] - goals[j]).abs();
        let before = match (i, j) {
            (0, 0) => return here,
            (0, _) => cheapest_path(observed, goals, 0, j - 1),
            (_, 0) => cheapest_path(observed, goals, i - 1, 0),
            _ => cheapest_path(observed, goals, i - 1, j - 1)
                .min(cheapest_path(observed, goals, i - 1, j))
                .min(cheapest_path(observed, goals, i, j - 1)),
        };
        here + before
    }

    fn rows() -> impl Strategy<Value = Vec<f64>> {
        proptest::collection::vec(-50.0..50.0_f64, 1..6)
    }

    proptest! {
        #[test]
        fn distance_is_the_cheapest_monotone_path(observed in rows(), goals in rows()) {
            let expected = cheapest_path(&observed, &goals, observed.len() - 1, goals.len() - 1);
            let found = distance(&observed, &goals, 1, Border::Accumulated);
            prop_assert!((found - expected).abs() < 1e-9, "{found} against {expected}");
        }

        #[test]
        fn matrix_and_distance_only_give_the_same_bits(observed in rows(), goals in rows()) {
            for border in [Border::Accumulated, Border::Local] {
                let whole = align(&observed, &goals, 1, border);
                prop_assert_eq!(whole.distance.to_bits(), distance(&observed, &goals, 1, border).to_bits());
                let steps_forward = whole.path.windows(2).all(|w| {
                    let step = (w[1].0 - w[0].0, w[1].1 - w[0].1);
                    step == (1, 0) || step == (0, 1) || step == (1, 1)
                });
                prop_assert!(steps_forward);
            }
        }

        #[test]
        fn a_trajectory_is_at_distance_zero_from_itself(rows in rows()) {
            prop_assert_eq!(distance(&rows, &rows, 1, Border::Accumulated).to_bits(), 0.0_f64.to_bits());
        }

        #[test]
        fn the_path_costs_the_distance(observed in rows(), goals in rows()) {
            let whole = align(&observed, &goals, 1, Border::Accumulated);
            let cost: f64 = whole.path.iter().map(|&(i, j)| (observed[i] - goals[j]).abs()).sum();
            prop_assert!((cost - whole.distance).abs() < 1e-9);
        }
    }
}
