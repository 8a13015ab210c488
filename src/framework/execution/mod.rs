//! IET, Incrementally Evolved Trajectories, as a state machine without I/O.

mod spec;

pub use spec::{ExecutionSpec, Problem};
