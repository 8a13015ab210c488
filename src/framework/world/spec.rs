//! World descriptions as users write them (TOML presets, REST); `kind` picks one.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// One of the simulated worlds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum WorldSpec {
    /// The tool's position is the observation (the paper's wax).
    ToolPosition(ToolPositionSpec),
    /// The share of a surface's cells the tool has come near (the paper's paint).
    Coverage(CoverageSpec),
}

/// Features x, y, z: the tool centre point in the chain's base frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct ToolPositionSpec {
    /// Unit of the features: `m` or `mm`.
    pub unit: String,
}

/// What an observation of a surface holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum SurfaceView {
    /// The share painted.
    #[default]
    Percent,
    /// The share painted, then for each cell, row by row, feature `cell_ROW_COLUMN`: 1 painted, 0 not.
    Cells,
}

/// Feature `painted`, %: 100 x cells painted / cells. A cell becomes painted when the tool centre point is strictly
/// nearer than `radius_m` to its centre at a visited static pose, and stays painted until the world is reset.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct CoverageSpec {
    /// Centre of the cell in row 0, column 0; base frame, metres.
    pub origin_m: [f64; 3],
    /// From one column to the next, metres.
    pub column_step_m: [f64; 3],
    /// From one row to the next, metres.
    pub row_step_m: [f64; 3],
    /// Number of columns (at least 1).
    pub columns: u32,
    /// Number of rows (at least 1).
    pub rows: u32,
    /// Reach of the tool, metres (> 0).
    pub radius_m: f64,
    /// Whether the surface can be put back as it was between trials.
    #[serde(default = "resets_by_default")]
    pub resets: bool,
    /// Whether the painted cells are seen, or the share alone.
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
