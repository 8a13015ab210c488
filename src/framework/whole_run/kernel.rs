//! Product kernels over joints, unit variance: TRIG for what angles do, SE (squared exponential) for the rest.
//!
//! TRIG: `k = prod_i (1 + h cos dq_i) / (1 + h)`; its functions are those multilinear in 1, cos q_i and sin q_i, which
//! is what the position of a point on a chain of revolute joints is. SE: `k = prod_i exp(-dq_i^2 / 2 h^2)`. Prismatic
//! joints always take the SE factor, a stroke counted as pi radians, under TRIG with a length of 2.5 rad.

use super::space::Space;
use serde::{Deserialize, Serialize};

/// SE length of a prismatic joint under TRIG, rad of pi a stroke: nearly linear over the stroke.
const STROKE_LENGTH: f64 = 2.5;

/// A kernel with its one shape parameter.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Kernel {
    /// Trigonometric; h is the weight of the cosine.
    Trig(f64),
    /// Squared exponential; the length in rad.
    Se(f64),
}

/// The poses of a log, prepared for one kernel evaluation after the other.
#[derive(Debug, Clone, Default)]
pub struct Poses {
    joints: usize,
    scale: Vec<f64>,
    revolute: Vec<bool>,
    /// Per pose and joint: scaled position, cosine, sine.
    rows: Vec<[f64; 3]>,
}

/// Scratch of one evaluation.
#[derive(Debug, Clone, Default)]
pub struct Factors {
    at: Vec<[f64; 3]>,
    factor: Vec<f64>,
    slope: Vec<f64>,
}

impl Poses {
    /// No poses yet, over `space`.
    #[must_use]
    pub fn new(space: &Space) -> Self {
        Self {
            joints: space.len(),
            scale: space.axes.iter().map(super::space::Axis::scale).collect(),
            revolute: space.axes.iter().map(|a| a.revolute).collect(),
            rows: Vec::new(),
        }
    }

    /// Appends a pose.
    pub fn push(&mut self, pose: &[f64]) {
        for (value, scale) in pose.iter().zip(&self.scale) {
            let x = value * scale;
            self.rows.push([x, x.cos(), x.sin()]);
        }
    }

    /// Number of joints d.
    #[must_use]
    pub fn joints(&self) -> usize {
        self.joints
    }

    /// Number of poses n.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rows.len() / self.joints.max(1)
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Kernel between poses `a` and `b` of the log.
    #[must_use]
    pub fn between(&self, kernel: Kernel, a: usize, b: usize) -> f64 {
        let rows = |i: usize| &self.rows[i * self.joints..(i + 1) * self.joints];
        self.product(kernel, rows(a), rows(b))
    }

    fn product(&self, kernel: Kernel, a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
        let mut k = 1.0;
        for ((x, y), &revolute) in a.iter().zip(b).zip(&self.revolute) {
            k *= match kernel {
                Kernel::Trig(h) if revolute => (1.0 + h * (x[1] * y[1] + x[2] * y[2])) / (1.0 + h),
                Kernel::Trig(_) => se(x[0] - y[0], STROKE_LENGTH),
                Kernel::Se(length) => se(x[0] - y[0], length),
            };
        }
        k
    }

    fn prepare(&self, pose: &[f64], scratch: &mut Factors) {
        scratch.at.clear();
        for (value, scale) in pose.iter().zip(&self.scale) {
            let x = value * scale;
            let (sin, cos) = x.sin_cos();
            scratch.at.push([x, cos, sin]);
        }
    }

    /// Kernel of `pose` with each pose of the log, into `k[0..n]`.
    pub fn with(&self, kernel: Kernel, pose: &[f64], scratch: &mut Factors, k: &mut [f64]) {
        self.prepare(pose, scratch);
        for (value, row) in k.iter_mut().zip(self.rows.chunks_exact(self.joints)) {
            *value = self.product(kernel, &scratch.at, row);
        }
    }

    /// As [`Poses::with`], and the slopes `dk[i * d + j] = d k_i / d q_j`.
    pub fn with_slopes(&self, kernel: Kernel, pose: &[f64], scratch: &mut Factors, k: &mut [f64], dk: &mut [f64]) {
        self.prepare(pose, scratch);
        let d = self.joints;
        scratch.factor.resize(d, 0.0);
        scratch.slope.resize(d, 0.0);
        for (i, row) in self.rows.chunks_exact(d).enumerate() {
            for (j, &y) in row.iter().enumerate() {
                let x = scratch.at[j];
                let (factor, slope) = match kernel {
                    Kernel::Trig(h) if self.revolute[j] => {
                        let cos = x[1] * y[1] + x[2] * y[2];
                        let sin = x[2] * y[1] - x[1] * y[2];
                        ((1.0 + h * cos) / (1.0 + h), -h * sin / (1.0 + h))
                    }
                    Kernel::Trig(_) => se_slope(x[0] - y[0], STROKE_LENGTH),
                    Kernel::Se(length) => se_slope(x[0] - y[0], length),
                };
                scratch.factor[j] = factor;
                scratch.slope[j] = slope * self.scale[j];
            }
            // prefix products forward, suffix products backward: no division by a factor that may be 0
            let mut before = 1.0;
            for j in 0..d {
                dk[i * d + j] = before * scratch.slope[j];
                before *= scratch.factor[j];
            }
            k[i] = before;
            let mut after = 1.0;
            for j in (0..d).rev() {
                dk[i * d + j] *= after;
                after *= scratch.factor[j];
            }
        }
    }
}

fn se(difference: f64, length: f64) -> f64 {
    (-difference * difference / (2.0 * length * length)).exp()
}

fn se_slope(difference: f64, length: f64) -> (f64, f64) {
    let k = se(difference, length);
    (k, -difference / (length * length) * k)
}
