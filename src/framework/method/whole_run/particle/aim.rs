//! Poses aimed at places of the surface that are still open, with the simulator of one particle.

use super::Simulator;
use super::belief::Particle;
use crate::method::whole_run::space::Space;
use crate::random::RandomStream;
use nalgebra::{DMatrix, Matrix3, Vector3};

/// Places aimed at, per particle.
const PLACES: usize = 96;
/// Poses from which a place is aimed at, until one leads to an allowed pose there.
const STARTS: usize = 3;
/// Most steps of one aim.
const STEPS: usize = 6;
/// Distance from the place within which an aim ends, as a share of the tool's radius.
const CLOSE: f64 = 0.05;
/// Distance from the place up to which a pose may still reach it, as the particle may be wrong; as a share of the radius.
const REACH: f64 = 1.5;
/// Difference by which derivatives are taken, rad or m.
const DELTA: f64 = 1e-4;
/// Damping of a step, m.
const DAMPING: f64 = 0.02;

/// Allowed poses that lead `particle` to open places, each from the nearest of `known`.
pub(super) fn poses(
    simulator: &dyn Simulator,
    particle: &Particle,
    space: &Space,
    known: &[Vec<f64>],
    random: &mut RandomStream,
) -> Vec<Vec<f64>> {
    let grid = simulator.grid();
    let tools = simulator.tools(&particle.parameters, known);
    let open: Vec<usize> = (0..grid.cells()).filter(|&cell| !particle.painted.contains(cell)).collect();
    let mut found = Vec::new();
    for _ in 0..PLACES.min(2 * open.len()) {
        let Some(&cell) = random.pick(&open) else { break };
        let [column, row] = grid.place(cell).map(|at| at + random.unit() - 0.5);
        let place = grid.point(column, row);
        let mut nearest: Vec<usize> = (0..known.len()).collect();
        let away = |&index: &usize| (tools[index] - place).norm_squared();
        let starts = STARTS.min(nearest.len());
        if nearest.len() > starts {
            nearest.select_nth_unstable_by(starts, |a, b| away(a).total_cmp(&away(b)).then(a.cmp(b)));
        }
        nearest.truncate(starts);
        nearest.sort_by(|a, b| away(a).total_cmp(&away(b)).then(a.cmp(b)));
        found.extend(nearest.iter().find_map(|&start| aim(simulator, particle, space, &known[start], &place)));
    }
    found
}

/// An allowed pose near `start` that leads to `place`; `None` if none was found.
fn aim(
    simulator: &dyn Simulator,
    particle: &Particle,
    space: &Space,
    start: &[f64],
    place: &Vector3<f64>,
) -> Option<Vec<f64>> {
    let radius = simulator.grid().radius();
    let mut pose = start.to_vec();
    for step in 0..=STEPS {
        let mut around = vec![pose.clone(); space.len() + 1];
        for (joint, moved) in around[1..].iter_mut().enumerate() {
            moved[joint] += DELTA;
        }
        let tools = simulator.tools(&particle.parameters, &around);
        let miss = place - tools[0];
        if miss.norm() < CLOSE * radius || step == STEPS {
            return (miss.norm() < REACH * radius && space.allows(&pose)).then_some(pose);
        }
        let jacobian = DMatrix::from_fn(3, space.len(), |k, joint| (tools[joint + 1][k] - tools[0][k]) / DELTA);
        let square = &jacobian * jacobian.transpose();
        let square = Matrix3::from_fn(|i, j| square[(i, j)]) + Matrix3::identity() * (DAMPING * DAMPING);
        let pull = square.try_inverse()? * miss;
        for (joint, (value, axis)) in pose.iter_mut().zip(&space.axes).enumerate() {
            let change: f64 = (0..3).map(|k| jacobian[(k, joint)] * pull[k]).sum();
            *value = (*value + change).clamp(axis.lower, axis.upper);
        }
    }
    None
}
