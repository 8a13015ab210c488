//! The joint space that a method searches: limits, kinds, home and forbidden poses, and the identification moves.

use crate::random::RandomStream;
use crate::robot::{Chain, Gene, JointKind};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use std::fmt;
use std::sync::Arc;

/// Number of bisections on the way back to an allowed pose.
const BISECTIONS: u32 = 12;

/// Predicate that says whether a pose (rad or m) may be executed.
pub type Allows = Arc<dyn Fn(&[f64]) -> bool + Send + Sync>;

/// One joint of the search space.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// Lower limit, rad or m.
    pub lower: f64,
    /// Upper limit, rad or m.
    pub upper: f64,
    /// Start position, rad or m.
    pub home: f64,
    /// Whether positions are angles.
    pub revolute: bool,
}

impl Axis {
    /// Radians per unit of this joint for distances: 1 for angles; a whole stroke counts as pi.
    #[must_use]
    pub fn scale(&self) -> f64 {
        if self.revolute || self.upper <= self.lower { 1.0 } else { PI / (self.upper - self.lower) }
    }
}

/// All joints, in gene order, and the allowed poses.
#[derive(Clone)]
pub struct Space {
    /// The d joints.
    pub axes: Vec<Axis>,
    /// Additional condition on poses inside the limits; `None` if every pose may be executed.
    allows: Option<Allows>,
}

impl fmt::Debug for Space {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Space").field("axes", &self.axes).finish_non_exhaustive()
    }
}

impl Space {
    /// The free joints of `chain`, from its home; every pose inside the limits is allowed.
    #[must_use]
    pub fn of(chain: &Chain) -> Self {
        let axis = |(gene, &home): (&Gene, &f64)| Axis {
            lower: gene.lower,
            upper: gene.upper,
            home,
            revolute: gene.kind != JointKind::Prismatic,
        };
        Self::new(chain.genes().iter().zip(chain.home()).map(axis).collect())
    }

    /// Every pose inside the limits of `axes` is allowed.
    #[must_use]
    pub fn new(axes: Vec<Axis>) -> Self {
        Self { axes, allows: None }
    }

    /// Restricts the space to poses that pass `allows`.
    #[must_use]
    pub fn only(self, allows: Allows) -> Self {
        Self { allows: Some(allows), ..self }
    }

    /// Whether a pose inside the limits may be executed.
    #[must_use]
    pub fn allows(&self, pose: &[f64]) -> bool {
        self.allows.as_ref().is_none_or(|allows| allows(pose))
    }

    /// Number of joints d.
    #[must_use]
    pub fn len(&self) -> usize {
        self.axes.len()
    }

    /// Whether there are no joints.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.axes.is_empty()
    }

    /// Moves `pose` back towards the allowed `start` until it is allowed.
    pub fn retreat(&self, start: &[f64], pose: &mut [f64]) {
        if self.allows(pose) {
            return;
        }
        let end = pose.to_vec();
        let (mut inside, mut outside) = (0.0, 1.0);
        let on_the_way = |share: f64, pose: &mut [f64]| {
            pose.iter_mut().zip(start).zip(&end).for_each(|((p, s), e)| *p = s + (e - s) * share);
        };
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (inside + outside);
            on_the_way(middle, pose);
            if self.allows(pose) {
                inside = middle;
            } else {
                outside = middle;
            }
        }
        on_the_way(inside, pose);
    }

    /// Start pose, clamped to the limits.
    #[must_use]
    pub fn home(&self) -> Vec<f64> {
        self.axes.iter().map(|a| a.home.clamp(a.lower, a.upper)).collect()
    }

    /// The `index`-th identification pose: home, then home with joint `index - 1` moved by `step` (rad, or the
    /// equivalent share of a stroke) towards the side with more room, up to the limit.
    #[must_use]
    pub fn identification(&self, index: usize, step: f64) -> Option<Vec<f64>> {
        let home = self.home();
        match index.checked_sub(1) {
            None => Some(home),
            Some(joint) => (joint < self.len()).then(|| self.moved(&home, joint, step)),
        }
    }

    /// `pose` with one joint moved by `step` (rad, or the equivalent share of a stroke) towards the side with more
    /// room, up to the limit.
    #[must_use]
    pub fn moved(&self, pose: &[f64], joint: usize, step: f64) -> Vec<f64> {
        let (axis, at) = (self.axes[joint], pose[joint]);
        let move_by = step / axis.scale();
        let up = axis.upper - at >= move_by || axis.upper - at >= at - axis.lower;
        let mut moved = pose.to_vec();
        moved[joint] = if up { (at + move_by).min(axis.upper) } else { (at - move_by).max(axis.lower) };
        moved
    }

    /// Writes a uniformly random pose within the limits.
    pub fn uniform(&self, random: &mut RandomStream, pose: &mut [f64]) {
        for (value, axis) in pose.iter_mut().zip(&self.axes) {
            *value = random.between(axis.lower, axis.upper);
        }
    }

    /// Writes `centre` plus a Gaussian of standard deviation `spread` (rad or share of a stroke), clamped to the
    /// limits.
    pub fn near(&self, centre: &[f64], spread: f64, random: &mut RandomStream, pose: &mut [f64]) {
        for ((value, axis), at) in pose.iter_mut().zip(&self.axes).zip(centre) {
            *value = (at + spread / axis.scale() * random.normal()).clamp(axis.lower, axis.upper);
        }
    }
}
