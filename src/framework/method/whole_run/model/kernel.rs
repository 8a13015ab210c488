//! Product kernels over joints with unit variance: TRIG for angles, SE (squared exponential) for everything else.
//!
//! TRIG: `k = prod_i (1 + h cos dq_i) / (1 + h)`. Its functions are multilinear in 1, cos q_i and sin q_i, exactly like
//! the position of a point on a chain of revolute joints. SE: `k = prod_i exp(-dq_i^2 / 2 h^2)`. Prismatic joints
//! always use the SE factor, with a stroke counted as pi radians; under TRIG its length is 2.5 rad.

use crate::method::whole_run::space::{Axis, Space};
use serde::{Deserialize, Serialize};

/// SE length of a prismatic joint under TRIG, in rad with pi per stroke: nearly linear over the stroke.
const STROKE_LENGTH: f64 = 2.5;

/// A kernel with its shape parameter.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Kernel {
    /// Trigonometric; h is the weight of the cosine.
    Trig(f64),
    /// Squared exponential with a length in rad.
    Se(f64),
}

/// The poses of a log, prepared for repeated kernel evaluations.
#[derive(Debug, Clone, Default)]
pub struct Poses {
    joints: usize,
    scale: Vec<f64>,
    revolute: Vec<bool>,
    /// Scaled position, cosine and sine per pose and joint.
    rows: Vec<[f64; 3]>,
}

impl Poses {
    /// An empty log over `space`.
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

    /// The d factors by which joint positions are multiplied before they are compared.
    #[must_use]
    pub fn scale(&self) -> &[f64] {
        &self.scale
    }

    /// Scaled position, cosine and sine of joint `j` in each pose.
    pub fn joint(&self, j: usize) -> impl Iterator<Item = [f64; 3]> {
        self.rows.iter().skip(j).step_by(self.joints.max(1)).copied()
    }

    /// Factor of joint `j` in `kernel`.
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

/// Squared exponential of a difference.
pub(super) fn se(difference: f64, length: f64) -> f64 {
    (-difference * difference / (2.0 * length * length)).exp()
}
