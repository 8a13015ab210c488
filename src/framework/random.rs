//! The one source of random numbers: seeded, serialisable, the same values on every machine and in every version.
//!
//! # Architecture Invariants
//! - Nothing else in this crate draws: optimisers, whole-run methods and disturbed worlds all hold a [`RandomStream`].
//! - ChaCha8 (D. J. Bernstein, 2008). The conversions to floats and integers are written here rather than taken from
//!   `rand`, whose distributions may change their values between releases.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use serde::{Deserialize, Serialize};

/// A seeded stream of random numbers.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(into = "RawStream", from = "RawStream")]
pub struct RandomStream {
    rng: ChaCha8Rng,
    seed: u64,
    family: Family,
}

/// How a seed becomes the key of the cipher. Streams of different families share no number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Family {
    /// The seed's bytes and a fixed text: one stream per goal.
    #[default]
    Goal,
    /// The seed spread over the key by PCG32: whole-run methods and disturbed worlds.
    Run,
}

/// The position of a stream: seed, stream number and words drawn (32 bits each).
#[derive(Serialize, Deserialize)]
struct RawStream {
    seed: u64,
    stream: u64,
    words: u64,
    #[serde(default, skip_serializing_if = "Family::is_goal")]
    family: Family,
}

impl Family {
    #[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes what it may skip by reference")]
    fn is_goal(&self) -> bool {
        *self == Self::Goal
    }

    fn cipher(self, seed: u64) -> ChaCha8Rng {
        match self {
            Self::Goal => {
                let mut key = *b"________cgda optimizer stream 01";
                key[..8].copy_from_slice(&seed.to_le_bytes());
                ChaCha8Rng::from_seed(key)
            }
            Self::Run => ChaCha8Rng::seed_from_u64(seed),
        }
    }
}

impl RandomStream {
    /// Stream `stream` of `seed` for an optimiser that looks for one goal.
    #[must_use]
    pub fn new(seed: u64, stream: u64) -> Self {
        Self::at(seed, stream, Family::Goal)
    }

    /// Stream `stream` of `seed` for a whole run: a method that plans all goals at once, or a disturbed world.
    #[must_use]
    pub fn of_run(seed: u64, stream: u64) -> Self {
        Self::at(seed, stream, Family::Run)
    }

    fn at(seed: u64, stream: u64, family: Family) -> Self {
        let mut rng = family.cipher(seed);
        rng.set_stream(stream);
        Self { rng, seed, family }
    }

    /// U(0, 1) from 53 random bits; includes 0, excludes 1.
    #[inline]
    pub fn unit(&mut self) -> f64 {
        (self.rng.next_u64() >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
    }

    /// Uniform in `[low, high)`; `low` if both are equal.
    #[inline]
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Standard normal, by the Box-Muller transform.
    #[inline]
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.unit()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.unit()).cos()
    }

    /// Uniform in `0..count` (bias below 2^-32).
    #[inline]
    pub fn below(&mut self, count: usize) -> usize {
        let wide = u128::from(self.rng.next_u64()) * count as u128;
        usize::try_from(wide >> 64).unwrap_or(0)
    }

    /// One of `items`, uniformly; `None` if there are none.
    pub fn pick<'a, T>(&mut self, items: &'a [T]) -> Option<&'a T> {
        let count = u32::try_from(items.len()).unwrap_or(u32::MAX);
        items.get(self.index(count) as usize)
    }

    /// Uniform in `0..count`, from one word of 32 bits and a second one only where the first is biased (Canon's
    /// method, bias below 2^-48); 0 if `count` is 0. Draws what `rand` 0.10 draws for `random_range(0..count)`.
    fn index(&mut self, count: u32) -> u32 {
        let (index, rest) = halves(u64::from(self.rng.next_u32()) * u64::from(count));
        if rest <= count.wrapping_neg() {
            return index;
        }
        let (more, _) = halves(u64::from(self.rng.next_u32()) * u64::from(count));
        index + u32::from(rest.checked_add(more).is_none())
    }

    /// True with probability 1/2.
    #[inline]
    pub fn coin(&mut self) -> bool {
        self.rng.next_u32() >> 31 == 1
    }
}

