//! Demonstrations: time series of features, read from bytes, with findings about their quality.

mod model;

pub use model::{Demonstration, Stream, StreamError};
