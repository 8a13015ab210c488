//! The time-optimal rest-to-rest profile with limited velocity, acceleration and jerk ("double S") of a share that goes
//! from 0 to 1.
//!
//! Source: L. Biagiotti and C. Melchiorri, *Trajectory Planning for Automatic Machines and Robots*, Springer 2008,
//! section 3.4, for zero velocities at both ends (DOI 10.1007/978-3-540-85629-0). Own code, since a general library for
//! online trajectories returns samples: the check needs the polynomials, and rest to rest has this closed form.
//!
//! Symbols: J jerk, Tj duration of a phase of jerk J, Ta duration of the acceleration (as of the deceleration), Tv
//! duration at constant velocity. The profile is symmetric: s(T - t) = 1 - s(t), T = 2 Ta + Tv.

use super::limits::JointLimits;

/// Poses that differ by at most this in every joint (rad or m) are considered equal.
pub const SAME_POSE: f64 = 1e-12;

/// A part of the profile on which its jerk is constant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Phase {
    /// Start, s from the start of the profile.
    pub start_s: f64,
    /// Duration, s; above 0.
    pub duration_s: f64,
    /// Coefficients of the share, constant first, in s from the phase's start.
    pub coefficients: [f64; 4],
}

/// The profile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DoubleS {
    jerk: f64,
    jerk_s: f64,
    acceleration_s: f64,
    cruise_s: f64,
}

impl DoubleS {
    /// The fastest profile for a share with these limits, per s, s^2 and s^3; all above 0.
    #[must_use]
    pub fn new(velocity: f64, acceleration: f64, jerk: f64) -> Self {
        let jerk_s = (velocity / jerk).sqrt().min(acceleration / jerk);
        let acceleration_s = jerk_s + velocity / (jerk * jerk_s);
        let cruise_s = 1.0 / velocity - acceleration_s;
        if cruise_s >= 0.0 {
            return Self { jerk, jerk_s, acceleration_s, cruise_s };
        }
        // The velocity limit is not reached.
        let jerk_s = (0.5 / jerk).cbrt().min(acceleration / jerk);
        let acceleration_s = 0.5 * (jerk_s + (jerk_s * jerk_s + 4.0 / (jerk * jerk_s)).sqrt());
        Self { jerk, jerk_s, acceleration_s, cruise_s: 0.0 }
    }

    /// The fastest straight motion between two poses (n values, rad or m), along which all joints share the profile;
    /// `None` if they are the same.
    #[must_use]
    pub fn between(from: &[f64], to: &[f64], limits: &[JointLimits]) -> Option<Self> {
        let mut least = [f64::INFINITY; 3];
        for (limit, (a, b)) in limits.iter().zip(from.iter().zip(to)) {
            let way = (b - a).abs();
            if way > SAME_POSE {
                let shares = [limit.velocity, limit.acceleration, limit.jerk].map(|most| most / way);
                least = std::array::from_fn(|order| least[order].min(shares[order]));
            }
        }
        let [velocity, acceleration, jerk] = least;
        velocity.is_finite().then(|| Self::new(velocity, acceleration, jerk))
    }

