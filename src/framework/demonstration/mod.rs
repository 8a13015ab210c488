//! Demonstrations: time series of features, read from bytes, with findings about their quality.
//!
//! [`read`] takes one file, [`read_files`] the files of a bundle (one stream each). Both return either a
//! [`Demonstration`], valid by construction, with warnings, or findings with at least one error.
//!
//! Invariants: no input causes a panic; nothing is clamped, guessed or filled in silently; one bad row rejects the
//! whole file; every finding names its place and a remedy.

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
