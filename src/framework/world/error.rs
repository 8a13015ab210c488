//! Why a description is not a world.

/// A world that cannot be built; each variant carries the value and what is allowed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum WorldError {
    /// An unknown unit.
    #[error("unit of a tool position is {found:?}: use \"m\" or \"mm\"")]
    Unit {
        /// The unit given.
        found: String,
    },
    /// A grid without cells or with too many.
    #[error("a surface of {columns} columns and {rows} rows has {cells} cells: 1 to {limit} are allowed")]
    Cells {
        /// Columns given.
        columns: u32,
        /// Rows given.
        rows: u32,
        /// Their product.
        cells: u64,
        /// Most cells allowed.
        limit: u64,
    },
    /// A tool without reach.
    #[error("radius_m is {found:?}: give a reach above 0 m and of at most {limit} m")]
    Radius {
        /// The radius given.
        found: f64,
        /// Largest reach.
        limit: f64,
    },
    /// A coordinate that is no number or beyond any robot.
    #[error("{field} holds {value:?}: give metres, at most {limit} either way")]
    Length {
        /// The field.
        field: &'static str,
        /// The value.
        value: f64,
        /// Largest magnitude.
        limit: f64,
    },
    /// All cells of a row or column at one place.
    #[error("{field} is zero for {count} cells: they would lie on one another")]
    ZeroStep {
        /// `column_step_m` or `row_step_m`.
        field: &'static str,
        /// Number of cells along it.
        count: u32,
    },
    /// A number of the simulated reality out of its range.
    #[error("reality.{field} is {value:?}: give {expected}")]
    Reality {
        /// The field.
        field: &'static str,
        /// The value given.
        value: f64,
        /// The range.
        expected: &'static str,
    },
}
