//! Radial basis functions through the goals (paper eq. 3): f(x) = sum_i w_i phi(|x - x_i|).
//!
//! Nodes x_i = i / (n - 1) in [0, 1]; epsilon = 1 / n unless given, the mean node distance as SciPy's `Rbf`, which the
//! authors' script used, estimates it (range / number of nodes). Cubic and thin plate are only conditionally positive
//! definite: they get a linear polynomial a + b x beside the sum, with sum w_i = sum w_i x_i = 0.

use super::{Goals, GoalsError};
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

/// Largest number of goals to interpolate: the system is a dense n x n one.
const MAX_NODES: usize = 2000;
/// Largest number of points to interpolate.
const MAX_POINTS: usize = 100_000;
/// Largest error of the curve at a goal, relative to the largest magnitude among the goals.
const TOLERANCE: f64 = 1e-6;

/// Radial function phi(r); epsilon is a length in normalised time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RbfKernel {
    /// sqrt((r / epsilon)^2 + 1).
    #[default]
    Multiquadric,
    /// 1 / sqrt((r / epsilon)^2 + 1).
    InverseMultiquadric,
    /// exp(-(r / epsilon)^2).
    Gaussian,
    /// r.
    Linear,
    /// r^3.
    Cubic,
    /// r^2 ln r.
    ThinPlate,
}

/// Options for interpolation.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RbfSpec {
    /// Radial function.
    pub kernel: RbfKernel,
    /// Length epsilon in normalised time (> 0); 1 / n if absent.
    pub epsilon: Option<f64>,
}

/// Reasons why goals cannot be interpolated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RbfError {
    /// Too many or too few points or nodes.
    #[error("{points} points through {nodes} goals: give 1 to {MAX_POINTS} points and at most {MAX_NODES} goals")]
    Size {
        /// Number of points requested.
        points: usize,
        /// Number of goals.
        nodes: usize,
    },
    /// Epsilon is not a positive length.
    #[error("epsilon is {epsilon}: give a positive length in normalised time, about 1 / {nodes}")]
    Epsilon {
        /// Requested epsilon.
        epsilon: f64,
        /// Number of goals.
        nodes: usize,
    },
    /// The system has no accurate solution.
    #[error("the curve misses a goal by {miss} (epsilon {epsilon}, {nodes} goals): give a smaller epsilon")]
    IllConditioned {
        /// Largest distance of the curve from a goal, features' unit; infinite if the system is singular.
        miss: f64,
        /// Epsilon in use.
        epsilon: f64,
        /// Number of goals.
        nodes: usize,
    },
    /// The curve overflows.
    #[error("the curve is not finite")]
    Goals(#[from] GoalsError),
}

impl RbfKernel {
    fn phi(self, r: f64, epsilon: f64) -> f64 {
        let scaled = r / epsilon;
        match self {
            Self::Multiquadric => (scaled * scaled + 1.0).sqrt(),
            Self::InverseMultiquadric => 1.0 / (scaled * scaled + 1.0).sqrt(),
            Self::Gaussian => (-scaled * scaled).exp(),
            Self::Linear => r,
            Self::Cubic => r * r * r,
            Self::ThinPlate if r > 0.0 => r * r * r.ln(),
            Self::ThinPlate => 0.0,
        }
    }

    /// Number of polynomial terms added to the sum.
    fn polynomial_terms(self) -> usize {
        match self {
            Self::Cubic | Self::ThinPlate => 2,
            Self::Multiquadric | Self::InverseMultiquadric | Self::Gaussian | Self::Linear => 0,
        }
    }
}

/// Interpolates `points` values of each feature, evenly spaced in normalised time from the first to the last goal.
///
/// A single goal gives a constant curve.
///
/// # Errors
/// [`RbfError`] for sizes out of range and systems without an accurate solution.
pub fn interpolate(goals: &Goals, points: usize, spec: &RbfSpec) -> Result<Goals, RbfError> {
    let nodes = goals.len();
    if points == 0 || points > MAX_POINTS || nodes > MAX_NODES {
        return Err(RbfError::Size { points, nodes });
    }
    let epsilon = spec.epsilon.unwrap_or(1.0 / nodes as f64);
    if !(epsilon.is_finite() && epsilon > 0.0) {
        return Err(RbfError::Epsilon { epsilon, nodes });
    }
    if nodes == 1 {
        return Ok(Goals::new(goals.features().to_vec(), &vec![goals.row(0).to_vec(); points])?);
    }
    let terms = spec.kernel.polynomial_terms();
    let weights =
        solve(goals, spec.kernel, epsilon).ok_or(RbfError::IllConditioned { miss: f64::INFINITY, epsilon, nodes })?;
    let curve = |x: f64, feature: usize| -> f64 {
        let basis = basis(x, nodes, terms, spec.kernel, epsilon);
        basis.dot(&weights.column(feature))
    };
    let m = goals.features().len();
    let scale = goals.values().iter().fold(1.0_f64, |largest, v| largest.max(v.abs()));
    let miss = (0..nodes)
        .flat_map(|i| (0..m).map(move |feature| (i, feature)))
        .map(|(i, feature)| (curve(node(i, nodes), feature) - goals.row(i)[feature]).abs())
        .fold(0.0, |worst: f64, miss| if miss > worst || miss.is_nan() { miss } else { worst });
    if miss.is_nan() || miss > TOLERANCE * scale {
        return Err(RbfError::IllConditioned { miss, epsilon, nodes });
    }
    let rows: Vec<Vec<f64>> =
        (0..points).map(|p| (0..m).map(|feature| curve(node(p, points), feature)).collect()).collect();
    Ok(Goals::new(goals.features().to_vec(), &rows)?)
}

