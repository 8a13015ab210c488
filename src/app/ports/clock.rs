//! The Clock port.

use crate::app::model::Timestamp;
use std::time::Duration;

/// Wall-clock time for display and monotonic time for measuring; no lease or deadline depends on the wall clock.
pub trait Clock: Send + Sync {
    /// Wall-clock time.
    fn now(&self) -> Timestamp;

    /// Time since a fixed moment; monotonic.
    fn elapsed(&self) -> Duration;
}

#[cfg(test)]
pub use double::TestClock;

#[cfg(test)]
mod double {
    use super::Clock;
    use crate::app::model::Timestamp;
    use std::sync::{Mutex, PoisonError};
    use std::time::{Duration, Instant};

    /// A clock that a test moves; the time that passes while the test runs is measured on top.
    #[derive(Debug)]
    pub struct TestClock {
        started: Instant,
        moved: Mutex<Duration>,
    }

    impl TestClock {
        /// 2023-11-14T22:13:20Z.
        pub const START: Timestamp = Timestamp(1_700_000_000_000);

        /// A clock at [`TestClock::START`].
        #[must_use]
        pub fn new() -> Self {
            Self { started: Instant::now(), moved: Mutex::default() }
        }

        /// Lets time pass.
        pub fn advance(&self, by: Duration) {
            *self.moved.lock().unwrap_or_else(PoisonError::into_inner) += by;
        }

        fn moved(&self) -> Duration {
            *self.moved.lock().unwrap_or_else(PoisonError::into_inner)
        }
    }

    impl Default for TestClock {
        fn default() -> Self {
            Self::new()
        }
    }

    impl Clock for TestClock {
        fn now(&self) -> Timestamp {
            Timestamp(Self::START.0 + i64::try_from(self.moved().as_millis()).unwrap_or(i64::MAX - Self::START.0))
        }

        fn elapsed(&self) -> Duration {
            self.started.elapsed() + self.moved()
        }
    }
}
