//! CGDA itself: demonstrations in, goals, recognition, joint trajectories out.
//!
//! # Architecture Invariants
//! - Pure: no async, no I/O, no clock, no environment, no global random source, no logging.
//! - SI units and radians inside; *features* keep the unit their demonstration declares.
//! - A package of its own, `cgda-core`, that knows no service, no command line and no paper; the service re-exports it as
//!   `cgda::framework`.
#![doc = ""]
#![doc = include_str!("README.md")]
#![warn(missing_docs)]

pub mod cells;
pub mod collision;
pub mod constraint;
pub mod demonstration;
pub mod distance;
pub mod execution;
pub mod experiment;
pub mod feature;
pub mod generalization;
pub mod infinite_as_null;
pub mod job;
pub mod method;
pub mod motion;
pub mod preset;
pub mod random;
pub mod range;
pub mod recognition;
pub mod robot;
pub mod tagged;
mod text;
pub mod trajectory;
pub mod world;

pub use cells::CellSet;
pub use feature::Feature;
pub use text::{MAX_DISPLAY_NAME_CHARS, is_display_name, is_hidden};
