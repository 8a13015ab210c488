//! Optimisers behind one ask/tell interface, one algorithm a file.

mod spec;

pub use spec::{MethodSpec, SstSpec};
