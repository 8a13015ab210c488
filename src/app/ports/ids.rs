//! Ids, seeds and secrets: the only place where the service draws at random.

use uuid::Uuid;

/// Seeds are below this bound, so that every JSON reader keeps them exactly.
pub const SEED_BOUND: u64 = 1 << 53;

/// Source of ids, seeds and secrets.
pub trait Ids: Send + Sync {
    /// A new id; later ones sort after earlier ones.
    fn uuid(&self) -> Uuid;

    /// A seed for a job that names none, below 2^53.
    fn seed(&self) -> u64;

    /// 128 random bits, hexadecimal.
    fn token(&self) -> String;
}
