//! The queue runner: workers claim jobs, hold them by a lease, and write under their claim's token.
//!
//! # Architecture Invariants
//! - Execution is at least once, completion exactly once: a worker's writes name its claim, and a claim that does not
//!   hold any more stops its worker.
//! - No work happens inside a claiming transaction; the attempt is durable before the work begins.
//! - Heartbeats run on their own task: work that blocks cannot make a living worker look dead.
//! - A job whose worker is lost several times in a row *without a checkpoint in between* fails: it is taken to be what
//!   kills the worker. Checkpoints set the count back, so that a healthy job survives any number of crashes of the
//!   server; the first checkpoint of an attempt comes after its first short slice.

mod checkpoint;
mod execution;
mod experiment;
mod generalization;
mod held;
mod outcome;
mod runner;

pub use runner::{Runner, Settings};
