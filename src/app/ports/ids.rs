//! Ids, seeds and secrets: the service's only source of randomness.

use uuid::Uuid;

/// Source of ids, seeds and secrets.
pub trait Ids: Send + Sync {
    /// A new id; later ones sort after earlier ones.
    fn uuid(&self) -> Uuid;

    /// A seed below [`SEED_BOUND`](crate::app::model::limits::SEED_BOUND) for a job that does not specify one.
    fn seed(&self) -> u64;

    /// A secret of 128 random bits, hexadecimal.
    fn token(&self) -> String;
}

#[cfg(test)]
pub use double::TestIds;

#[cfg(test)]
mod double {
    use super::Ids;
    use std::sync::atomic::{AtomicU64, Ordering};
    use uuid::Uuid;

    /// Ids, seeds and tokens in the order 1, 2, 3, ...
    #[derive(Debug, Default)]
    pub struct TestIds {
        last: AtomicU64,
    }

    impl TestIds {
        fn next(&self) -> u64 {
            self.last.fetch_add(1, Ordering::Relaxed) + 1
        }
    }

    impl Ids for TestIds {
        fn uuid(&self) -> Uuid {
            Uuid::from_u128(u128::from(self.next()))
        }

        fn seed(&self) -> u64 {
            self.next()
        }

        fn token(&self) -> String {
            format!("{:032x}", self.next())
        }
    }
}
