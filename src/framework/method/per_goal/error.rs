//! Reasons why a search cannot start or resume.

use crate::method::parameters::Parameters;
use crate::range::OutOfRange;

/// Reasons why a method cannot be run.
#[derive(Debug, thiserror::Error)]
pub enum OptimizerError {
    /// A parameter out of its range.
    #[error("{method}: {number}")]
    Parameter {
        /// Method name.
        method: &'static str,
        /// The parameter, its value and its range.
        number: OutOfRange,
    },
    /// A method that does not search goal by goal.
    #[error("{method} does not search goal after goal: give a method that does, for example sst")]
    NotPerGoal {
        /// Method name.
        method: &'static str,
    },
    /// A saved memory that its method cannot read.
    #[error("the saved {method} state cannot be read: {source}; run the job again")]
    Memory {
        /// Method name.
        method: &'static str,
        /// The reason.
        source: serde_json::Error,
    },
    /// A state saved by another version.
    #[error("the saved {method} state has version {found}, this program reads {expected}: run the job again")]
    Version {
        /// Method name.
        method: &'static str,
        /// Version of the state.
        found: u32,
        /// Version understood.
        expected: u32,
    },
    /// A state of another method.
    #[error("the saved state is one of {found}, the method is {expected}: it belongs to another job")]
    Method {
        /// Method of the state.
        found: String,
        /// Method of the problem.
        expected: &'static str,
    },
    /// A state of another problem.
    #[error("the saved {method} state holds {found} {what}, the problem needs {expected}: it belongs to another job")]
    Shape {
        /// Method name.
        method: &'static str,
        /// Part that does not fit.
        what: &'static str,
        /// Number found.
        found: usize,
        /// Number needed.
        expected: usize,
    },
}

impl OptimizerError {
    /// # Errors
    /// [`OptimizerError::Parameter`] for a parameter of `method` that is out of its range.
    pub(super) fn check(method: &'static str, parameters: &impl Parameters) -> Result<(), Self> {
        parameters.check_ranges().map_err(|number| Self::Parameter { method, number })
    }
}
