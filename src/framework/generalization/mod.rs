//! Generalization: from demonstrations to intermediate goals (paper eq. 1-3).
//!
//! [`generalize`] rescales the time of each demonstration to [0, 1], divides it into n equal bins and averages each;
//! [`interpolate`] draws a curve through the goals with radial basis functions. Both are pure functions of their
//! arguments. Sums run in the order of demonstrations and samples, so the same input gives the same bits.

mod binning;
mod goals;
mod rbf;
mod spec;
mod tables;

pub use binning::generalize;
pub use goals::{Goals, GoalsError};
pub use rbf::{RbfError, RbfKernel, RbfSpec, interpolate};
pub use spec::{GeneralizeError, GeneralizeSpec, Generalized, Weighting};
pub use tables::{GoalsFileError, goals_from_csv, goals_to_csv};
