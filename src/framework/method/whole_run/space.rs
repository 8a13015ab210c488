//! The joint space that a method searches: limits, kinds, home and forbidden poses, and the identification moves.

use crate::random::RandomStream;
use crate::robot::{Chain, Gene, JointKind};
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};
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
    /// Whether the joint can turn a whole turn or more, so that every position has an equivalent one turn away.
    #[must_use]
    pub fn turns(&self) -> bool {
        self.revolute && self.upper - self.lower >= TAU - 1e-9
    }

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
    /// Velocity limit per joint, rad/s or m/s.
    speeds: Vec<f64>,
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
        let space = Self::new(chain.genes().iter().zip(chain.home()).map(axis).collect());
        let limits = chain.genes().iter().zip(&space.speeds);
        let speeds = limits.map(|(gene, usual)| gene.velocity.filter(|limit| *limit > 0.0).unwrap_or(*usual)).collect();
        Self { speeds, ..space }
    }

    /// Every pose inside the limits of `axes` is allowed; each joint moves at 1 rad/s, or a stroke in pi seconds.
    #[must_use]
    pub fn new(axes: Vec<Axis>) -> Self {
        let speeds = axes.iter().map(|axis| 1.0 / axis.scale()).collect();
        Self { axes, speeds, allows: None }
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

    /// The same space without the limits of the joints that turn a whole turn or more: a search in it does not end at a
    /// limit that its pose's equivalent does not meet. Bring its poses back with [`Space::equivalent`].
    #[must_use]
    pub fn unwound(&self) -> Self {
        let mut free = self.clone();
        for axis in free.axes.iter_mut().filter(|axis| axis.turns()) {
            (axis.lower, axis.upper) = (axis.lower - 100.0 * TAU, axis.upper + 100.0 * TAU);
        }
        free
    }

    /// The pose equal to `pose` but for whole turns, inside the limits and as near to `reference` as they permit; if that
    /// one is not allowed, the first one inside the limits.
    #[must_use]
    pub fn equivalent(&self, pose: &[f64], reference: &[f64]) -> Vec<f64> {
        let turned = |towards: &[f64]| -> Vec<f64> {
            let joints = pose.iter().zip(towards).zip(&self.axes);
            let nearest = joints.map(|((&q, &near), axis)| if axis.turns() { turned_into(q, near, axis) } else { q });
            nearest.collect()
        };
        let near = turned(reference);
        if self.allows(&near) { near } else { turned(pose) }
    }

    /// Time of the straight motion between two poses at the joints' velocity limits, seconds.
    #[must_use]
    pub fn motion_s(&self, from: &[f64], to: &[f64]) -> f64 {
        let times = from.iter().zip(to).zip(&self.speeds).map(|((from, to), speed)| (to - from).abs() / speed);
        times.fold(0.0, f64::max)
    }

    /// Root mean square over the joints of the difference of two poses, rad with pi per stroke; joints that turn are
    /// compared the short way round.
    #[must_use]
    pub fn apart(&self, a: &[f64], b: &[f64]) -> f64 {
        let squares = a.iter().zip(b).zip(&self.axes).map(|((a, b), axis)| {
            let way = if axis.turns() { (a - b) - TAU * ((a - b) / TAU).round() } else { (a - b) * axis.scale() };
            way * way
        });
        (squares.sum::<f64>() / self.len().max(1) as f64).sqrt()
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

/// The position equal to `q` but for whole turns, inside the limits of `axis` and as near to `near` as they permit.
fn turned_into(q: f64, near: f64, axis: &Axis) -> f64 {
    let mut turned = q + TAU * ((near - q) / TAU).round();
    while turned > axis.upper {
        turned -= TAU;
    }
    while turned < axis.lower {
        turned += TAU;
    }
    // A range of exactly one turn may leave the position a rounding error beyond its limit.
    turned.clamp(axis.lower, axis.upper)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arm() -> Space {
        let axis = |turns: f64| Axis { lower: -turns * PI, upper: turns * PI, home: 0.0, revolute: true };
        Space::new(vec![axis(2.0), axis(0.9), axis(1.0)])
    }

    #[test]
    fn an_equivalent_pose_is_the_nearest_one_inside_the_limits() {
        let near = arm().equivalent(&[-6.0, 2.0, 3.0], &[0.5, -2.0, 0.0]);
        assert!((near[0] - (TAU - 6.0)).abs() < 1e-12, "{near:?}");
        assert_eq!(near[1..], [2.0, 3.0]);
        // One turn further on would be nearer to the reference, but outside the limits.
        let inside = arm().equivalent(&[1.0, 0.0, 4.0], &[6.2, 0.0, 3.1]);
        assert!((inside[0] - 1.0).abs() < 1e-12 && (inside[2] - (4.0 - TAU)).abs() < 1e-12, "{inside:?}");
        let only = arm().only(Arc::new(|pose: &[f64]| pose[0] < 0.0));
        assert_eq!(only.equivalent(&[-6.0, 0.0, 0.0], &[0.5, 0.0, 0.0])[0], -6.0);
    }

    #[test]
    fn a_joint_that_turns_is_compared_the_short_way_round() {
        let apart = arm().apart(&[-6.0, 0.0, 0.0], &[6.0, 0.0, 0.0]);
        assert!((apart - (12.0 - 2.0 * TAU).abs() / 3.0_f64.sqrt()).abs() < 1e-12, "{apart}");
        let apart = arm().apart(&[0.0, -2.5, 0.0], &[0.0, 2.5, 0.0]);
        assert!((apart - 5.0 / 3.0_f64.sqrt()).abs() < 1e-12, "{apart}");
    }

    #[test]
    fn a_motion_lasts_as_long_as_its_slowest_joint() {
        let mut space = arm();
        space.speeds = vec![2.0, 0.5, 1.0];
        assert_eq!(space.motion_s(&[0.0; 3], &[3.0, -1.0, 0.5]), 2.0);
    }
}
