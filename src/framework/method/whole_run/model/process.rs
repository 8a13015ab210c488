//! Gaussian process of m features with one kernel; shape and amplitude are chosen by maximum evidence over a grid.
//!
//! Symbols: n measured poses, residuals Y (n x m; feature minus prior mean), unit kernel matrix C, amplitude a, noise
//! s: `K = a^2 C + (s^2 + 1e-7 a^2) I`. Log evidence, with K shared by the m outputs:
//! `-1/2 sum_o y_o' K^-1 y_o - m/2 log |K|`, plus weak log-normal priors on the shape h and on c = a / s0.
//!
//! Source: C. E. Rasmussen, C. K. I. Williams, Gaussian Processes for Machine Learning, MIT Press 2006, ch. 2 and 5.

use super::columns::Columns;
use super::kernel::{Kernel, Poses};
use nalgebra::{Cholesky, DMatrix, Dyn};

/// Ridge relative to the amplitude; makes the Cholesky factorisation safe without noise.
const RIDGE: f64 = 1e-7;
/// Grid of amplitudes, in units of the scale s0.
const AMPLITUDES: [f64; 6] = [0.15, 0.3, 0.6, 1.0, 1.8, 3.0];
const TRIG_SHAPES: [f64; 4] = [0.5, 1.0, 2.0, 4.0];
const SE_LENGTHS_DEG: [f64; 5] = [35.0, 50.0, 70.0, 100.0, 140.0];
/// Width (natural logarithm) of the priors on shape and amplitude.
const PRIOR_WIDTH: f64 = 0.7;

/// Kernels considered by the evidence search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// Kernels for chains with revolute joints.
    Trig,
    /// Kernels for any smooth map.
    Se,
}

impl Family {
    /// Each kernel with its log prior.
    fn members(self) -> Vec<(Kernel, f64)> {
        match self {
            Self::Trig => TRIG_SHAPES.iter().map(|&h| (Kernel::Trig(h), log_prior(h, 1.5))).collect(),
            Self::Se => {
                let member = |&h: &f64| (Kernel::Se(h.to_radians()), log_prior(h, 70.0));
                SE_LENGTHS_DEG.iter().map(member).collect()
            }
        }
    }
}

fn log_prior(value: f64, centre: f64) -> f64 {
    let z = (value / centre).ln() / PRIOR_WIDTH;
    -0.5 * z * z
}

/// A fitted process.
#[derive(Debug, Clone)]
pub struct Process {
    columns: Columns,
    variance: f64,
    /// Weights of the mean, `C'^-1 Y`, n x m column-major.
    alpha: Vec<f64>,
    /// Inverse of the lower Cholesky factor of C', row-major, n x n.
    inverse: Vec<f64>,
    /// `inverse k` at the pose queried last.
    whitened: Vec<f64>,
    /// `C'^-1 k` at that pose.
    weights: Vec<f64>,
}

struct Choice {
    evidence: f64,
    kernel: Kernel,
    variance: f64,
    cholesky: Cholesky<f64, Dyn>,
    alpha: DMatrix<f64>,
}

/// A factorised kernel matrix K, K^-1 R, ln det K and the fit R . K^-1 R.
type Factorized = (Cholesky<f64, Dyn>, DMatrix<f64>, f64, f64);

impl Process {
    /// Fits `residuals` (n x m) at `poses`; `scale` is s0 and `noise` the standard deviation s, features' unit. `None`
    /// if no kernel matrix could be factorised (poses that are not finite).
    #[must_use]
    pub fn fit(poses: &Poses, residuals: &DMatrix<f64>, family: Family, scale: f64, noise: f64) -> Option<Self> {
        let n = poses.len();
        let m = residuals.ncols();
        let mut best: Option<Choice> = None;
        for (kernel, shape_prior) in family.members() {
            let correlation = lower_triangle(n, |a, b| poses.between(kernel, a, b));
            let mut shared: Option<Factorized> = None;
            for c in AMPLITUDES {
                let variance = (c * scale).powi(2).max(f64::MIN_POSITIVE);
                if noise > 0.0 || shared.is_none() {
                    let ridge = RIDGE + noise * noise / variance;
                    let Some(cholesky) = factorize(&correlation, ridge) else { continue };
                    let alpha = cholesky.solve(residuals);
                    let log_determinant = 2.0 * cholesky.l_dirty().diagonal().map(f64::ln).sum();
                    let fit = residuals.dot(&alpha);
                    shared = Some((cholesky, alpha, log_determinant, fit));
                }
                let Some((cholesky, alpha, log_determinant, fit)) = &shared else { continue };
                let determinant = log_determinant + n as f64 * variance.ln();
                let evidence = -0.5 * fit / variance - 0.5 * m as f64 * determinant + shape_prior + log_prior(c, 1.0);
                if best.as_ref().is_none_or(|b| evidence > b.evidence) {
                    let (cholesky, alpha) = (cholesky.clone(), alpha.clone());
                    best = Some(Choice { evidence, kernel, variance, cholesky, alpha });
                }
            }
        }
        let choice = best?;
        let inverse = choice.cholesky.l().solve_lower_triangular(&DMatrix::identity(n, n))?;
        Some(Self {
            columns: Columns::new(poses, choice.kernel),
            variance: choice.variance,
            alpha: choice.alpha.as_slice().to_vec(),
            inverse: inverse.transpose().as_slice().to_vec(),
            whitened: vec![0.0; n],
            weights: vec![0.0; n],
        })
    }

