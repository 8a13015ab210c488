//! Recognition: the discrepancy between an observed trajectory and an action's goals by dynamic time warping.

pub mod dtw;
mod metric;

pub use metric::Metric;
