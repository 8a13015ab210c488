//! A motion as consecutive polynomials.

use super::limits::JointLimits;
use super::polynomial::Polynomial;

/// A part of a motion on which each joint follows one polynomial.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// Start, s from the start of the motion.
    pub start_s: f64,
    /// Duration, s; above 0.
    pub duration_s: f64,
    /// Position of each joint in gene order, rad or m, as a function of the time from the piece's start.
    pub joints: Vec<Polynomial>,
}

/// Positions, velocities and accelerations of all joints in gene order, rad or m, per s and per s^2.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Positions, rad or m.
    pub positions: Vec<f64>,
    /// Velocities, rad/s or m/s.
    pub velocities: Vec<f64>,
    /// Accelerations, rad/s^2 or m/s^2.
    pub accelerations: Vec<f64>,
}

impl State {
    /// At rest in `pose` (n values, rad or m).
    #[must_use]
    pub fn at_rest(pose: &[f64]) -> Self {
        let still = vec![0.0; pose.len()];
        Self { positions: pose.to_vec(), velocities: still.clone(), accelerations: still }
    }
}

impl Piece {
    /// The state `time_s` after the start of the motion.
    #[must_use]
    pub fn state(&self, time_s: f64) -> State {
        let own_s = (time_s - self.start_s).clamp(0.0, self.duration_s);
        let order = |order: usize| self.joints.iter().map(|joint| joint.derivatives()[order].at(own_s)).collect();
        State { positions: order(0), velocities: order(1), accelerations: order(2) }
    }

    /// Largest factor by which the piece must be slowed down uniformly to respect the limits of velocity, acceleration
    /// and jerk; below 1 if it may be faster.
    pub(super) fn haste(&self, limits: &[JointLimits]) -> f64 {
        let mut most = 0.0_f64;
        for (joint, limit) in self.joints.iter().zip(limits) {
            let [_, velocity, acceleration, jerk] = joint.derivatives();
            for time_s in joint.extrema(self.duration_s) {
                most = most
                    .max(velocity.at(time_s).abs() / limit.velocity)
                    .max((acceleration.at(time_s).abs() / limit.acceleration).sqrt())
                    .max((jerk.at(time_s).abs() / limit.jerk).cbrt());
            }
        }
        most
    }
}

/// The piece of `pieces` that holds `time_s`; the first or the last one outside the motion.
pub(super) fn at_time(pieces: &[Piece], time_s: f64) -> &Piece {
    let after = pieces.partition_point(|piece| piece.start_s <= time_s);
    &pieces[after.saturating_sub(1)]
}
