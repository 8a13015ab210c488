//! Reasons why a description is not a valid world.

use crate::range::OutOfRange;

/// A world cannot be built; each variant carries the value and what is allowed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum WorldError {
    /// The unit is unknown.
    #[error("unit is {found:?}: use \"m\" or \"mm\"")]
    Unit {
        /// Unit given.
        found: String,
    },
    /// A grid has no cells, or too many.
    #[error("a surface of {columns} columns and {rows} rows has {cells} cells: give 1 to {limit}")]
    Cells {
        /// Number of columns.
        columns: u32,
        /// Number of rows.
        rows: u32,
        /// Number of cells.
        cells: u64,
        /// Maximum number of cells.
        limit: u64,
    },
    /// A length, a share or a duration is out of range; those of a [`DisturbanceSpec`](super::DisturbanceSpec) carry
    /// the name `reality` that they have in a problem.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// The world has no surface, which a method needs.
    #[error("the world has no surface: give one of kind \"coverage\"")]
    NoSurface,
    /// All cells of a row or column are at the same place.
    #[error("{field} is zero for {count} cells: they would coincide")]
    ZeroStep {
        /// `column_step_m` or `row_step_m`.
        field: &'static str,
        /// Number of cells along it.
        count: u32,
    },
}
