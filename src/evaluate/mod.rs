//! Evaluators, which carry out the trials of an execution, and decorators around them.
//!
//! # Architecture Invariants
//! - Each one implements the port [`crate::app::ports::Evaluator`] and keeps its invariants; the wiring chooses one and
//!   its decorators.

mod paced;
mod simulation;

pub use paced::{Paced, PacedEvaluators};
pub use simulation::{Simulation, Simulations};
