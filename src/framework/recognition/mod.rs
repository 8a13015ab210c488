//! Recognition: the discrepancy between an observed trajectory and an action's goals by dynamic time warping.
//!
//! [`discrepancy()`] is the number that execution minimises. [`recognize`] ranks candidate actions, splits each
//! discrepancy by feature, returns the warping path, and answers *unknown* if even the best candidate is too far away
//! (open set).
//!
//! Invariants: features are matched by name and unit, never by position; a value is never stored without its metric.

mod discrepancy;
pub mod dtw;
mod metric;
mod observed;
mod ranking;

pub use discrepancy::{FeatureDiscrepancy, discrepancy};
pub use metric::Metric;
pub use observed::{ObservedError, observed_rows};
pub use ranking::{DEFAULT_THRESHOLD, Incomparable, Match, Recognition, RecognizeError, RecognizeSpec, recognize};
