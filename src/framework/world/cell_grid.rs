//! Geometry of a surface: a grid of cell centres, and the cells that a tool affects from where it is.

use super::CoverageSpec;
use nalgebra::Vector3;
use std::ops::Range;

/// Cells looked at beyond the exact window, so that rounding loses none.
const MARGIN: f64 = 1e-6;

/// Cell centres on a regular grid in the base frame; cells are numbered row by row.
#[derive(Debug, Clone)]
pub(crate) struct CellGrid {
    origin: Vector3<f64>,
    column: Vector3<f64>,
    row: Vector3<f64>,
    columns: usize,
    rows: usize,
    /// Radius of the tool's effect, m.
    radius: f64,
}

impl CellGrid {
    pub fn new(spec: &CoverageSpec) -> Self {
        let [origin, column, row] = [spec.origin_m, spec.column_step_m, spec.row_step_m].map(Vector3::from);
        Self { origin, column, row, columns: spec.columns as usize, rows: spec.rows as usize, radius: spec.radius_m }
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.columns * self.rows
    }

    /// Radius of the tool's effect, m.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The point `column` columns and `row` rows from the centre of cell 0, m.
    pub fn point(&self, column: f64, row: f64) -> Vector3<f64> {
        self.origin + self.row * row + self.column * column
    }

    /// Column and row of `cell`.
    pub fn place(&self, cell: usize) -> [f64; 2] {
        [(cell % self.columns) as f64, (cell / self.columns) as f64]
    }

    /// Calls `found` with each cell whose centre is strictly nearer than the radius to `tool` (m), in ascending order.
    pub fn near(&self, tool: &Vector3<f64>, mut found: impl FnMut(usize)) {
        let [columns, rows] = self.window(tool);
        for row in rows {
            for column in columns.clone() {
                if (tool - self.point(column as f64, row as f64)).norm_squared() < self.radius * self.radius {
                    found(row * self.columns + column);
                }
            }
        }
    }

    /// Columns and rows outside of which no cell is near.
    fn window(&self, tool: &Vector3<f64>) -> [Range<usize>; 2] {
        let all = [0..self.columns, 0..self.rows];
        let column = if self.columns > 1 { self.column } else { Vector3::zeros() };
        let row = if self.rows > 1 { self.row } else { Vector3::zeros() };
        let (cc, cr, rr) = (column.dot(&column), column.dot(&row), row.dot(&row));
        let from = tool - self.origin;
        let (c, r) = (column.dot(&from), row.dot(&from));
        let around = |at: f64, reach: f64, count: usize| bounded(at - reach - MARGIN, at + reach + MARGIN, count);
        let along = |product: f64, square: f64, count: usize| {
            if square > 0.0 { around(product / square, self.radius / square.sqrt(), count) } else { 0..count }
        };
        match (cc > 0.0, rr > 0.0) {
            (true, true) => {
                let determinant = cc * rr - cr * cr;
                if determinant <= 1e-9 * cc * rr {
                    return all;
                }
                let at = [(rr * c - cr * r) / determinant, (cc * r - cr * c) / determinant];
                let reach = [rr, cc].map(|square| self.radius * (square / determinant).sqrt());
                [around(at[0], reach[0], self.columns), around(at[1], reach[1], self.rows)]
            }
            _ => [along(c, cc, self.columns), along(r, rr, self.rows)],
        }
    }
}

/// The whole numbers of `low..=high` in `0..count`.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to 0..=count before")]
fn bounded(low: f64, high: f64, count: usize) -> Range<usize> {
    let clamp = |value: f64| value.clamp(0.0, count as f64) as usize;
    clamp(low.ceil())..clamp(high.floor() + 1.0)
}

#[cfg(test)]
mod tests {
    use super::CellGrid;
    use nalgebra::Vector3;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_window_loses_no_cell(
            steps in prop::array::uniform2(prop::array::uniform3(-0.2..0.2_f64)),
            counts in prop::array::uniform2(1..9_usize),
            radius in 0.01..0.6_f64,
            tool in prop::array::uniform3(-1.0..1.0_f64),
        ) {
            let [column, row] = steps.map(Vector3::from);
            let grid = CellGrid { origin: Vector3::zeros(), column, row, columns: counts[0], rows: counts[1], radius };
            let tool = Vector3::from(tool);
            let mut found = Vec::new();
            grid.near(&tool, |cell| found.push(cell));
            let is_near = |cell: &usize| {
                let [column, row] = grid.place(*cell);
                (tool - grid.point(column, row)).norm() < radius
            };
            prop_assert_eq!(found, (0..grid.cells()).filter(is_near).collect::<Vec<_>>());
        }
    }
}
