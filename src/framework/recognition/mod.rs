//! Recognition: the discrepancy between an observed trajectory and an action's goals by dynamic time warping.

mod metric;

pub use metric::Metric;
