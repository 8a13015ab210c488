//! The paper's figures as SVG text.
//!
//! # Architecture Invariants
//! - Pure: data in, a string out; the same data give the same bytes.
//! - Axes name their quantity and unit; series differ by marker as well as by colour.

mod accumulation;
mod canvas;
mod coverage;
mod demonstrations;
mod style;
#[cfg(test)]
mod tests;
mod trade_off;
mod trail;

pub use accumulation::{Accumulation, AccumulationPanel, accumulation};
pub use coverage::{Coverage, coverage};
pub use demonstrations::{Generalization, demonstrations};
pub use trade_off::{Method, trade_off};
pub use trail::{Trail, trails};

/// Reason why a figure could not be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FigureError {
    /// The drawing library failed.
    #[error("figure {title:?} could not be drawn: {message}")]
    Drawing {
        /// Title of the figure.
        title: String,
        /// Message of the library.
        message: String,
    },
}
