//! Ids, seeds and secrets: the service's only source of randomness.

use uuid::Uuid;

/// Exclusive upper bound of seeds, so that every JSON reader represents them exactly.
pub const SEED_BOUND: u64 = 1 << 53;

/// Source of ids, seeds and secrets.
pub trait Ids: Send + Sync {
    /// A new id; later ones sort after earlier ones.
    fn uuid(&self) -> Uuid;

    /// A seed below 2^53 for a job that does not specify one.
    fn seed(&self) -> u64;

    /// A secret of 128 random bits, hexadecimal.
    fn token(&self) -> String;
}
