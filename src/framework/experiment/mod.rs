//! Experiments: many runs of many settings, and their statistics.
//!
//! # Architecture Invariants
//! - An experiment's state is its plan and the set of its finished runs, nothing else: whoever runs the pending ones, in
//!   whatever order and on however many threads, gets the same table to the last digit.
//! - Every cell runs the same seeds, so cells are compared pair by pair.

pub mod export;
mod paired;
mod patch;
mod result;
mod run;
mod spec;
mod state;
mod summary;
#[cfg(test)]
mod tests;

pub use paired::{PairedComparison, compare};
pub use patch::merge;
pub use result::{CellResult, Quantity};
pub use run::{RunError, result, run, run_while};
pub use spec::{Cell, CellSpec, ExperimentError, ExperimentSpec, InvalidRule, MAX_RUNS, MatrixSpec, Plan, Variant};
pub use state::{Experiment, RecordError, RunId, RunRow};
pub use summary::{Summary, mean, standard_deviation};