/// Position of node i of n in [0, 1]; 0 if there is only one.
fn node(i: usize, n: usize) -> f64 {
    if n == 1 { 0.0 } else { i as f64 / (n - 1) as f64 }
}

/// phi(|x - x_i|) for all nodes, followed by 1 and x if the kernel needs them.
fn basis(x: f64, nodes: usize, terms: usize, kernel: RbfKernel, epsilon: f64) -> DVector<f64> {
    DVector::from_fn(nodes + terms, |i, _| match i.checked_sub(nodes) {
        None => kernel.phi((x - node(i, nodes)).abs(), epsilon),
        Some(0) => 1.0,
        Some(_) => x,
    })
}

/// Weights, (nodes + terms) x m: `[Phi P; P^T 0] [w; c] = [X; 0]`.
fn solve(goals: &Goals, kernel: RbfKernel, epsilon: f64) -> Option<DMatrix<f64>> {
    let nodes = goals.len();
    let terms = kernel.polynomial_terms();
    let mut system = DMatrix::zeros(nodes + terms, nodes + terms);
    for i in 0..nodes {
        let row = basis(node(i, nodes), nodes, terms, kernel, epsilon);
        for (j, value) in row.iter().enumerate() {
            system[(i, j)] = *value;
            if j >= nodes {
                system[(j, i)] = *value;
            }
        }
    }
    let mut right = DMatrix::zeros(nodes + terms, goals.features().len());
    for (i, row) in goals.rows().enumerate() {
        for (feature, value) in row.iter().enumerate() {
            right[(i, feature)] = *value;
        }
    }
    system.lu().solve(&right)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Feature;
    use proptest::prelude::*;

    const KERNELS: [RbfKernel; 6] = [
        RbfKernel::Multiquadric,
        RbfKernel::InverseMultiquadric,
        RbfKernel::Gaussian,
        RbfKernel::Linear,
        RbfKernel::Cubic,
        RbfKernel::ThinPlate,
    ];

    fn goals(values: &[f64]) -> Goals {
        let rows: Vec<Vec<f64>> = values.iter().map(|v| vec![*v, -2.0 * v]).collect();
        Goals::new(vec![Feature::new("x", "mm"), Feature::new("y", "mm")], &rows).unwrap()
    }

    /// Two nodes by hand: [sqrt(1) sqrt(5); sqrt(5) sqrt(1)] w = [0; 1], f(1/2) = (w_1 + w_2) sqrt(2).
    #[test]
    fn multiquadric_known_value() {
        let curve = interpolate(&goals(&[0.0, 1.0]), 3, &RbfSpec::default()).unwrap();
        let expected = 2.0_f64.sqrt() / (1.0 + 5.0_f64.sqrt());
        assert!((curve.row(1)[0] - expected).abs() < 1e-12);
        assert!((curve.row(1)[1] + 2.0 * expected).abs() < 1e-12);
    }

    #[test]
    fn linear_kernel_joins_goals_by_straight_lines() {
        let spec = RbfSpec { kernel: RbfKernel::Linear, epsilon: None };
        let curve = interpolate(&goals(&[0.0, 4.0, 2.0]), 5, &spec).unwrap();
        let found: Vec<f64> = curve.rows().map(|row| row[0]).collect();
        for (found, expected) in found.iter().zip([0.0, 2.0, 4.0, 3.0, 2.0]) {
            assert!((found - expected).abs() < 1e-9, "{found} against {expected}");
        }
    }

    #[test]
    fn cubic_and_thin_plate_reproduce_a_straight_line() {
        for kernel in [RbfKernel::Cubic, RbfKernel::ThinPlate] {
            let curve = interpolate(&goals(&[1.0, 2.0, 3.0, 4.0]), 7, &RbfSpec { kernel, epsilon: None }).unwrap();
            for (i, row) in curve.rows().enumerate() {
                assert!((row[0] - (1.0 + i as f64 / 2.0)).abs() < 1e-9, "{kernel:?}");
            }
        }
    }

    #[test]
    fn hopeless_lengths_are_refused() {
        let spec = RbfSpec { kernel: RbfKernel::Gaussian, epsilon: Some(1e9) };
        let error = interpolate(&goals(&[0.0, 5.0, 1.0]), 3, &spec).unwrap_err();
        assert!(matches!(error, RbfError::IllConditioned { nodes: 3, .. }), "{error}");
        let spec = RbfSpec { kernel: RbfKernel::Gaussian, epsilon: Some(0.0) };
        assert!(matches!(interpolate(&goals(&[0.0, 5.0]), 3, &spec), Err(RbfError::Epsilon { .. })));
    }

    proptest! {
        #[test]
        fn every_kernel_goes_through_the_goals(values in proptest::collection::vec(-1e3..1e3_f64, 1..20)) {
            for kernel in KERNELS {
                let goals = goals(&values);
                let curve = interpolate(&goals, goals.len(), &RbfSpec { kernel, epsilon: None }).unwrap();
                for (point, goal) in curve.values().iter().zip(goals.values()) {
                    prop_assert!((point - goal).abs() < 1e-2, "{kernel:?}: {point} against {goal}");
                }
            }
        }
    }
}
