//! The Store port: whole transactions of use-cases, in words every engine can keep.
//!
//! # Invariants of every engine
//! - An answer `Ok` to a write means durable.
//! - A write is done whole or not at all, even if the caller goes away before the answer.
//! - Every write of a worker carries its claim; if the claim no longer holds the job, the answer is
//!   [`StoreError::LeaseLost`] and nothing is written.
//! - Events of a job are numbered from 1 without gaps; each is written together with the change it reports.

mod actions;
mod demonstrations;
mod error;
mod experiments;
mod jobs;
#[cfg(test)]
mod memory;
mod queue;
mod robots;
mod runs;
mod worlds;

pub use actions::Actions;
pub use demonstrations::{Demonstrations, NewDemonstration};
pub use error::StoreError;
pub use experiments::{Experiments, NewExperiment};
pub use jobs::{IdempotencyKey, Jobs, NewJob, Submitted, Usage};
#[cfg(test)]
pub use memory::{Connection, MemoryStore};
pub use queue::{Advance, Claim, Claimed, Product, Queue, Transition};
pub use robots::{NewRobot, Robots};
pub use runs::{KeptTrials, NewRun, Runs};
pub use worlds::Worlds;

use async_trait::async_trait;

/// Durable storage: every resource, each by its own trait.
#[async_trait]
pub trait Store: Demonstrations + Actions + Robots + Worlds + Jobs + Queue + Runs + Experiments {
    /// Whether the store answers.
    async fn ping(&self) -> Result<(), StoreError>;
}