    /// Duration T, s.
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        2.0 * self.acceleration_s + self.cruise_s
    }

    /// The share after `time_s`, which may lie before the start or after the end.
    #[must_use]
    pub fn share_at(&self, time_s: f64) -> f64 {
        self.state(time_s.clamp(0.0, self.duration_s()))[0]
    }

    /// Share, its velocity and its acceleration at a time of the profile.
    fn state(&self, time_s: f64) -> [f64; 3] {
        let Self { jerk, jerk_s, acceleration_s, cruise_s } = *self;
        let peak = jerk * jerk_s * (acceleration_s - jerk_s);
        let accelerated = 0.5 * peak * acceleration_s;
        if time_s > acceleration_s + cruise_s {
            let [share, velocity, acceleration] = self.state(self.duration_s() - time_s);
            return [1.0 - share, velocity, -acceleration];
        }
        if time_s >= acceleration_s {
            return [accelerated + peak * (time_s - acceleration_s), peak, 0.0];
        }
        let left_s = acceleration_s - time_s;
        if left_s <= jerk_s {
            let share = accelerated - left_s * (peak - jerk * left_s * left_s / 6.0);
            return [share, peak - 0.5 * jerk * left_s * left_s, jerk * left_s];
        }
        let rising_s = time_s.min(jerk_s);
        let (share, velocity) = (jerk * rising_s.powi(3) / 6.0, 0.5 * jerk * rising_s * rising_s);
        let (steady_s, acceleration) = (time_s - rising_s, jerk * rising_s);
        [
            share + steady_s * (velocity + 0.5 * acceleration * steady_s),
            velocity + acceleration * steady_s,
            acceleration,
        ]
    }

    /// The phases, in order; together they last [`DoubleS::duration_s`].
    #[must_use]
    pub fn phases(&self) -> Vec<Phase> {
        let Self { jerk, jerk_s, acceleration_s, cruise_s } = *self;
        let steady_s = acceleration_s - 2.0 * jerk_s;
        let slowing_s = acceleration_s + cruise_s;
        let end_s = self.duration_s();
        let phases = [
            (0.0, jerk_s, jerk),
            (jerk_s, steady_s, 0.0),
            (acceleration_s - jerk_s, jerk_s, -jerk),
            (acceleration_s, cruise_s, 0.0),
            (slowing_s, jerk_s, -jerk),
            (slowing_s + jerk_s, steady_s, 0.0),
            (end_s - jerk_s, jerk_s, jerk),
        ];
        let lasting = phases.into_iter().filter(|(_, duration_s, _)| *duration_s > 0.0);
        lasting
            .map(|(start_s, duration_s, jerk)| {
                let [share, velocity, acceleration] = self.state(start_s);
                let coefficients = [share, velocity, acceleration / 2.0, jerk / 6.0];
                Phase { start_s, duration_s, coefficients }
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::DoubleS;
    use proptest::prelude::*;
    use rstest::rstest;

    // Computed by hand. All limits reached: Tj = 2/10 = 0.2, Ta = 0.2 + 0.5/2 = 0.45, Tv = 1/0.5 - 0.45 = 1.55.
    // Velocity 0.5 with jerk 1: Tj = sqrt(0.5), Ta = 2 Tj = 1.41421, Tv = 2 - 1.41421. Acceleration 1 with jerk 10 only:
    // Tj = 0.1, Ta = 0.05 + sqrt(0.0025 + 1) = 1.05125. Jerk 4 only: Tj = (1/8)^(1/3) = 0.5, Ta = 1.
    #[rstest]
    #[case::all_three([0.5, 2.0, 10.0], 2.45)]
    #[case::without_steady_acceleration([0.5, 9.0, 1.0], 3.414_213_562_373_095)]
    #[case::without_cruise([9.0, 1.0, 10.0], 2.102_498_439_450_078)]
    #[case::jerk_alone([9.0, 9.0, 4.0], 2.0)]
    fn durations_are_those_computed_by_hand(#[case] limits: [f64; 3], #[case] expected_s: f64) {
        let [velocity, acceleration, jerk] = limits;
        let profile = DoubleS::new(velocity, acceleration, jerk);
        assert!((profile.duration_s() - expected_s).abs() < 1e-12, "{}", profile.duration_s());
        assert_eq!((profile.share_at(-1.0), profile.share_at(9.0)), (0.0, 1.0));
        assert!((profile.share_at(0.5 * expected_s) - 0.5).abs() < 1e-12);
    }

    proptest! {
        #[test]
        fn phases_are_joined_without_a_gap(velocity in 0.01..50.0_f64, acceleration in 0.01..50.0_f64, jerk in 0.01..500.0_f64) {
            let profile = DoubleS::new(velocity, acceleration, jerk);
            let phases = profile.phases();
            let mut state = [0.0, 0.0, 0.0];
            let mut time_s = 0.0;
            for phase in &phases {
                let [c0, c1, c2, c3] = phase.coefficients;
                prop_assert!((phase.start_s - time_s).abs() < 1e-9);
                let scale = [1.0, velocity, acceleration];
                for (order, value) in [c0, c1, 2.0 * c2].into_iter().enumerate() {
                    prop_assert!((value - state[order]).abs() < 1e-9 * scale[order], "{} of {:?}", order, phase);
                }
                let t = phase.duration_s;
                state = [c0 + t * (c1 + t * (c2 + t * c3)), c1 + t * (2.0 * c2 + 3.0 * t * c3), 2.0 * c2 + 6.0 * t * c3];
                time_s += t;
                prop_assert!(state[1] <= velocity * (1.0 + 1e-9) && state[2].abs() <= acceleration * (1.0 + 1e-9));
            }
            prop_assert!((state[0] - 1.0).abs() < 1e-12 && state[1].abs() < 1e-9 * velocity);
            prop_assert!((time_s - profile.duration_s()).abs() < 1e-9);
        }
    }
}
