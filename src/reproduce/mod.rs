//! The paper, reproduced: shipped presets, its tables and its figures, drawn from reruns.
//!
//! # Architecture Invariants
//! - Pure, as the core is: the shipped files are part of the program, so that they work wherever it is installed.
//! - Imports the core only. The core knows no paper: everything here could be written by a user of `cgda-core`.

mod agreement;
pub mod figure;
pub mod figures;
mod markdown;
pub mod paper;
pub mod shipped;

pub use agreement::{Agreement, Disagreement, agreement};
pub use markdown::paper_markdown;
