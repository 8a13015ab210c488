//! The swept check of a straight joint motion, by conservative advancement (Mirtich 1996, "Impulse-based dynamic
//! simulation of rigid body systems", section 2.3).

use super::model::{CollisionModel, Workspace};
use crate::robot::travel_bound;

/// Share of a proved-free stride that is taken; the rest covers the rounding of distances (below 1e-7 of them).
const SHARE: f64 = 1.0 - 1e-6;

/// The first contact of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionCollision<'m> {
    /// Share of the motion, 0 at its start and 1 at its end, at which the pair is within the margin.
    pub at: f64,
    /// Distance there, m.
    pub distance_m: f64,
    /// Names of the two links, or of a link and an obstacle.
    pub pair: [&'m str; 2],
}

impl CollisionModel {
    /// The first contact of the motion `q(s) = from + s (to - from)`, 0 <= s <= 1; `None` if it is free.
    ///
    /// Let `L_p` bound the relative path of pair p over the whole motion ([`travel_bound`]), `L` that of every point of
    /// the robot in the base frame, and `d_p` the distances at s, all above the margin. The next check is at
    ///
    /// `s + min(step / L, min over p of d_p / L_p)`.
    ///
    /// So no point of a link moves more than the step between two checks, and no pair touches between them however thin
    /// it is: it would have to come closer by `d_p`, but its relative path is shorter. A pair that comes within the
    /// margin without touching may be missed between two checks.
    ///
    /// # Panics
    /// As [`check`](Self::check), for both ends.
    pub fn check_motion(&self, from: &[f64], to: &[f64], workspace: &mut Workspace) -> Option<MotionCollision<'_>> {
        let mut longest: f64 = 0.0;
        for solid in self.solids.iter().filter(|solid| solid.frame > 0) {
            longest = longest.max(travel_bound(&self.chain, from, to, [0, solid.frame], solid.reach_m()));
        }
        for (&pair, travel) in self.pairs.iter().zip(&mut workspace.travel_m) {
            let [first, second] = [&self.solids[pair.first], &self.solids[pair.second]];
            *travel = travel_bound(&self.chain, from, to, [first.frame, second.frame], second.reach_m());
        }
        let longest_stride = if longest > 0.0 { self.step_m / longest } else { 1.0 };
        let mut joints = std::mem::take(&mut workspace.joints);
        let mut at = 0.0;
        let found = loop {
            for (q, (a, b)) in joints.iter_mut().zip(from.iter().zip(to)) {
                *q = if at == 1.0 { *b } else { a + at * (b - a) };
            }
            self.place(&joints, workspace);
            match self.free_stride(longest_stride, workspace) {
                Err((distance_m, pair)) => break Some(MotionCollision { at, distance_m, pair }),
                Ok(_) if at == 1.0 => break None,
                Ok(stride) => at = (at + SHARE * stride).min(1.0),
            }
        };
        workspace.joints = joints;
        found
    }

    /// Share of the motion that is free from here, at most `longest`; or the first pair within the margin.
    fn free_stride(&self, longest: f64, workspace: &Workspace) -> Result<f64, (f64, [&str; 2])> {
        let mut stride = longest;
        for (&pair, &travel) in self.pairs.iter().zip(&workspace.travel_m) {
            let separation = self.separation(pair, workspace);
            if separation > self.margin_m && separation >= travel * stride {
                continue;
            }
            let distance = self.distance(pair, workspace);
            if distance <= self.margin_m {
                return Err((distance, self.pair_names(pair)));
            }
            if travel * stride > distance {
                stride = distance / travel;
            }
        }
        Ok(stride)
    }
}
