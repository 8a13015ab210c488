//! Common parts of the methods for accumulating effects (a share of a surface).

pub(super) mod cell_predictor;
pub(super) mod cover;
pub(super) mod covering;
pub(super) mod sobol;
#[cfg(test)]
mod tests;

pub use cover::CoverSpec;
