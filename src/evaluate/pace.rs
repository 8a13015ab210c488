//! How many evaluations come next, and how long to rest before them.
//!
//! A slice is as long as it can be without making the job deaf to pause and cancel. Slices change no bit of a result.

use std::time::Duration;

/// A slice takes about this long.
const SLICE: Duration = Duration::from_millis(25);
/// The first slice of an attempt is short, so that its first checkpoint comes soon.
const FIRST_BUDGET: u64 = 64;
/// No slice is longer, whatever the last one took.
const MAX_BUDGET: u64 = 1 << 20;
/// A paced slice covers about this much time.
const PACED_SLICE_S: f64 = 0.1;

/// The size of slices, from what the last one took and the rate allowed.
#[derive(Debug, Clone)]
pub struct Pace {
    budget: u64,
    per_s: Option<f64>,
}

impl Pace {
    /// At most about `per_s` evaluations a second, or as many as can be made.
    #[must_use]
    pub fn new(per_s: Option<f64>) -> Self {
        Self { budget: FIRST_BUDGET, per_s }
    }

    /// Evaluations of the next slice, at least 1.
    #[must_use]
    pub fn budget(&self) -> u64 {
        match self.per_s {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a rate times a time, >= 0")]
            Some(per_s) => self.budget.min((per_s * PACED_SLICE_S) as u64).max(1),
            None => self.budget,
        }
    }

    /// What the last slice took; returns how long to rest now.
    pub fn took(&mut self, evaluations: u64, elapsed: Duration) -> Duration {
        if elapsed < SLICE / 2 {
            self.budget = (self.budget * 2).min(MAX_BUDGET);
        } else if elapsed > SLICE * 2 {
            self.budget = (self.budget / 2).max(1);
        }
        let due_s = self.per_s.map_or(0.0, |per_s| evaluations as f64 / per_s);
        Duration::from_secs_f64(due_s.clamp(0.0, 3600.0)).saturating_sub(elapsed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slices_grow_until_they_take_their_time_and_shrink_when_they_take_more() {
        let mut pace = Pace::new(None);
        for _ in 0..4 {
            assert_eq!(pace.took(pace.budget(), Duration::from_millis(1)), Duration::ZERO);
        }
        assert_eq!(pace.budget(), 1024);
        pace.took(1024, Duration::from_millis(25));
        assert_eq!(pace.budget(), 1024);
        pace.took(1024, Duration::from_millis(100));
        assert_eq!(pace.budget(), 512);
    }

    #[test]
    fn a_rate_is_kept_over_the_slice_and_its_rest() {
        let mut pace = Pace::new(Some(200.0));
        assert_eq!(pace.budget(), 20);
        assert_eq!(pace.took(20, Duration::from_millis(30)), Duration::from_millis(70));
        assert_eq!(pace.took(20, Duration::from_millis(300)), Duration::ZERO);
        assert_eq!(Pace::new(Some(0.5)).budget(), 1);
    }
}
