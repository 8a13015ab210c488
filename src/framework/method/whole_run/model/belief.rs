//! MODEL-IET's belief about the feature map: a prior mean (a simulator, or the average) plus a Gaussian process.

use super::kernel::Poses;
use super::process::{Family, Process};
use crate::distance::{distance, squared_distance};
use crate::method::whole_run::refine::Local;
use crate::method::whole_run::space::Space;
use crate::method::whole_run::{FeatureMap, Trial};
use nalgebra::DMatrix;

/// Step of central differences through a prior, rad.
const DIFFERENCE: f64 = 1e-4;

/// A fitted belief with its scratch space.
pub(super) struct Belief<'a> {
    process: Process,
    prior: Option<&'a mut dyn FeatureMap>,
    average: Vec<f64>,
    /// Posterior mean at the last pose predicted.
    pub mean: Vec<f64>,
    jacobian: Vec<f64>,
    slope: Vec<f64>,
    moved: Vec<f64>,
    ahead: Vec<f64>,
    behind: Vec<f64>,
}

/// Objective of a search through the belief.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Aim<'a> {
    /// Goal X_j.
    pub goal: &'a [f64],
    /// Weight of `m var(q)`: positive values avoid the unknown, negative ones are optimistic.
    pub caution: f64,
}

impl<'a> Belief<'a> {
    /// Fits the belief to the trials of `logs`; `None` if nothing was observed.
    pub fn fit(
        space: &Space,
        logs: [&[Trial]; 2],
        goals: &[Vec<f64>],
        mut prior: Option<&'a mut dyn FeatureMap>,
        noise: f64,
    ) -> Option<Self> {
        let m = goals.first()?.len();
        let seen: Vec<(&[f64], &[f64])> = logs
            .into_iter()
            .flatten()
            .filter_map(|trial| Some((trial.joints.as_slice(), trial.observation.as_deref()?)))
            .collect();
        let (_, first) = *seen.first()?;
        let n = seen.len();
        let mut poses = Poses::new(space);
        let mut expected = vec![0.0; m];
        let mut residuals = DMatrix::zeros(n, m);
        let mut average = vec![0.0; m];
        for (i, (joints, observed)) in seen.iter().enumerate() {
            poses.push(joints);
            if let Some(prior) = prior.as_deref_mut() {
                prior.predict(joints, &mut expected);
            }
            for o in 0..m {
                residuals[(i, o)] = observed[o] - expected[o];
            }
        }
        if prior.is_none() {
            for (mean, mut column) in average.iter_mut().zip(residuals.column_iter_mut()) {
                *mean = column.mean();
                column.add_scalar_mut(-*mean);
            }
        }
        let scale = if prior.is_some() {
            median((0..n).map(|i| residuals.row(i).norm()).collect())
        } else {
            median(goals.iter().map(|goal| distance(first, goal)).collect())
        };
        let family = if space.axes.iter().any(|a| a.revolute) { Family::Trig } else { Family::Se };
        let d = space.len();
        Some(Self {
            process: Process::fit(&poses, &residuals, family, scale.max(1e-9), noise)?,
            prior,
            average,
            mean: vec![0.0; m],
            jacobian: vec![0.0; m * d],
            slope: vec![0.0; d],
            moved: vec![0.0; d],
            ahead: vec![0.0; m],
            behind: vec![0.0; m],
        })
    }

    /// Writes the posterior mean to `self.mean`; returns the variance of one feature.
    pub fn predict(&mut self, pose: &[f64]) -> f64 {
        let variance = self.process.predict(pose, &mut self.mean);
        self.add_prior(pose);
        variance
    }

    /// Writes the posterior mean to `self.mean`, without computing the variance.
    pub fn predict_mean(&mut self, pose: &[f64]) {
        self.process.predict_mean(pose, &mut self.mean);
        self.add_prior(pose);
    }

    /// Variance of one feature at the pose of the last prediction.
    pub fn variance_there(&mut self) -> f64 {
        self.process.variance_there()
    }

    /// Upper bound of all variances.
    pub fn largest_variance(&self) -> f64 {
        self.process.amplitude_squared()
    }

    fn add_prior(&mut self, pose: &[f64]) {
        if let Some(prior) = self.prior.as_deref_mut() {
            prior.predict(pose, &mut self.ahead);
            self.mean.iter_mut().zip(&self.ahead).for_each(|(mean, p)| *mean += p);
        } else {
            self.mean.iter_mut().zip(&self.average).for_each(|(mean, a)| *mean += a);
        }
    }

    /// Score `|mu - X|^2 + caution m var`.
    pub fn score(&mut self, pose: &[f64], aim: Aim) -> f64 {
        let variance = self.predict(pose);
        squared_distance(&self.mean, aim.goal) + aim.caution * aim.goal.len() as f64 * variance
    }

    /// Like [`Belief::score`], with gradient and Gauss-Newton Hessian; returns whether the score is below `bound`. If
    /// not, `local` stays unchanged and only what is needed to decide is computed.
    pub fn score_with_slopes(&mut self, pose: &[f64], aim: Aim, bound: f64, local: &mut Local) -> bool {
        let (d, m) = (pose.len(), aim.goal.len());
        let weight = aim.caution * m as f64;
        self.predict_mean(pose);
        let miss = squared_distance(&self.mean, aim.goal);
        if weight >= 0.0 && miss >= bound {
            return false;
        }
        let value = miss + weight * self.variance_there();
        if value.is_nan() || value >= bound {
            return false;
        }
        local.value = value;
        self.process.slopes_there(&mut self.jacobian, &mut self.slope);
        if let Some(prior) = self.prior.as_deref_mut() {
            self.moved.copy_from_slice(pose);
            for (j, &joint) in pose.iter().enumerate() {
                self.moved[j] = joint + DIFFERENCE;
                prior.predict(&self.moved, &mut self.ahead);
                self.moved[j] = joint - DIFFERENCE;
                prior.predict(&self.moved, &mut self.behind);
                self.moved[j] = joint;
                for o in 0..m {
                    self.jacobian[o * d + j] += (self.ahead[o] - self.behind[o]) / (2.0 * DIFFERENCE);
                }
            }
        }
        for j in 0..d {
            let pull: f64 = (0..m).map(|o| self.jacobian[o * d + j] * (self.mean[o] - aim.goal[o])).sum();
            local.gradient[j] = 2.0 * pull + weight * self.slope[j];
            for i in 0..=j {
                let h: f64 = (0..m).map(|o| self.jacobian[o * d + i] * self.jacobian[o * d + j]).sum();
                local.hessian[i * d + j] = 2.0 * h;
                local.hessian[j * d + i] = 2.0 * h;
            }
        }
        true
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    match values.len() {
        0 => 0.0,
        n if n % 2 == 1 => values[n / 2],
        n => f64::midpoint(values[n / 2 - 1], values[n / 2]),
    }
}
