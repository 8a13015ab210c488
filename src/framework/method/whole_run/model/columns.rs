//! The kernel between one pose and all poses of a log, stored as one column of n numbers per joint, so that the
//! compiler can vectorise.
//!
//! A TRIG factor is `c + a cos q + b sin q` with `c = 1 / (1 + h)`, `a = h cos q_i / (1 + h)`,
//! `b = h sin q_i / (1 + h)`: everything that depends on the log is computed once.

use super::kernel::{Kernel, Poses, se};

/// Contribution of one joint of the n poses to the kernel.
#[derive(Debug, Clone)]
enum Column {
    /// Constant c, the n values a and the n values b.
    Trig(f64, Vec<f64>, Vec<f64>),
    /// Length h and the n scaled positions.
    Se(f64, Vec<f64>),
}

/// The n poses of a log under one kernel, and the kernel at the pose queried last.
#[derive(Debug, Clone)]
pub struct Columns {
    scale: Vec<f64>,
    joints: Vec<Column>,
    /// Scaled positions, cosines and sines of the d joints at the pose queried last.
    at: Vec<[f64; 3]>,
    /// Kernel between that pose and each of the n poses.
    pub k: Vec<f64>,
    /// `dk[j * n + i] = d k_i / d q_j`; valid after [`Columns::slopes_there`].
    pub dk: Vec<f64>,
    /// Factor j of each pose, at `[j * n..]`.
    factors: Vec<f64>,
    /// Products of the factors before or after the current joint.
    product: Vec<f64>,
}

impl Columns {
    /// Prepares `poses` under `kernel`.
    #[must_use]
    pub fn new(poses: &Poses, kernel: Kernel) -> Self {
        let (n, d) = (poses.len(), poses.joints());
        let column = |j: usize| {
            let entry = |which: usize| poses.joint(j).map(move |row| row[which]);
            match poses.factor(kernel, j) {
                Kernel::Trig(h) => {
                    let c = 1.0 / (1.0 + h);
                    Column::Trig(
                        c,
                        entry(1).map(|cos| h * c * cos).collect(),
                        entry(2).map(|sin| h * c * sin).collect(),
                    )
                }
                Kernel::Se(length) => Column::Se(length, entry(0).collect()),
            }
        };
        Self {
            scale: poses.scale().to_vec(),
            joints: (0..d).map(column).collect(),
            at: vec![[0.0; 3]; d],
            k: vec![0.0; n],
            dk: vec![0.0; n * d],
            factors: vec![0.0; n * d],
            product: vec![0.0; n],
        }
    }

    /// Writes the kernel between `pose` (d joints, rad or m) and each pose of the log to [`Columns::k`].
    pub fn ask(&mut self, pose: &[f64]) {
        self.k.fill(1.0);
        for (j, column) in self.joints.iter().enumerate() {
            let x = pose[j] * self.scale[j];
            let (sin, cos) = x.sin_cos();
            self.at[j] = [x, cos, sin];
            match column {
                Column::Trig(c, a, b) => {
                    for ((k, a), b) in self.k.iter_mut().zip(a).zip(b) {
                        *k *= c + a * cos + b * sin;
                    }
                }
                Column::Se(length, positions) => {
                    for (k, y) in self.k.iter_mut().zip(positions) {
                        *k *= se(x - y, *length);
                    }
                }
            }
        }
    }

    /// Writes the slopes at the pose queried last to [`Columns::dk`].
    pub fn slopes_there(&mut self) {
        let n = self.k.len();
        if n == 0 {
            return;
        }
        // Prefix products forwards, suffix products backwards: no division by a factor that may be 0.
        self.product.fill(1.0);
        let rows = self.factors.chunks_exact_mut(n).zip(self.dk.chunks_exact_mut(n));
        for (((column, &[x, cos, sin]), &scale), (factors, dk)) in
            self.joints.iter().zip(&self.at).zip(&self.scale).zip(rows)
        {
            match column {
                Column::Trig(c, a, b) => {
                    for (((factor, dk), a), b) in factors.iter_mut().zip(dk.iter_mut()).zip(a).zip(b) {
                        *factor = c + a * cos + b * sin;
                        *dk = scale * (b * cos - a * sin);
                    }
                }
                Column::Se(length, positions) => {
                    for ((factor, dk), y) in factors.iter_mut().zip(dk.iter_mut()).zip(positions) {
                        *factor = se(x - y, *length);
                        *dk = -scale * (x - y) / (length * length) * *factor;
                    }
                }
            }
            for ((dk, product), factor) in dk.iter_mut().zip(&mut self.product).zip(factors.iter()) {
                *dk *= *product;
                *product *= factor;
            }
        }
        self.product.fill(1.0);
        for (factors, dk) in self.factors.chunks_exact(n).zip(self.dk.chunks_exact_mut(n)).rev() {
            for ((dk, product), factor) in dk.iter_mut().zip(&mut self.product).zip(factors) {
                *dk *= *product;
                *product *= factor;
            }
        }
    }
}
