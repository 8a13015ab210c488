//! Methods: how the joints for each goal are found.
//!
//! # Architecture Invariants
//! - A method owns no world: it names candidates and is told what became of them.
//! - The seed is mandatory; what a method saves holds its random stream, so that it resumes with the same bits.

pub mod per_goal;
pub mod whole_run;