/// The upper and the lower 32 bits.
fn halves(word: u64) -> (u32, u32) {
    let [a, b, c, d, e, f, g, h] = word.to_be_bytes();
    (u32::from_be_bytes([a, b, c, d]), u32::from_be_bytes([e, f, g, h]))
}

impl From<RandomStream> for RawStream {
    fn from(stream: RandomStream) -> Self {
        let words = u64::try_from(stream.rng.get_word_pos()).unwrap_or(u64::MAX);
        Self { seed: stream.seed, stream: stream.rng.get_stream(), words, family: stream.family }
    }
}

impl From<RawStream> for RandomStream {
    fn from(raw: RawStream) -> Self {
        let mut stream = Self::at(raw.seed, raw.stream, raw.family);
        stream.rng.set_word_pos(u128::from(raw.words));
        stream
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_saved_stream_goes_on_with_the_same_bits(
            seed: u64, number in 0_u64..9, coins in 0_usize..50, of_run: bool,
        ) {
            let start = if of_run { RandomStream::of_run } else { RandomStream::new };
            let mut stream = start(seed, number);
            for _ in 0..coins {
                stream.coin();
            }
            let mut resumed: RandomStream = serde_json::from_str(&serde_json::to_string(&stream).unwrap()).unwrap();
            for _ in 0..40 {
                prop_assert_eq!(stream.unit().to_bits(), resumed.unit().to_bits());
                prop_assert_eq!(stream.coin(), resumed.coin());
            }
        }

        #[test]
        fn numbers_stay_in_their_ranges(seed: u64, count in 1_usize..100) {
            let mut stream = RandomStream::new(seed, 0);
            for _ in 0..100 {
                prop_assert!((0.0..1.0).contains(&stream.unit()));
                prop_assert!(stream.below(count) < count);
                prop_assert!(stream.pick(&[1, 2, 3][..count.min(3)]).is_some());
            }
        }
    }

    #[test]
    fn values_are_pinned() {
        let mut stream = RandomStream::new(1, 2);
        let drawn: Vec<usize> = (0..12).map(|_| stream.below(10)).collect();
        assert_eq!(drawn, PINNED);
    }

    const PINNED: [usize; 12] = [2, 3, 5, 1, 7, 7, 6, 5, 3, 0, 6, 1];

    #[test]
    fn values_of_runs_are_pinned() {
        let mut stream = RandomStream::of_run(7, 3);
        let items: Vec<u32> = (0..1000).collect();
        let drawn: Vec<u32> = (0..6).filter_map(|_| stream.pick(&items).copied()).collect();
        assert_eq!(
            (drawn.as_slice(), stream.unit(), stream.normal()),
            (&PICKED[..], 0.334_218_344_217_516_06, -0.695_835_336_205_335_4)
        );
    }

    const PICKED: [u32; 6] = [525, 181, 522, 92, 719, 979];

    /// Of 3 * 2^30 numbers every third first word is biased, so that second words are drawn.
    #[test]
    fn biased_words_are_mended_as_rand_does() {
        let mut stream = RandomStream::of_run(1, 0);
        let drawn: Vec<u32> = (0..6).map(|_| stream.index(3 << 30)).collect();
        assert_eq!(drawn, [1_769_671_237, 3_171_609_296, 258_934_050, 679_822_540, 1_246_104_049, 2_681_526_507]);
    }

    #[test]
    fn normal_numbers_have_mean_0_and_variance_1() {
        let mut stream = RandomStream::new(3, 0);
        let drawn: Vec<f64> = (0..20_000).map(|_| stream.normal()).collect();
        let mean = drawn.iter().sum::<f64>() / 20_000.0;
        let variance = drawn.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / 20_000.0;
        assert!(mean.abs() < 0.03 && (variance - 1.0).abs() < 0.04, "{mean} {variance}");
    }

    #[test]
    fn seeds_and_streams_differ() {
        let first = |seed, stream| RandomStream::new(seed, stream).unit().to_bits();
        assert_ne!(first(1, 0), first(2, 0));
        assert_ne!(first(1, 0), first(1, 1));
    }
}
