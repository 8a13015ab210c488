//! A motion through knots without stopping at them: one quintic per joint and leg.
//!
//! Velocities at the knots follow F. N. Fritsch and J. Butland, *A method for constructing local monotone piecewise
//! cubic interpolants*, SIAM J. Sci. Stat. Comput. 5 (1984), DOI 10.1137/0905021: 0 where a joint turns or stands still,
//! otherwise a weighted harmonic mean of the neighbouring slopes. Accelerations are the mean, weighted by the legs'
//! durations, of the second derivatives that the two neighbouring cubics have at the knot. A quintic need not be monotone: a joint that would leave its
//! position range rests at both knots of that leg instead, which makes it monotone there.
//!
//! Durations start from the straight motions' and are adjusted leg by leg; a last uniform scaling of the time, under
//! which velocity, acceleration and jerk shrink by its first, second and third power, brings all within the limits.

use super::limits::JointLimits;
use super::piece::Piece;
use super::polynomial::Polynomial;

/// Rounds in which the durations of the legs are adjusted.
const ROUNDS: usize = 20;
/// Factor by which the motion is slower than the limits allow, against rounding.
const MARGIN: f64 = 1.0 + 1e-9;

/// Poses to pass and how fast.
pub struct Route<'a> {
    /// Poses in order; at rest at the first and the last. Neighbours differ unless the leg between them has a least
    /// duration above 0.
    pub knots: Vec<&'a [f64]>,
    /// Durations to start from, one per leg, s; above 0.
    pub straight_s: Vec<f64>,
    /// Least duration of each leg, s.
    pub least_s: Vec<f64>,
    /// Limits of the joints, of which all is used.
    pub limits: &'a [JointLimits],
}

impl Route<'_> {
    /// The pieces, one per leg.
    pub fn pieces(&self) -> Vec<Piece> {
        let mut rests = vec![vec![false; self.limits.len()]; self.knots.len()];
        loop {
            let pieces = self.timed(&rests);
            let mut is_within = true;
            for (leg, piece) in pieces.iter().enumerate() {
                for (joint, limit) in self.limits.iter().enumerate() {
                    let rested = rests[leg][joint] && rests[leg + 1][joint];
                    if !rested && leaves(piece, joint, limit) {
                        (rests[leg][joint], rests[leg + 1][joint]) = (true, true);
                        is_within = false;
                    }
                }
            }
            if is_within {
                return pieces;
            }
        }
    }

    /// The fastest pieces found, if the joints marked in `rests` (knots x joints) rest.
    fn timed(&self, rests: &[Vec<bool>]) -> Vec<Piece> {
        let mut durations_s: Vec<f64> =
            self.straight_s.iter().zip(&self.least_s).map(|(s, least)| s.max(*least)).collect();
        let mut best: Option<(f64, Vec<f64>)> = None;
        for _ in 0..ROUNDS {
            let haste: Vec<f64> =
                self.joined(&durations_s, rests).iter().map(|piece| piece.haste(self.limits) * MARGIN).collect();
            let early = self.least_s.iter().zip(&durations_s).map(|(least, duration)| least / duration);
            let factor = haste.iter().copied().chain(early).fold(0.0, f64::max);
            let total_s = factor * durations_s.iter().sum::<f64>();
            if best.as_ref().is_none_or(|(least_s, _)| total_s < *least_s) {
                best = Some((total_s, durations_s.iter().map(|duration| factor * duration).collect()));
            }
            for ((duration, haste), least) in durations_s.iter_mut().zip(haste).zip(&self.least_s) {
                *duration = (*duration * haste.sqrt().clamp(0.5, 2.0)).max(*least);
            }
        }
        self.joined(&best.map_or(durations_s, |(_, durations_s)| durations_s), rests)
    }

    /// The pieces for these durations.
    fn joined(&self, durations_s: &[f64], rests: &[Vec<bool>]) -> Vec<Piece> {
        let columns: Vec<Vec<[f64; 3]>> =
            (0..self.limits.len()).map(|joint| self.states(joint, durations_s, rests)).collect();
        let mut start_s = 0.0;
        let mut pieces = Vec::with_capacity(durations_s.len());
        for (leg, &duration_s) in durations_s.iter().enumerate() {
            let joints =
                columns.iter().map(|states| Polynomial::quintic(states[leg], states[leg + 1], duration_s)).collect();
            pieces.push(Piece { start_s, duration_s, joints });
            start_s += duration_s;
        }
        pieces
    }

    /// Position, velocity and acceleration of a joint at each knot.
    fn states(&self, joint: usize, durations_s: &[f64], rests: &[Vec<bool>]) -> Vec<[f64; 3]> {
        let positions: Vec<f64> = self.knots.iter().map(|knot| knot[joint]).collect();
        let slopes: Vec<f64> =
            positions.windows(2).zip(durations_s).map(|(pair, duration)| (pair[1] - pair[0]) / duration).collect();
        let last = positions.len() - 1;
        let rests_at = |knot: usize| {
            knot == 0 || knot == last || rests[knot][joint] || slopes[knot - 1] == 0.0 || slopes[knot] == 0.0
        };
        let velocity = |knot: usize| {
            if rests_at(knot) || (slopes[knot - 1] < 0.0) != (slopes[knot] < 0.0) {
                return 0.0;
            }
            let (before, after) = (durations_s[knot - 1], durations_s[knot]);
            let (w1, w2) = (2.0 * after + before, after + 2.0 * before);
            (w1 + w2) / (w1 / slopes[knot - 1] + w2 / slopes[knot])
        };
        let velocities: Vec<f64> = (0..=last).map(velocity).collect();
        let acceleration = |knot: usize| {
            if rests_at(knot) {
                return 0.0;
            }
            let (before, after) = (durations_s[knot - 1], durations_s[knot]);
            let ending = (2.0 * velocities[knot - 1] + 4.0 * velocities[knot] - 6.0 * slopes[knot - 1]) / before;
            let starting = (6.0 * slopes[knot] - 4.0 * velocities[knot] - 2.0 * velocities[knot + 1]) / after;
            (before * ending + after * starting) / (before + after)
        };
        (0..=last).map(|knot| [positions[knot], velocities[knot], acceleration(knot)]).collect()
    }
}

/// Whether a joint leaves its position range between the knots of `piece`, which may themselves be outside.
fn leaves(piece: &Piece, joint: usize, limit: &JointLimits) -> bool {
    let position = &piece.joints[joint];
    let ends = [position.at(0.0), position.at(piece.duration_s)];
    let (lower, upper) = (limit.lower.min(ends[0]).min(ends[1]), limit.upper.max(ends[0]).max(ends[1]));
    position.extrema(piece.duration_s).into_iter().any(|time_s| !(lower..=upper).contains(&position.at(time_s)))
}
