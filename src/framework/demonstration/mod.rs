//! Demonstrations: time series of features, read from bytes, with findings about their quality.
//!
//! [`read`] takes one file, [`read_files`] the files of a bundle (each one stream). Both either give a
//! [`Demonstration`] that is valid by construction together with warnings, or refuse with at least one error.
//!
//! Invariants: no input makes them panic; nothing is clamped, guessed or filled in silently; a file is refused when
//! one row of it is wrong, and every finding says where and what to do.

mod compare;
mod csv;
mod finding;
mod json;
mod model;
mod options;
mod source;
mod table;
mod text;
mod timing;
mod yarp;

pub use compare::{content_hash, duplicate_content};
pub use finding::{Finding, FindingCode, Severity};
pub use model::{Demonstration, Stream, StreamError};
pub use options::{ClockPolicy, Format, Limits, ReadOptions, known_features};
pub use source::{ReadResult, SourceFile, read, read_files};
