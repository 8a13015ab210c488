//! The numbers that bound a request, each in one place.
//!
//! Use-cases check against them, the OpenAPI document shows them (`http/openapi/bounds.rs`), the dashboard's form reads
//! them from there, and the comments of the `.proto` files are tested against them (`tests/it/parity/limits.rs`).

use crate::framework::MAX_DISPLAY_NAME_CHARS;
use std::fmt::Display;
use std::ops::RangeInclusive;

/// Characters of a display name; an uploaded file may carry one too.
pub const NAME_CHARS: RangeInclusive<u32> = 1..=MAX_DISPLAY_NAME_CHARS;
/// Characters of an idempotency key.
pub const IDEMPOTENCY_KEY_CHARS: RangeInclusive<u32> = 1..=128;

/// Items on a page.
pub const PAGE_SIZE: RangeInclusive<u32> = 1..=200;
/// Items on a page if the request does not say.
pub const DEFAULT_PAGE_SIZE: u32 = 50;

/// Exclusive upper bound of seeds, so that every JSON reader represents them exactly.
pub const SEED_BOUND: u64 = 1 << 53;
/// Runs of one execution.
pub const REPETITIONS: RangeInclusive<u32> = 1..=1000;
/// Seed of an execution's first run: the last run's seed stays below [`SEED_BOUND`].
pub const FIRST_SEED: RangeInclusive<u64> = 0..=SEED_BOUND - *REPETITIONS.end() as u64 - 1;
/// Slowest pace of an execution, evaluations per second.
pub const MIN_EVALUATIONS_PER_S: f64 = 0.1;
/// Longest trial on a robot, seconds: a day.
pub const MAX_TRIAL_S: f64 = 86_400.0;

/// Number of demonstrations of one action.
pub const DEMONSTRATIONS: RangeInclusive<u32> = 1..=1000;
/// Files of one upload.
pub const UPLOAD_FILES: RangeInclusive<u32> = 1..=64;
/// Bytes of one upload, unless configured otherwise.
pub const DEFAULT_UPLOAD_BYTES: usize = 256 << 20;
/// Bytes of any other body and of a gRPC message, unless configured otherwise.
pub const DEFAULT_BODY_BYTES: usize = 16 << 20;
/// Bytes of an upload's form field that is not a file.
pub const MAX_FIELD_BYTES: usize = 64 << 10;

/// Cells of an experiment.
pub const MAX_CELLS: u32 = 1000;
/// Runs of an experiment, all its cells together.
pub const MAX_EXPERIMENT_RUNS: u32 = 100_000;
/// Candidates of one recognition.
pub const MAX_CANDIDATES: u32 = 200;

/// Number of events of a job in one answer.
pub const EVENTS: RangeInclusive<u32> = 1..=1000;
/// Points per feature of a demonstration's samples.
pub const SAMPLE_POINTS: RangeInclusive<u32> = 4..=20_000;
/// Points of a convergence curve.
pub const CONVERGENCE_POINTS: RangeInclusive<u32> = 2..=10_000;
/// Points per feature, or of a curve, unless the request names a number.
pub const DEFAULT_POINTS: u32 = 1000;
/// Points of an interpolated action.
pub const INTERPOLATION_POINTS: RangeInclusive<u32> = 2..=10_000;

/// Points in one message of a streamed trajectory.
pub const TRAJECTORY_BATCH: RangeInclusive<u32> = 1..=4096;
/// Points in one message of a streamed trajectory, unless the request names a number.
pub const DEFAULT_TRAJECTORY_BATCH: u32 = 256;
/// Longest wait for a job's event, milliseconds.
pub const MAX_WAIT_MS: u32 = 60_000;
/// Wait for a job's event unless the request names a time, milliseconds.
pub const DEFAULT_WAIT_MS: u32 = 30_000;
/// Rows per stream of an online recognition.
pub const MAX_RECOGNITION_ROWS: usize = 100_000;

/// The bounds in words: `1 to 1000`.
pub fn in_words<T: Display>(bounds: &RangeInclusive<T>) -> String {
    format!("{} to {}", bounds.start(), bounds.end())
}

/// The number of items, characters or bytes, as far as it can be compared with a bound.
#[must_use]
pub fn count(items: usize) -> u32 {
    u32::try_from(items).unwrap_or(u32::MAX)
}
