//! Product kernels over joints, unit variance: TRIG for what angles do, SE (squared exponential) for the rest.
//!
//! TRIG: `k = prod_i (1 + h cos dq_i) / (1 + h)`; its functions are those multilinear in 1, cos q_i and sin q_i, which
//! is what the position of a point on a chain of revolute joints is. SE: `k = prod_i exp(-dq_i^2 / 2 h^2)`. Prismatic
//! joints always take the SE factor, a stroke counted as pi radians, under TRIG with a length of 2.5 rad.

use crate::method::whole_run::space::{Axis, Space};
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

impl Poses {
    /// No poses yet, over `space`.
    #[must_use]
    pub fn new(space: &Space) -> Self {
        Self {
            joints: space.len(),
            scale: space.axes.iter().map(Axis::scale).collect(),
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

    /// The d numbers a joint's positions are multiplied with before they are compared.
    #[must_use]
    pub fn scale(&self) -> &[f64] {
        &self.scale
    }

    /// Scaled position, cosine and sine of joint `j` in each pose.
    pub fn joint(&self, j: usize) -> impl Iterator<Item = [f64; 3]> {
        self.rows.iter().skip(j).step_by(self.joints.max(1)).copied()
    }

    /// The factor that joint `j` puts into `kernel`.
    #[must_use]
    pub fn factor(&self, kernel: Kernel, j: usize) -> Kernel {
        match kernel {
            Kernel::Trig(_) if !self.revolute[j] => Kernel::Se(STROKE_LENGTH),
            _ => kernel,
        }
    }

    /// Kernel between poses `a` and `b` of the log.
    #[must_use]
    pub fn between(&self, kernel: Kernel, a: usize, b: usize) -> f64 {
        let rows = |i: usize| &self.rows[i * self.joints..(i + 1) * self.joints];
        let factor = |(j, (x, y)): (usize, (&[f64; 3], &[f64; 3]))| match self.factor(kernel, j) {
            Kernel::Trig(h) => (1.0 + h * (x[1] * y[1] + x[2] * y[2])) / (1.0 + h),
            Kernel::Se(length) => se(x[0] - y[0], length),
        };
        rows(a).iter().zip(rows(b)).enumerate().map(factor).product()
    }
}

/// The squared exponential of a difference.
pub(super) fn se(difference: f64, length: f64) -> f64 {
    (-difference * difference / (2.0 * length * length)).exp()
}
