//! The system clock and random source, as implementations of the ports.

use crate::app::model::Timestamp;
use crate::app::model::limits::SEED_BOUND;
use crate::app::ports::{Clock, Ids};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};
use uuid::Uuid;

/// Clock port on the clocks of the operating system.
#[derive(Debug, Clone, Copy)]
pub struct SystemClock {
    started: Instant,
}

impl SystemClock {
    /// A clock whose monotonic time starts now.
    #[must_use]
    pub fn new() -> Self {
        Self { started: Instant::now() }
    }
}

impl Default for SystemClock {
    fn default() -> Self {
        Self::new()
    }
}

impl Clock for SystemClock {
    fn now(&self) -> Timestamp {
        let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
        Timestamp(i64::try_from(since.as_millis()).unwrap_or(i64::MAX))
    }

    fn elapsed(&self) -> Duration {
        self.started.elapsed()
    }
}

/// The operating system's random source.
#[derive(Debug, Clone, Copy, Default)]
pub struct SystemIds;

impl Ids for SystemIds {
    fn uuid(&self) -> Uuid {
        Uuid::now_v7()
    }

    fn seed(&self) -> u64 {
        // The high 60 bits of a version 4 UUID are random except for the version; 53 of them form a seed.
        (Uuid::new_v4().as_u128() >> 68) as u64 % SEED_BOUND
    }

    fn token(&self) -> String {
        // 122 random bits each, so that their combination has 128 random bits.
        let (a, b) = (Uuid::new_v4().as_u128(), Uuid::new_v4().as_u128());
        format!("{:032x}", a ^ b.rotate_left(64))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn seeds_and_tokens_differ_and_keep_their_bounds() {
        let seeds: BTreeSet<u64> = (0..1000).map(|_| SystemIds.seed()).collect();
        assert!(seeds.len() == 1000 && seeds.iter().all(|seed| *seed < SEED_BOUND));
        let tokens: BTreeSet<String> = (0..1000).map(|_| SystemIds.token()).collect();
        assert!(tokens.len() == 1000 && tokens.iter().all(|token| token.len() == 32));
        // Every hexadecimal digit takes every value, so no fixed version digit shows through.
        for place in 0..32 {
            let digits: BTreeSet<u8> = tokens.iter().map(|token| token.as_bytes()[place]).collect();
            assert_eq!(digits.len(), 16, "digit {place}");
        }
    }

    #[test]
    fn later_ids_sort_after_earlier_ones() {
        let ids: Vec<Uuid> = (0..1000).map(|_| SystemIds.uuid()).collect();
        assert!(ids.is_sorted());
    }
}
