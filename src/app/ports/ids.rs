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

/// The operating system's random source.
#[derive(Debug, Clone, Copy, Default)]
pub struct SystemIds;

impl Ids for SystemIds {
    fn uuid(&self) -> Uuid {
        Uuid::now_v7()
    }

    fn seed(&self) -> u64 {
        // The low half of a version 4 UUID has 62 random bits; its two highest are fixed.
        Uuid::new_v4().as_u64_pair().1 % SEED_BOUND
    }

    fn token(&self) -> String {
        // 122 random bits each: the two together lose nothing of 128.
        let (a, b) = (Uuid::new_v4().as_u128(), Uuid::new_v4().as_u128());
        format!("{:032x}", a ^ b.rotate_left(64))
    }
}
