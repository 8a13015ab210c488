//! The swept check of a straight or any other joint motion, by conservative advancement (Mirtich 1996, "Impulse-based dynamic
//! simulation of rigid body systems", section 2.3).

use super::model::{CollisionModel, Workspace};
use crate::robot::travel_bound;

/// Share of a proved-free stride that is taken. The rest covers the tolerance of the search for closest points, whose
/// distances are up to 1e-5 of them too large between round shapes; the margin covers it at contact.
const SHARE: f64 = 1.0 - 1e-3;

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
        let travel = |frames, reach_m| travel_bound(&self.chain, from, to, frames, reach_m);
        let pose = |at: f64, joints: &mut [f64]| {
            for (q, (a, b)) in joints.iter_mut().zip(from.iter().zip(to)) {
                *q = if at == 1.0 { *b } else { a + at * (b - a) };
            }
        };
        self.first_contact(travel, pose, workspace)
    }

    /// The first contact of any motion `q(s)`, 0 <= s <= 1, such as a blended one; `None` if it is free. `curve` writes
    /// the n joints at s; `rates` bounds |dq/ds| of each joint over the whole motion, rad or m.
    ///
    /// The checks are spaced as those of [`check_motion`](Self::check_motion), with the paths of a motion in which every
    /// joint moves at its bound all the time.
    ///
    /// # Panics
    /// As [`check`](Self::check), for every pose of the curve.
    pub fn check_curve(
        &self,
        curve: impl FnMut(f64, &mut [f64]),
        rates: &[f64],
        workspace: &mut Workspace,
    ) -> Option<MotionCollision<'_>> {
        let mut curve = curve;
        let mut start = vec![0.0; self.chain.len()];
        curve(0.0, &mut start);
        // No joint leaves [start - rate, start + rate], so a motion across twice its travel bounds both reach and path.
        let lowest: Vec<f64> = start.iter().zip(rates).map(|(q, rate)| q - rate).collect();
        let highest: Vec<f64> = start.iter().zip(rates).map(|(q, rate)| q + rate).collect();
        let travel = |frames, reach_m| 0.5 * travel_bound(&self.chain, &lowest, &highest, frames, reach_m);
        self.first_contact(travel, curve, workspace)
    }

    /// The first contact of the motion that `pose` writes for shares from 0 to 1. `travel` bounds the path over the whole
    /// motion of a body within a radius of the second frame's origin, seen from the first frame.
    fn first_contact(
        &self,
        travel: impl Fn([usize; 2], f64) -> f64,
        mut pose: impl FnMut(f64, &mut [f64]),
        workspace: &mut Workspace,
    ) -> Option<MotionCollision<'_>> {
        let moving = self.solids.iter().filter(|solid| solid.frame > 0);
        let longest = moving.map(|solid| travel([0, solid.frame], solid.reach_m())).fold(0.0, f64::max);
        workspace.travel_m.clear();
        workspace.travel_m.extend(self.pairs.iter().map(|&pair| {
            let [first, second] = [&self.solids[pair.first], &self.solids[pair.second]];
            travel([first.frame, second.frame], second.reach_m())
        }));
        let longest_stride = if longest > 0.0 { self.step_m / longest } else { 1.0 };
        let mut joints = std::mem::take(&mut workspace.joints);
        let mut at = 0.0;
        let found = loop {
            pose(at, &mut joints);
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
