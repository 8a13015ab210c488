//! Poses of a chain within its limits, and their distance; a whole stroke of a prismatic joint counts as pi.

use crate::random::RandomStream;
use crate::robot::{Chain, JointKind};
use std::f64::consts::PI;

/// Limits of one joint, rad or m, and the radians that one unit of it counts.
#[derive(Debug, Clone, Copy)]
struct Axis {
    lower: f64,
    upper: f64,
    scale: f64,
}

#[derive(Debug, Clone)]
pub(super) struct JointSpace(Vec<Axis>);

impl JointSpace {
    pub(super) fn of(chain: &Chain) -> Self {
        let axes = chain.genes().iter().map(|gene| {
            let stroke = gene.upper - gene.lower;
            let is_scaled = gene.kind == JointKind::Prismatic && stroke > 0.0;
            Axis { lower: gene.lower, upper: gene.upper, scale: if is_scaled { PI / stroke } else { 1.0 } }
        });
        Self(axes.collect())
    }

    /// Euclidean distance, rad.
    pub(super) fn distance(&self, a: &[f64], b: &[f64]) -> f64 {
        let each = self.0.iter().zip(a.iter().zip(b)).map(|(axis, (a, b))| (axis.scale * (a - b)).powi(2));
        each.sum::<f64>().sqrt()
    }

    pub(super) fn uniform(&self, random: &mut RandomStream) -> Vec<f64> {
        self.0.iter().map(|axis| random.between(axis.lower, axis.upper)).collect()
    }

    /// A pose around `centre`, uniform within `share` of the limits.
    pub(super) fn around(&self, centre: &[f64], share: f64, random: &mut RandomStream) -> Vec<f64> {
        let around = |(axis, at): (&Axis, &f64)| {
            let half = 0.5 * share * (axis.upper - axis.lower);
            random.between(at - half, at + half).clamp(axis.lower, axis.upper)
        };
        self.0.iter().zip(centre).map(around).collect()
    }

    /// The pose at most `step` rad from `from` on the way to `to`, and whether it is `to`.
    pub(super) fn towards(&self, from: &[f64], to: &[f64], step: f64) -> (Vec<f64>, bool) {
        let distance = self.distance(from, to);
        if distance <= step {
            return (to.to_vec(), true);
        }
        let share = step / distance;
        (from.iter().zip(to).map(|(a, b)| a + share * (b - a)).collect(), false)
    }
}
