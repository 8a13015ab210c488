//! The queue runner: workers claim jobs, hold them by a lease, and write under their claim's token.
//!
//! One file or folder per job kind. Each has a function `run` that completes the job or returns the reason why it
//! stopped, a `lease::Stop`. A new kind is a file here and an arm in `run_kind`.
//!
//! # Architecture Invariants
//! - Execution is at least once, completion exactly once: a worker's writes name its claim, and a claim that no longer
//!   holds stops its worker.
//! - No work happens inside a claiming transaction; the attempt is durable before the work begins.
//! - Heartbeats run on their own task: work that blocks cannot make a living worker look dead.
//! - A job that loses its worker several times in a row *without a checkpoint in between* is quarantined: we assume the
//!   job crashes the worker. Checkpoints reset the count, so a healthy job survives any number of crashes of the
//!   server; the first checkpoint of an attempt comes after its first short slice.

mod execution;
mod experiment;
mod generalization;
mod lease;
mod runner;
#[cfg(test)]
mod tests;

pub use runner::{Runner, Settings};

use crate::app::model::{JobView, Work};
use crate::app::ports::Evaluators;
use lease::{ClaimedJob, Stop};

/// Runs the work of a job to its end, or until it is asked to stop.
async fn run_kind(
    claimed: &ClaimedJob,
    evaluators: &dyn Evaluators,
    job: &JobView,
    work: Work,
    checkpoint: Option<Vec<u8>>,
) -> Result<(), Stop> {
    match work {
        Work::Generalization(request) => generalization::run(claimed, job, request).await,
        Work::Execution(work) => execution::run(claimed, evaluators, job, *work, checkpoint).await,
        Work::Experiment { experiment } => experiment::run(claimed, job, experiment).await,
    }
}
