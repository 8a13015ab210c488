//! Prediction of the cell that a pose leads to, learned from the cells that trials gained.
//!
//! One Gaussian process per coordinate, from joints to (row, column): its mean is the middle of the grid, its kernel
//! `v exp(-d^2 / 2 l^2)` with d in degrees and v the grid's own scatter. A pose's chance of gaining something new is
//! the density of its predicted place at the centres of unpainted cells.

use crate::CellSet;
use crate::world::Surface;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;

const LENGTH_DEG: f64 = 45.0;
/// Number of hits, the latest, that predictions are made of.
const MOST_HITS: usize = 128;
/// Scatter about a cell's centre of the places of poses that paint it, in cells.
const SCATTER: f64 = 0.35;

/// Rows and columns of a surface as plane coordinates.
#[derive(Debug, Clone, Copy)]
struct Grid {
    columns: usize,
    rows: usize,
}

impl Grid {
    /// Row and column of a cell.
    fn place(self, cell: usize) -> [f64; 2] {
        [(cell / self.columns) as f64, (cell % self.columns) as f64]
    }

    fn middle(self) -> [f64; 2] {
        [(self.rows as f64 - 1.0) / 2.0, (self.columns as f64 - 1.0) / 2.0]
    }

    /// Mean squared distance of a cell's row and column from the middle; at least that of a 2 x 2 grid.
    fn variance(self) -> f64 {
        let of = |count: usize| (count * count) as f64 / 12.0;
        f64::midpoint(of(self.rows), of(self.columns)).max(1.0 / 3.0)
    }

    fn cells(self) -> usize {
        self.columns * self.rows
    }
}

/// Poses that were seen to gain cells.
#[derive(Debug, Clone)]
pub(in crate::method::whole_run) struct CellPredictor {
    grid: Grid,
    painted: CellSet,
    /// Joints, and the mean row and column of the cells gained.
    hits: Vec<(Vec<f64>, [f64; 2])>,
}

impl CellPredictor {
    pub fn new(surface: Surface) -> Self {
        let grid = Grid { columns: surface.columns, rows: surface.rows };
        Self { grid, painted: CellSet::empty(grid.cells()), hits: Vec::new() }
    }

    /// Records the cells that a trial gained, and whether the trial was accepted.
    pub fn tell(&mut self, joints: &[f64], fresh: &CellSet, accepted: bool) {
        let places: Vec<[f64; 2]> =
            (0..self.grid.cells()).filter(|&c| fresh.contains(c)).map(|c| self.grid.place(c)).collect();
        if !places.is_empty() {
            let mean = |k: usize| places.iter().map(|place| place[k]).sum::<f64>() / places.len() as f64;
            self.hits.push((joints.to_vec(), [mean(0), mean(1)]));
        }
        if accepted {
            self.painted.extend(fresh);
        }
    }

    /// For each pose, the density of its predicted place at unpainted cells, per cell; `None` before the first hit.
    /// `squared` is the squared distance between two poses, degrees.
    pub fn chances(&self, poses: &[Vec<f64>], squared: impl Fn(&[f64], &[f64]) -> f64) -> Option<Vec<f64>> {
        let hits = &self.hits[self.hits.len().saturating_sub(MOST_HITS)..];
        let count = hits.len();
        let variance = self.grid.variance();
        let kernel = |a: &[f64], b: &[f64]| variance * (-squared(a, b) / (2.0 * LENGTH_DEG * LENGTH_DEG)).exp();
        let noise = SCATTER * SCATTER;
        let gram =
            DMatrix::from_fn(count, count, |i, j| kernel(&hits[i].0, &hits[j].0) + if i == j { noise } else { 0.0 });
        let factor = (count > 0).then(|| gram.cholesky())??;
        let middle = self.grid.middle();
        let weights = [0, 1].map(|k| factor.solve(&DVector::from_fn(count, |i, _| hits[i].1[k] - middle[k])));
        let open: Vec<[f64; 2]> =
            (0..self.grid.cells()).filter(|&c| !self.painted.contains(c)).map(|c| self.grid.place(c)).collect();
        let of = |pose: &Vec<f64>| {
            let near = DVector::from_fn(count, |i, _| kernel(pose, &hits[i].0));
            let place = [0, 1].map(|k| middle[k] + near.dot(&weights[k]));
            let spread = (variance - near.dot(&factor.solve(&near))).max(0.0) + noise;
            let density = |cell: &[f64; 2]| {
                let away = (cell[0] - place[0]).powi(2) + (cell[1] - place[1]).powi(2);
                (-away / (2.0 * spread)).exp() / (TAU * spread)
            };
            open.iter().map(density).sum()
        };
        Some(poses.iter().map(of).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::CellPredictor;
    use crate::CellSet;
    use crate::world::Surface;

    fn seen(columns: usize, rows: usize) -> Surface {
        Surface { columns, rows, resets: true, cells_seen: true }
    }

    fn squared(a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).map(|(x, y)| (x - y).to_degrees().powi(2)).sum()
    }

    #[test]
    fn a_pose_leads_where_its_neighbours_led() {
        let mut predictor = CellPredictor::new(seen(3, 2));
        let poses: Vec<Vec<f64>> = [0.0, 0.4, 0.8].map(|q| vec![q]).to_vec();
        assert_eq!(predictor.chances(&poses, squared), None);
        // cells 0 and 2 of the first row; what lies between leads to cell 1
        predictor.tell(&[0.0], &CellSet::from(vec![0b001]), true);
        predictor.tell(&[0.8], &CellSet::from(vec![0b100]), true);
        let open = predictor.chances(&poses, squared).unwrap();
        assert!(open[1] > 1.3 * open[0] && open[1] > 1.3 * open[2], "{open:?}");
        predictor.tell(&[0.4], &CellSet::from(vec![0b010]), true);
        let closed = predictor.chances(&poses, squared).unwrap();
        assert!(closed[1] < 0.7 * open[1], "{closed:?} after {open:?}");
    }

    #[test]
    fn what_is_gained_but_not_kept_stays_open() {
        let kept = |accepted| {
            let mut predictor = CellPredictor::new(seen(2, 2));
            predictor.tell(&[0.1], &CellSet::from(vec![0b0001]), accepted);
            predictor.chances(&[vec![0.1]], squared).unwrap()[0]
        };
        assert!(kept(false) > kept(true) + 0.1, "{} {}", kept(false), kept(true));
    }
}
