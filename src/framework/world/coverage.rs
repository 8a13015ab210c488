//! The coverage world (the paper's paint): a grid whose cells are painted when the tool comes close to them.

use super::cell_grid::CellGrid;
use super::{CoverageSpec, Surface, SurfaceView, World, WorldError};
use crate::range::{Range, above};
use crate::robot::{Chain, tool_position};
use crate::{CellSet, Feature};

/// Maximum number of cells of a surface.
const MAX_CELLS: u64 = 1 << 20;
/// Maximum number of cells if each is observed as a feature.
const MAX_SEEN_CELLS: u64 = 1 << 12;
/// Largest coordinate, step and radius, metres.
const MAX_LENGTH_M: f64 = 1e4;

/// Feature `painted`, %, followed by the cells if they are observed.
#[derive(Debug, Clone)]
pub(super) struct Coverage {
    chain: Chain,
    features: Vec<Feature>,
    grid: CellGrid,
    painted: CellSet,
    /// Number of painted cells.
    count: usize,
}

/// Properties of the surface of a coverage world.
pub(super) fn surface(spec: &CoverageSpec) -> Surface {
    Surface {
        columns: spec.columns as usize,
        rows: spec.rows as usize,
        resets: spec.resets,
        cells_seen: spec.observes == SurfaceView::Cells,
    }
}

/// Features of a coverage world: the percentage, followed by the cells if they are observed.
pub(super) fn features(spec: &CoverageSpec) -> Vec<Feature> {
    let cell = |row, column| Feature::new(format!("cell_{row}_{column}"), "");
    let cells = |row| (1..=spec.columns).map(move |column| cell(row, column));
    let share = std::iter::once(Feature::new("painted", "%"));
    match spec.observes {
        SurfaceView::Percent => share.collect(),
        SurfaceView::Cells => share.chain((1..=spec.rows).flat_map(cells)).collect(),
    }
}

/// Checks whether a surface can be built, without building it.
///
/// # Errors
/// [`WorldError`] for a grid that is empty, too large, degenerate or implausible, and for a tool without a radius.
pub(super) fn check(spec: &CoverageSpec) -> Result<(), WorldError> {
    above(0.0).up_to(MAX_LENGTH_M).check("radius_m", Some("m"), spec.radius_m)?;
    let cells = u64::from(spec.columns) * u64::from(spec.rows);
    let limit = match spec.observes {
        SurfaceView::Percent => MAX_CELLS,
        SurfaceView::Cells => MAX_SEEN_CELLS,
    };
    if cells == 0 || cells > limit {
        return Err(WorldError::Cells { columns: spec.columns, rows: spec.rows, cells, limit });
    }
    for (field, vector) in
        [("origin_m", spec.origin_m), ("column_step_m", spec.column_step_m), ("row_step_m", spec.row_step_m)]
    {
        Range::from(-MAX_LENGTH_M..=MAX_LENGTH_M).check_each(field, Some("m"), &vector)?;
    }
    for (field, step, count) in
        [("column_step_m", spec.column_step_m, spec.columns), ("row_step_m", spec.row_step_m, spec.rows)]
    {
        if count > 1 && step.iter().all(|metres| *metres == 0.0) {
            return Err(WorldError::ZeroStep { field, count });
        }
    }
    Ok(())
}

impl Coverage {
    pub(super) fn new(spec: &CoverageSpec, chain: &Chain) -> Result<Self, WorldError> {
        check(spec)?;
        let grid = CellGrid::new(spec);
        Ok(Self {
            chain: chain.clone(),
            features: features(spec),
            painted: CellSet::empty(grid.cells()),
            grid,
            count: 0,
        })
    }

    fn percent(&self, count: usize) -> f64 {
        100.0 * count as f64 / self.grid.cells() as f64
    }
}

impl World for Coverage {
    fn features(&self) -> &[Feature] {
        &self.features
    }

    fn reset(&mut self) {
        self.painted.clear();
        self.count = 0;
    }

    fn observe(&mut self, joints: &[f64], observation: &mut [f64]) {
        let tool = tool_position(&self.chain, joints);
        let (share, seen) = observation.split_at_mut(1);
        for (cell, value) in seen.iter_mut().enumerate() {
            *value = f64::from(u8::from(self.painted.contains(cell)));
        }
        let mut count = self.count;
        self.grid.near(&tool, |cell| {
            count += usize::from(!self.painted.contains(cell));
            if let Some(value) = seen.get_mut(cell) {
                *value = 1.0;
            }
        });
        share[0] = self.percent(count);
    }

    fn commit(&mut self, joints: &[f64], observation: &mut [f64]) {
        let tool = tool_position(&self.chain, joints);
        let (painted, count) = (&mut self.painted, &mut self.count);
        self.grid.near(&tool, |cell| *count += usize::from(painted.insert(cell)));
        observation[0] = self.percent(self.count);
        for (cell, value) in observation[1..].iter_mut().enumerate() {
            *value = f64::from(u8::from(self.painted.contains(cell)));
        }
    }

    fn cells(&self) -> Option<&CellSet> {
        Some(&self.painted)
    }
}