    /// a^2, features' unit squared.
    #[must_use]
    pub fn amplitude_squared(&self) -> f64 {
        self.variance
    }

    /// Writes the posterior mean of the residual at `pose` to `mean` (m values); returns the variance of one output.
    pub fn predict(&mut self, pose: &[f64], mean: &mut [f64]) -> f64 {
        self.predict_mean(pose, mean);
        self.variance_there()
    }

    /// Like [`Process::predict`], without the variance: n m operations instead of n^2.
    pub fn predict_mean(&mut self, pose: &[f64], mean: &mut [f64]) {
        self.columns.ask(pose);
        let k = &self.columns.k;
        for (value, alpha) in mean.iter_mut().zip(self.alpha.chunks_exact(k.len())) {
            *value = dot(k, alpha);
        }
    }

    /// Variance of one output at the pose queried last.
    pub fn variance_there(&mut self) -> f64 {
        let k = &self.columns.k;
        let n = k.len();
        let mut explained = 0.0;
        for (i, (row, whitened)) in self.inverse.chunks_exact(n).zip(&mut self.whitened).enumerate() {
            let w = dot(&row[..=i], &k[..=i]);
            *whitened = w;
            explained += w * w;
        }
        self.variance * (1.0 - explained).max(0.0)
    }

    /// At the pose whose variance was queried last: `jacobian[o * d + j]` of the mean, and `slope[j]`, the gradient of
    /// the variance.
    pub fn slopes_there(&mut self, jacobian: &mut [f64], slope: &mut [f64]) {
        self.columns.slopes_there();
        let (n, d) = (self.whitened.len(), slope.len());
        self.weights.fill(0.0);
        for (i, (row, &w)) in self.inverse.chunks_exact(n).zip(&self.whitened).enumerate() {
            for (weight, l) in self.weights[..=i].iter_mut().zip(row) {
                *weight += w * l;
            }
        }
        for (j, dk) in self.columns.dk.chunks_exact(n).enumerate() {
            slope[j] = -2.0 * self.variance * dot(dk, &self.weights);
            for (o, alpha) in self.alpha.chunks_exact(n).enumerate() {
                jacobian[o * d + j] = dot(dk, alpha);
            }
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    // Four partial sums: the order of the additions is fixed, and the compiler can vectorise.
    let mut sums = [0.0; 4];
    let (a4, b4) = (a.chunks_exact(4), b.chunks_exact(4));
    let tail: f64 = a4.remainder().iter().zip(b4.remainder()).map(|(x, y)| x * y).sum();
    for (x, y) in a4.zip(b4) {
        for lane in 0..4 {
            sums[lane] += x[lane] * y[lane];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + tail
}

/// The n x n matrix of `entry(row, column)` on and below the diagonal, which is all that a Cholesky factorisation
/// reads.
fn lower_triangle(n: usize, entry: impl Fn(usize, usize) -> f64) -> DMatrix<f64> {
    DMatrix::from_fn(n, n, |a, b| if b <= a { entry(a, b) } else { 0.0 })
}

fn factorize(correlation: &DMatrix<f64>, ridge: f64) -> Option<Cholesky<f64, Dyn>> {
    let mut ridge = ridge;
    for _ in 0..4 {
        let mut matrix = correlation.clone();
        for i in 0..matrix.nrows() {
            matrix[(i, i)] += ridge;
        }
        if let Some(cholesky) = Cholesky::new(matrix) {
            return Some(cholesky);
        }
        ridge *= 100.0;
    }
    None
}
