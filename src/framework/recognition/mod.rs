//! Recognition: the discrepancy between an observed trajectory and an action's goals by dynamic time warping.
//!
//! [`discrepancy()`] is the one number execution searches with; [`recognize`] ranks candidate actions, splits each
//! discrepancy by feature, gives the warping path, and says *unknown* when even the best is too far (open set).
//!
//! Invariants: features are matched by name and unit, never by position; a value never goes without its metric.

mod discrepancy;
pub mod dtw;
mod metric;
mod observed;
mod ranking;

pub use discrepancy::{FeatureDiscrepancy, discrepancy};
pub use metric::Metric;
pub use observed::{ObservedError, observed_rows};
pub use ranking::{DEFAULT_THRESHOLD, Incomparable, Match, Recognition, RecognizeError, RecognizeSpec, recognize};
