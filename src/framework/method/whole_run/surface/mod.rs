//! What the methods for an accumulating effect (a share of a surface) have in common.

pub(super) mod cell_predictor;
pub(super) mod cover;
pub(super) mod sobol;
#[cfg(test)]
mod tests;

pub use cell_predictor::Grid;
pub use cover::CoverSpec;
