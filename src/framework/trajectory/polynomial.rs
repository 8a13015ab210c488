//! Polynomials of time up to degree 5, and the times of their extrema.
//!
//! A root of a polynomial lies between two neighbouring roots of its derivative, where the polynomial is monotone:
//! bisection finds it to the last bit. Starting from the linear fourth derivative, this isolates the extrema of jerk,
//! acceleration, velocity and position one after the other, without any sampling and with the same bits everywhere.

/// Steps after which an interval of doubles cannot be halved any further.
const HALVINGS: u32 = 1100;

/// c0 + c1 t + ... + c5 t^5; t in seconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Polynomial(pub [f64; 6]);

impl Polynomial {
    /// The value `value` at all times.
    #[must_use]
    pub fn constant(value: f64) -> Self {
        Self([value, 0.0, 0.0, 0.0, 0.0, 0.0])
    }

    /// The only polynomial of degree 5 that leads from `[position, velocity, acceleration]` at 0 to that of the end
    /// at `duration_s`.
    #[must_use]
    pub fn quintic(from: [f64; 3], to: [f64; 3], duration_s: f64) -> Self {
        let ([p0, v0, a0], [p1, v1, a1], t) = (from, to, duration_s);
        let (way, t2) = (p1 - p0, duration_s * duration_s);
        let third = 20.0 * way - (8.0 * v1 + 12.0 * v0) * t - (3.0 * a0 - a1) * t2;
        let fourth = -30.0 * way + (14.0 * v1 + 16.0 * v0) * t + (3.0 * a0 - 2.0 * a1) * t2;
        let fifth = 12.0 * way - 6.0 * (v1 + v0) * t - (a0 - a1) * t2;
        Self([p0, v0, a0 / 2.0, third / (2.0 * t2 * t), fourth / (2.0 * t2 * t2), fifth / (2.0 * t2 * t2 * t)])
    }

    /// The value after `time_s`.
    #[must_use]
    pub fn at(&self, time_s: f64) -> f64 {
        self.0.iter().rev().fold(0.0, |sum, coefficient| sum * time_s + coefficient)
    }

    /// The derivative with respect to time.
    #[must_use]
    pub fn derivative(&self) -> Self {
        let [_, c1, c2, c3, c4, c5] = self.0;
        Self([c1, 2.0 * c2, 3.0 * c3, 4.0 * c4, 5.0 * c5, 0.0])
    }

    /// This polynomial and its first three derivatives.
    #[must_use]
    pub fn derivatives(&self) -> [Self; 4] {
        let velocity = self.derivative();
        let acceleration = velocity.derivative();
        [*self, velocity, acceleration, acceleration.derivative()]
    }

    /// The times from 0 to `duration_s`, both included, among which this polynomial and its first three derivatives
    /// have all their extrema.
    #[must_use]
    pub fn extrema(&self, duration_s: f64) -> Vec<f64> {
        let [_, velocity, acceleration, jerk] = self.derivatives();
        let mut times = vec![0.0, duration_s];
        let mut turns = Vec::new();
        for polynomial in [jerk.derivative(), jerk, acceleration, velocity] {
            turns = polynomial.sign_changes(duration_s, &turns);
            times.extend(&turns);
        }
        times
    }

    /// The times within (0, `duration_s`) at which the value changes its sign, ascending; `turns` are those of the
    /// derivative.
    fn sign_changes(&self, duration_s: f64, turns: &[f64]) -> Vec<f64> {
        let borders: Vec<f64> = std::iter::once(0.0).chain(turns.iter().copied()).chain([duration_s]).collect();
        borders.windows(2).filter_map(|pair| self.sign_change(pair[0], pair[1])).collect()
    }

    /// The time of the only sign change in (`low`, `high`), where the polynomial is monotone.
    fn sign_change(&self, mut low: f64, mut high: f64) -> Option<f64> {
        let begins_below = self.at(low) < 0.0;
        if self.at(low) == 0.0 || self.at(high) == 0.0 || begins_below == (self.at(high) < 0.0) {
            return None;
        }
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(low, high);
            if middle <= low || middle >= high {
                break;
            }
            if (self.at(middle) < 0.0) == begins_below {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(low)
    }
}

#[cfg(test)]
mod tests {
    use super::Polynomial;
    use proptest::prelude::*;

    #[test]
    fn the_extrema_of_a_known_curve_are_found() {
        // v = (t - 1)(t - 2)(t - 3)(t - 4) = 24 - 50 t + 35 t^2 - 10 t^3 + t^4
        let position = Polynomial([0.0, 24.0, -25.0, 35.0 / 3.0, -2.5, 0.2]);
        let times = position.extrema(5.0);
        for root in [1.0, 2.0, 3.0, 4.0] {
            assert!(times.iter().any(|t| (t - root).abs() < 1e-12), "{root} is not among {times:?}");
        }
        // v' has a root at 2.5, v'' at 2.5 +- sqrt(5/12), v''' at 2.5
        let side = (5.0_f64 / 12.0).sqrt();
        for root in [2.5, 2.5 - side, 2.5 + side] {
            assert!(times.iter().any(|t| (t - root).abs() < 1e-9), "{root} is not among {times:?}");
        }
    }

    proptest! {
        #[test]
        fn no_sample_is_beyond_the_extrema(coefficients in prop::array::uniform6(-5.0..5.0_f64), duration_s in 0.1..3.0_f64) {
            let position = Polynomial(coefficients);
            let times = position.extrema(duration_s);
            for polynomial in position.derivatives() {
                let most = times.iter().map(|t| polynomial.at(*t).abs()).fold(0.0, f64::max);
                for step in 0..=500 {
                    let value = polynomial.at(duration_s * f64::from(step) / 500.0);
                    prop_assert!(value.abs() <= most * (1.0 + 1e-9) + 1e-9, "{} is beyond {}", value, most);
                }
            }
        }

        #[test]
        fn a_quintic_meets_both_ends(from in prop::array::uniform3(-2.0..2.0_f64), to in prop::array::uniform3(-2.0..2.0_f64), duration_s in 0.1..5.0_f64) {
            let curve = Polynomial::quintic(from, to, duration_s);
            for (order, polynomial) in curve.derivatives().iter().take(3).enumerate() {
                prop_assert!((polynomial.at(0.0) - from[order]).abs() < 1e-12);
                prop_assert!((polynomial.at(duration_s) - to[order]).abs() < 1e-6 / duration_s, "order {}", order);
            }
        }
    }
}
