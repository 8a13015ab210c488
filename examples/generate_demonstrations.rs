//! Writes the synthetic demonstrations of `examples/demonstrations`: the same bytes on every run.
//!
//! `cargo run --example generate_demonstrations [DIRECTORY]`; the README next to the files describes them.
//! Each demonstration has its own ChaCha stream, so that adding one leaves the others unchanged.

use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;
use std::fmt::Write as _;
use std::path::Path;

const SEED: u64 = 20_171_026;

/// Path of a waxing hand over a panel, robot base frame, mm; one point per second.
const WAX_GOALS_MM: [[f64; 3]; 9] = [
    [461.24, -502.73, 303.98],
    [457.61, -516.86, 303.03],
    [419.36, -588.84, 298.77],
    [316.95, -620.80, 293.52],
    [235.19, -554.15, 292.91],
    [283.27, -448.08, 300.95],
    [408.68, -435.33, 306.88],
    [461.54, -484.30, 304.27],
    [463.08, -500.37, 303.83],
];

/// One file: path below the directory, and content.
pub type File = (String, String);

fn main() -> std::io::Result<()> {
    let directory = std::env::args().nth(1).unwrap_or_else(|| "examples/demonstrations".to_owned());
    for (path, content) in files() {
        let path = Path::new(&directory).join(path);
        if let Some(parent) = path.parent() {
            std::fs::create_dir_all(parent)?;
        }
        std::fs::write(&path, content)?;
    }
    Ok(())
}

/// Every file with its content.
pub fn files() -> Vec<File> {
    let wax = (0..4).map(|k| (format!("wax/demo-{}.csv", k + 1), wax(k)));
    let paint = (0..4).map(|k| (format!("paint/demo-{}.csv", k + 1), paint(k)));
    wax.chain(paint).chain((0..3).flat_map(iron)).collect()
}

/// The generator of one demonstration: `kind` 1 wax, 2 paint, 3 iron.
fn rng(kind: u64, demonstration: u64) -> ChaCha8Rng {
    let mut rng = ChaCha8Rng::seed_from_u64(SEED);
    rng.set_stream(kind << 8 | demonstration);
    rng
}

/// Uniform in -width..width.
fn jitter(rng: &mut ChaCha8Rng, width: f64) -> f64 {
    rng.random_range(-width..width)
}

/// Piecewise linear interpolation of `knots`, placed at the centres of n equal parts of [0, 1]; constant outside.
fn through(knots: &[f64], x: f64) -> f64 {
    let place = (x * knots.len() as f64 - 0.5).clamp(0.0, (knots.len() - 1) as f64);
    let before = (0..knots.len() - 1).rfind(|i| *i as f64 <= place).unwrap_or(0);
    let share = place - before as f64;
    knots[before] + share * (knots[before + 1] - knots[before])
}

/// Knots whose means over the n parts of the curve [`through`] them are `means`: the mean of part i is
/// (k_(i-1) + 6 k_i + k_(i+1)) / 8, a missing neighbour being k_i; solved by Gauss-Seidel (diagonally dominant).
fn knots_with_means(means: &[f64]) -> Vec<f64> {
    let mut knots = means.to_vec();
    for _ in 0..60 {
        for i in 0..knots.len() {
            let before = i.checked_sub(1).map(|j| knots[j]);
            let after = knots.get(i + 1).copied();
            let own = 6.0 + f64::from(u8::from(before.is_none())) + f64::from(u8::from(after.is_none()));
            knots[i] = (8.0 * means[i] - before.unwrap_or(0.0) - after.unwrap_or(0.0)) / own;
        }
    }
    knots
}

/// Object centroid in mm at about 20 Hz over 9.2 to 9.8 s, slightly shifted and jittered.
fn wax(demonstration: u64) -> String {
    let mut rng = rng(1, demonstration);
    let axes: Vec<Vec<f64>> = (0..3).map(|axis| knots_with_means(&WAX_GOALS_MM.map(|goal| goal[axis]))).collect();
    let shift: Vec<f64> = (0..3).map(|_| jitter(&mut rng, 4.0)).collect();
    let duration_s = 9.2 + 0.2 * demonstration as f64;
    let samples = 20 * 9 + 4 * demonstration;
    let mut text = "time_s,x [mm],y [mm],z [mm]\n".to_owned();
    for sample in 0..=samples {
        let x = sample as f64 / samples as f64;
        let _ = write!(text, "{:.4}", x * duration_s);
        for (knots, shift) in axes.iter().zip(&shift) {
            let _ = write!(text, ",{:.3}", through(knots, x) + shift + jitter(&mut rng, 1.5));
        }
        text.push('\n');
    }
    text
}

/// Painted percentage of a wall of 16 squares at about 10 Hz: 0 at first, then one square after another up to 100, over
/// 17 parts of about a second. Squares are finished slightly early or late.
fn paint(demonstration: u64) -> String {
    let mut rng = rng(2, demonstration);
    let duration_s = 17.2 + 0.2 * demonstration as f64;
    let samples = 170 + 4 * demonstration;
    let finished: Vec<f64> = (1..=16).map(|square| (f64::from(square) + jitter(&mut rng, 0.15)) / 17.0).collect();
    let mut text = "time_s,painted [%]\n".to_owned();
    for sample in 0..=samples {
        let x = sample as f64 / samples as f64;
        let squares = finished.iter().filter(|at| **at <= x).count();
        let _ = writeln!(text, "{:.4},{:.2}", x * duration_s, 100.0 * squares as f64 / 16.0);
    }
    text
}

/// Two streams: hand pose (20 Hz) moving back and forth over the board, wrist force (10 Hz) while pressing.
fn iron(demonstration: u64) -> Vec<File> {
    let mut rng = rng(3, demonstration);
    let duration_s = 12.0 + 0.5 * demonstration as f64;
    let reach = 0.30 + jitter(&mut rng, 0.02);
    let press_n = 12.0 + jitter(&mut rng, 1.0);
    let tau = std::f64::consts::TAU;
    let mut pose = "time_s,x [m],y [m],z [m],axis_x,axis_y,axis_z,angle [deg]\n".to_owned();
    for sample in 0..=240_u32 {
        let x = f64::from(sample) / 240.0;
        let lift = 0.05 * (tau * x).cos().max(0.0);
        let position = [0.35 + reach / 2.0 * (1.0 - (tau * x).cos()) / 2.0, -0.45 + 0.05 * (2.0 * tau * x).sin(), lift];
        let _ = write!(pose, "{:.4}", x * duration_s);
        for value in position {
            let _ = write!(pose, ",{:.5}", value + jitter(&mut rng, 0.001));
        }
        let _ = writeln!(pose, ",0,1,0,{:.3}", 90.0 + 5.0 * (tau * x).sin() + jitter(&mut rng, 0.2));
    }
    let mut force = "time_s,Fx [N],Fy [N],Fz [N],Tx [N m],Ty [N m],Tz [N m]\n".to_owned();
    for sample in 0..=120_u32 {
        let x = f64::from(sample) / 120.0;
        let contact = (-(tau * x).cos()).max(0.0);
        let drag = -0.2 * press_n * contact * (tau * x).sin();
        let _ = write!(force, "{:.4}", x * duration_s);
        for value in [drag, 0.0, -press_n * contact, 0.0, 0.1 * drag, 0.0] {
            let _ = write!(force, ",{:.4}", value + jitter(&mut rng, 0.05));
        }
        force.push('\n');
    }
    let folder = format!("iron/demo-{}", demonstration + 1);
    vec![(format!("{folder}/hand-pose.csv"), pose), (format!("{folder}/wrist-force.csv"), force)]
}
