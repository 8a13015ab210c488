//! The search distribution of CMA-ES: `x = m + sigma B D z` with z standard normal and `C = B D^2 B'`.
//!
//! Coordinates are joints scaled to 0..1 between their limits.
//! Source: N. Hansen, arXiv:1604.00772, section 4 and figure 6; the weighting of negative updates is its equation 46.

use super::weights::Weights;
use crate::random::RandomStream;
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use serde::{Deserialize, Serialize};

/// Condition number of C above which the search stops.
const WORST_CONDITION: f64 = 1e14;

/// Mean, step size, covariance and evolution paths.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Distribution {
    /// Mean m, n values.
    pub mean: Vec<f64>,
    /// Overall step size.
    pub sigma: f64,
    /// Covariance C, n x n, symmetric.
    pub covariance: Vec<f64>,
    /// Evolution path of sigma, n values.
    pub path_sigma: Vec<f64>,
    /// Evolution path of C, n values.
    pub path_c: Vec<f64>,
    /// Number of updates so far.
    pub updates: u32,
}

/// Axes B and lengths D of the current covariance.
#[derive(Debug, Clone)]
pub(super) struct Axes {
    directions: DMatrix<f64>,
    /// Standard deviations along the axes.
    lengths: DVector<f64>,
}

impl Distribution {
    /// An isotropic distribution with step size `sigma` around `mean`.
    pub fn new(mean: Vec<f64>, sigma: f64) -> Self {
        let n = mean.len();
        let identity = DMatrix::<f64>::identity(n, n);
        Self {
            mean,
            sigma,
            covariance: identity.as_slice().to_vec(),
            path_sigma: vec![0.0; n],
            path_c: vec![0.0; n],
            updates: 0,
        }
    }

    /// Principal axes of C; `None` if rounding has made C unusable.
    pub fn axes(&self) -> Option<Axes> {
        let n = self.mean.len();
        let eigen = SymmetricEigen::new(DMatrix::from_column_slice(n, n, &self.covariance));
        let (least, most) = (eigen.eigenvalues.min(), eigen.eigenvalues.max());
        let sound = least > 0.0 && most.is_finite() && most < WORST_CONDITION * least && self.sigma.is_finite();
        sound.then(|| Axes { directions: eigen.eigenvectors, lengths: eigen.eigenvalues.map(f64::sqrt) })
    }

    /// The largest standard deviation along a coordinate.
    pub fn spread(&self) -> f64 {
        let n = self.mean.len();
        let variance = (0..n).map(|i| self.covariance[i * n + i]).fold(0.0, f64::max);
        self.sigma * variance.sqrt()
    }

    /// Draws one candidate.
    pub fn sample(&self, axes: &Axes, rng: &mut RandomStream) -> Vec<f64> {
        let z = DVector::from_fn(self.mean.len(), |_, _| rng.normal());
        let y = &axes.directions * z.component_mul(&axes.lengths);
        self.mean.iter().zip(&y).map(|(m, y)| m + self.sigma * y).collect()
    }

    /// Updates the distribution from the candidates `ranked`, best first; the last `failed` of them are only known to
    /// be bad.
    pub fn update(&mut self, weights: &Weights, axes: &Axes, ranked: &[&[f64]], failed: usize) {
        let n = self.mean.len();
        let steps: Vec<DVector<f64>> = ranked
            .iter()
            .map(|x| DVector::from_fn(n, |i, _| (x[i] - self.mean[i]) / self.sigma))
            .map(|y| shortened(axes, y))
            .collect();
        let parents = weights.mu().min(ranked.len() - failed);
        let kept: f64 = weights.recombination[..parents].iter().sum();
        let mut mean_step = DVector::<f64>::zeros(n);
        for (w, y) in weights.recombination[..parents].iter().zip(&steps) {
            mean_step.axpy(w / kept, y, 1.0);
        }
        for (m, y) in self.mean.iter_mut().zip(&mean_step) {
            *m += self.sigma * y;
        }
        self.updates += 1;
        let grown = self.step_size(weights, axes, &mean_step);
        self.adapt(weights, axes, &mean_step, &steps, grown);
    }

    /// Cumulative step-size adaptation (equations 43 and 44); returns whether the path is short enough for the rank-one
    /// update.
    fn step_size(&mut self, weights: &Weights, axes: &Axes, mean_step: &DVector<f64>) -> bool {
        let n = mean_step.len() as f64;
        let c = weights.c_sigma;
        let whitened = axes.whitened(mean_step);
        let turned = &axes.directions * whitened;
        for (p, y) in self.path_sigma.iter_mut().zip(&turned) {
            *p = (1.0 - c) * *p + (c * (2.0 - c) * weights.mu_eff).sqrt() * y;
        }
        let length = self.path_sigma.iter().map(|p| p * p).sum::<f64>().sqrt();
        self.sigma *= (c / weights.d_sigma * (length / weights.chi - 1.0)).min(1.0).exp();
        let forgotten = (1.0 - (1.0 - c).powf(2.0 * f64::from(self.updates))).sqrt();
        length / forgotten < (1.4 + 2.0 / (n + 1.0)) * weights.chi
    }

    /// Covariance matrix adaptation (equations 45 to 47).
    fn adapt(&mut self, weights: &Weights, axes: &Axes, mean_step: &DVector<f64>, steps: &[DVector<f64>], short: bool) {
        let n = self.mean.len();
        let c = weights.c_c;
        let push = if short { (c * (2.0 - c) * weights.mu_eff).sqrt() } else { 0.0 };
        for (p, y) in self.path_c.iter_mut().zip(mean_step) {
            *p = (1.0 - c) * *p + push * y;
        }
        let stalled = if short { 0.0 } else { c * (2.0 - c) };
        let total: f64 = weights.recombination.iter().sum();
        let decay = 1.0 + weights.c_1 * stalled - weights.c_1 - weights.c_mu * total;
        let path = DVector::from_column_slice(&self.path_c);
        let mut covariance = DMatrix::from_column_slice(n, n, &self.covariance) * decay;
        covariance.ger(weights.c_1, &path, &path, 1.0);
        for (&w, y) in weights.recombination.iter().zip(steps) {
            let w = if w >= 0.0 { w } else { w * n as f64 / axes.whitened(y).norm_squared().max(1e-12) };
            covariance.ger(weights.c_mu * w, y, y, 1.0);
        }
        // Rounding leaves it slightly asymmetric.
        let symmetric = (&covariance + covariance.transpose()) * 0.5;
        self.covariance = symmetric.as_slice().to_vec();
    }
}

impl Axes {
    /// `D^-1 B' y`.
    fn whitened(&self, y: &DVector<f64>) -> DVector<f64> {
        self.directions.tr_mul(y).component_div(&self.lengths)
    }
}

/// Shortens a step that a bound or a repair has moved to the length that the distribution produces: N. Hansen,
/// "Injecting External Solutions Into CMA-ES", arXiv:1110.4181.
fn shortened(axes: &Axes, y: DVector<f64>) -> DVector<f64> {
    let n = y.len() as f64;
    let longest = 3.0 * (n.sqrt() + 2.0 * n / (n + 2.0));
    let length = axes.whitened(&y).norm();
    if length > longest { y * (longest / length) } else { y }
}
