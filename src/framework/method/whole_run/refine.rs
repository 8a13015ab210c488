//! Local minimisation inside a box: Levenberg-Marquardt with an active set.
//!
//! Source: D. W. Marquardt, J. SIAM 11 (1963), DOI 10.1137/0111030; bounds by freezing the joints that push outwards.

use super::space::Space;
use nalgebra::{Cholesky, DMatrix, DVector};

/// Value, gradient and approximate Hessian of the objective.
#[derive(Debug, Clone)]
pub struct Local {
    /// Value of the objective.
    pub value: f64,
    /// Gradient, d values.
    pub gradient: Vec<f64>,
    /// Positive semi-definite d x d, row-major.
    pub hessian: Vec<f64>,
}

impl Local {
    /// Zeros for `d` joints.
    #[must_use]
    pub fn new(d: usize) -> Self {
        Self { value: 0.0, gradient: vec![0.0; d], hessian: vec![0.0; d * d] }
    }
}

/// Objective: if its value at the pose is below the bound, fills in the rest and returns true.
pub type Function<'a> = dyn FnMut(&[f64], f64, &mut Local) -> bool + 'a;

/// Moves `pose` downhill for at most `steps` evaluations of `function`; returns the value reached.
pub fn refine(space: &Space, pose: &mut [f64], steps: usize, function: &mut Function<'_>) -> f64 {
    let d = pose.len();
    let mut here = Local::new(d);
    let mut there = Local::new(d);
    let mut trial = pose.to_vec();
    if !function(pose, f64::INFINITY, &mut here) {
        return f64::INFINITY;
    }
    let mut damping = 1e-3;
    for _ in 0..steps {
        let Some(step) = damped_step(space, pose, &here, damping) else { break };
        let mut moved = 0.0_f64;
        for (((t, q), s), axis) in trial.iter_mut().zip(pose.iter()).zip(&step).zip(&space.axes) {
            *t = (q + s).clamp(axis.lower, axis.upper);
            moved = moved.max((*t - q).abs() * axis.scale());
        }
        if moved < 1e-7 {
            break;
        }
        if function(&trial, here.value, &mut there) {
            let gain = here.value - there.value;
            pose.copy_from_slice(&trial);
            std::mem::swap(&mut here, &mut there);
            damping = (damping * 0.2).max(1e-9);
            if gain <= 1e-9 * here.value.abs() {
                break;
            }
        } else {
            damping *= 6.0;
            if damping > 1e9 {
                break;
            }
        }
    }
    here.value
}

/// The step of the joints that may move; `None` if none may or the system cannot be solved.
fn damped_step(space: &Space, pose: &[f64], local: &Local, damping: f64) -> Option<Vec<f64>> {
    let d = pose.len();
    let at_limit = |j: usize| {
        let (axis, g) = (&space.axes[j], local.gradient[j]);
        (pose[j] <= axis.lower && g > 0.0) || (pose[j] >= axis.upper && g < 0.0)
    };
    let free: Vec<usize> = (0..d).filter(|&j| !at_limit(j)).collect();
    if free.is_empty() {
        return None;
    }
    let f = free.len();
    let mean_curvature = free.iter().map(|&j| local.hessian[j * d + j]).sum::<f64>() / f as f64;
    let system = DMatrix::from_fn(f, f, |a, b| {
        let h = local.hessian[free[a] * d + free[b]];
        if a == b { h * (1.0 + damping) + damping * mean_curvature + f64::MIN_POSITIVE } else { h }
    });
    let down = DVector::from_fn(f, |a, _| -local.gradient[free[a]]);
    let solved = Cholesky::new(system)?.solve(&down);
    let mut step = vec![0.0; d];
    for (&j, &value) in free.iter().zip(solved.iter()) {
        step[j] = value;
    }
    step.iter().all(|s| s.is_finite()).then_some(step)
}
