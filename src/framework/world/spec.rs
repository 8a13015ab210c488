//! World descriptions as written by users (TOML presets, REST); `kind` selects the variant.

use crate::tagged;
use serde::{Deserialize, Serialize};

tagged! {
    /// Description of a simulated world.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    #[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
    #[serde(tag = "kind", rename_all = "snake_case")]
    pub enum WorldSpec {
        /// The observation is the tool's position (the paper's wax).
        ToolPosition(ToolPositionSpec),
        /// The observation is the tool's distance from a point.
        ToolDistance(ToolDistanceSpec),
        /// The observation is the share of a surface's cells that the tool has come close to (the paper's paint).
        Coverage(CoverageSpec),
    }
}

/// Features x, y, z: position of the tool centre point in the chain's base frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct ToolPositionSpec {
    /// Unit of the features: `m` or `mm`.
    pub unit: String,
}

/// Feature `distance`: distance of the tool centre point from `point_m`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct ToolDistanceSpec {
    /// The point; chain's base frame, metres.
    pub point_m: [f64; 3],
    /// Unit of the feature: `m` or `mm`.
    pub unit: String,
}

/// Content of an observation of a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum SurfaceView {
    /// The painted percentage.
    #[default]
    Percent,
    /// The painted percentage, followed by a feature `cell_ROW_COLUMN` per cell, row by row: 1 if painted, 0 if not.
    Cells,
}

/// Feature `painted`, %: 100 x painted cells / cells. A cell becomes painted when the tool centre point, at a visited
/// static pose, is strictly closer than `radius_m` to its centre, and stays painted until the world is reset.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct CoverageSpec {
    /// Centre of the cell in row 0, column 0; base frame, metres.
    pub origin_m: [f64; 3],
    /// Vector from one column to the next, metres.
    pub column_step_m: [f64; 3],
    /// Vector from one row to the next, metres.
    pub row_step_m: [f64; 3],
    /// Number of columns (at least 1).
    pub columns: u32,
    /// Number of rows (at least 1).
    pub rows: u32,
    /// Radius of the tool's effect, metres (> 0).
    pub radius_m: f64,
    /// Whether the surface can be restored between trials.
    #[serde(default = "resets_by_default")]
    pub resets: bool,
    /// Whether the painted cells are observed, or only their percentage.
    #[serde(default, skip_serializing_if = "is_percent")]
    pub observes: SurfaceView,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes what it may skip by reference")]
fn is_percent(view: &SurfaceView) -> bool {
    *view == SurfaceView::Percent
}

fn resets_by_default() -> bool {
    true
}
