//! Reasons why a description is not a valid world.

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
    /// The radius of the tool is not positive or too large.
    #[error("radius_m is {found:?}: give a radius above 0 and up to {limit} m")]
    Radius {
        /// Radius given, m.
        found: f64,
        /// Largest allowed radius, m.
        limit: f64,
    },
    /// A coordinate is not finite or implausibly large.
    #[error("{field} contains {value:?}: give metres within +/-{limit}")]
    Length {
        /// Name of the field.
        field: &'static str,
        /// Value of the objective.
        value: f64,
        /// Largest allowed magnitude, m.
        limit: f64,
    },
    /// All cells of a row or column are at the same place.
    #[error("{field} is zero for {count} cells: they would coincide")]
    ZeroStep {
        /// `column_step_m` or `row_step_m`.
        field: &'static str,
        /// Number of cells along it.
        count: u32,
    },
    /// A number of a [`DisturbanceSpec`](super::DisturbanceSpec) (`reality` in a problem) is out of range.
    #[error("reality.{field} is {value:?}: give {expected}")]
    Disturbance {
        /// Name of the field.
        field: &'static str,
        /// Value given.
        value: f64,
        /// Allowed range.
        expected: &'static str,
    },
}
