//! Surfaces of several sizes, tilts and arms: the methods that cover them beside a yardstick, a greedy cover by someone
//! who knows the true arm.
//!
//! `cargo run --release -p cgda-core --example surfaces [METHOD [SURFACE [SEEDS]]]` prints a table. Each seed draws an arm whose
//! links are off by up to 5 % and whose base by 2 cm. Shares are of the cells that the true arm can reach.

use cgda_core::CellSet;
use cgda_core::Feature;
use cgda_core::execution::{ExecutionSpec, Iet, Problem, simulate};
use cgda_core::generalization::Goals;
use cgda_core::method::MethodSpec;
use cgda_core::random::RandomStream;
use cgda_core::robot::{Chain, RobotSpec};
use cgda_core::world::{CoverageSpec, DisturbanceSpec, SurfaceView, ToolPositionSpec, WorldSpec, build_disturbed};
use nalgebra::{DMatrix, Matrix3, Vector3};
use std::error::Error;
use std::path::Path;

/// A surface before an arm.
struct Case {
    name: &'static str,
    arm: &'static str,
    goals: u32,
    surface: CoverageSpec,
}

fn surface(
    origin_m: [f64; 3],
    column: [f64; 3],
    row: [f64; 3],
    columns: u32,
    rows: u32,
    radius_m: f64,
) -> CoverageSpec {
    CoverageSpec {
        origin_m,
        column_step_m: column,
        row_step_m: row,
        columns,
        rows,
        radius_m,
        resets: true,
        observes: SurfaceView::Percent,
    }
}

fn cases() -> Vec<Case> {
    let case = |name, arm, goals, surface| Case { name, arm, goals, surface };
    let flat = ([0.0, 0.0276, 0.0], [0.0, 0.0, 0.042]);
    vec![
        case("4 x 4", "teo", 17, surface([0.6, -0.8, 0.32], [0.0, 0.2, 0.0], [0.0, 0.0, 0.2], 4, 4, 0.13)),
        case("20 x 30", "teo", 17, surface([0.6, -0.9, 0.22], flat.0, flat.1, 30, 20, 0.05)),
        case(
            "16 x 16 tilted",
            "teo",
            11,
            surface([0.6, -0.75, 0.3], [0.01, 0.035, 0.0], [-0.015, 0.0, 0.035], 16, 16, 0.05),
        ),
        case("20 x 30", "seven", 17, surface([0.3, -0.3, 0.4], [0.0, 0.0207, 0.0], [0.021, 0.0, 0.0], 30, 20, 0.035)),
        case(
            "15 x 20 tilted",
            "seven",
            21,
            surface([0.3, -0.3, 0.3], [0.0, 0.03, 0.008], [0.026, 0.0, 0.015], 20, 15, 0.045),
        ),
        // Not looked at while the methods were made.
        case(
            "25 x 24 held out",
            "teo",
            26,
            surface([0.5, -0.7, 0.4], [0.012, 0.025, 0.004], [0.0, -0.006, 0.026], 24, 25, 0.042),
        ),
        case(
            "10 x 40 held out",
            "seven",
            9,
            surface([0.45, -0.4, 0.25], [-0.004, 0.02, 0.004], [0.01, 0.004, 0.03], 40, 10, 0.04),
        ),
    ]
}

fn problem(case: &Case, method: MethodSpec) -> Result<Problem, Box<dyn Error>> {
    let share = |k| vec![100.0 * f64::from(k) / f64::from(case.goals - 1)];
    let file = if case.arm == "teo" { "teo_right_arm.urdf" } else { "seven_joint_arm.urdf" };
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/robots").join(file);
    let named = |names: &[(&str, f64)]| names.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    let robot = if case.arm == "teo" {
        RobotSpec {
            free_joints: Some(["shoulder_pitch", "shoulder_roll", "elbow_pitch"].map(str::to_owned).to_vec()),
            fixed: named(&[("wrist_yaw", -std::f64::consts::FRAC_PI_4)]),
            ..RobotSpec::default()
        }
    } else {
        let home = named(&[("joint_2", -0.785), ("joint_4", -2.356), ("joint_6", 1.571), ("joint_7", 0.785)]);
        RobotSpec { home, ..RobotSpec::default() }
    };
    let mut execution = ExecutionSpec::new(method);
    execution.reality = Some(DisturbanceSpec { link_share: 0.05, base_shift_m: 0.02, ..DisturbanceSpec::default() });
    Ok(Problem {
        goals: Goals::new(vec![Feature::new("painted", "%")], &(0..case.goals).map(share).collect::<Vec<_>>())?,
        urdf: std::fs::read_to_string(path)?,
        robot,
        world: WorldSpec::Coverage(case.surface.clone()),
        execution,
        earlier: Vec::new(),
    })
}

/// The cells that each pose of a dense pool covers with the true arm.
fn dense_covers(
    chain: &Chain,
    case: &Case,
    reality: &DisturbanceSpec,
    seed: u64,
) -> Result<Vec<CellSet>, Box<dyn Error>> {
    let place = WorldSpec::ToolPosition(ToolPositionSpec { unit: "m".to_owned() });
    let mut place = build_disturbed(&place, chain, reality, seed)?;
    let mut tool = |pose: &[f64]| {
        let mut seen = [0.0; 3];
        place.observe(pose, &mut seen);
        Vector3::from(seen)
    };
    let mut random = RandomStream::of_run(seed, 77);
    let genes = chain.genes();
    let mut uniform = || genes.iter().map(|gene| random.between(gene.lower, gene.upper)).collect::<Vec<f64>>();
    let pool: Vec<Vec<f64>> = (0..4000).map(|_| uniform()).collect();
    let tools: Vec<Vector3<f64>> = pool.iter().map(|pose| tool(pose)).collect();
    let mut world = build_disturbed(&WorldSpec::Coverage(case.surface.clone()), chain, reality, seed)?;
    let mut covers = Vec::new();
    let mut seen = [0.0];
    let [origin, column, row] =
        [case.surface.origin_m, case.surface.column_step_m, case.surface.row_step_m].map(Vector3::from);
    for half_row in 0..2 * case.surface.rows {
        for half_column in 0..2 * case.surface.columns {
            let target = origin + column * (f64::from(half_column) / 2.0) + row * (f64::from(half_row) / 2.0);
            let mut near: Vec<usize> = (0..pool.len()).collect();
            near.select_nth_unstable_by(3, |a, b| (tools[*a] - target).norm().total_cmp(&(tools[*b] - target).norm()));
            for &start in &near[..3] {
                let mut pose = pool[start].clone();
                for _ in 0..9 {
                    let at = tool(&pose);
                    world.reset();
                    world.commit(&pose, &mut seen);
                    covers.extend(world.cells().filter(|_| seen[0] > 0.0).cloned());
                    let columns: Vec<Vector3<f64>> = (0..pose.len())
                        .map(|joint| {
                            let mut moved = pose.clone();
                            moved[joint] += 1e-5;
                            (tool(&moved) - at) / 1e-5
                        })
                        .collect();
                    let jacobian = DMatrix::from_fn(3, pose.len(), |k, joint| columns[joint][k]);
                    let square = &jacobian * jacobian.transpose();
                    let square = Matrix3::from_fn(|i, j| square[(i, j)]) + Matrix3::identity() * 1e-4;
                    let Some(inverse) = square.try_inverse() else { break };
                    let step = jacobian.transpose() * (inverse * (target - at));
                    for (joint, gene) in genes.iter().enumerate() {
                        pose[joint] = (pose[joint] + step[joint]).clamp(gene.lower, gene.upper);
                    }
                }
            }
        }
    }
    Ok(covers)
}

/// Numbers of cells covered after each pose of a greedy cover.
fn greedy(covers: &[CellSet], cells: usize) -> Vec<u32> {
    let mut painted = CellSet::empty(cells);
    let mut counts = Vec::new();
    while let Some(best) = covers.iter().max_by_key(|cover| cover.count_beyond([&painted])) {
        if best.count_beyond([&painted]) == 0 {
            break;
        }
        painted.extend(best);
        counts.push(painted.count());
    }
    counts
}

/// Number of entries up to the first that is at least `least`; infinite if there is none.
fn until(counts: &[u32], least: f64) -> f64 {
    counts.iter().position(|&count| f64::from(count) >= least).map_or(f64::INFINITY, |index| index as f64 + 1.0)
}

fn column(values: &mut [f64]) -> String {
    values.sort_by(f64::total_cmp);
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let last = values.len() - 1;
    format!("{mean:7.1} {:7.1} {:7.1}", values[last / 2], values[last * 9 / 10])
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let wanted = |index: usize| arguments.get(index).map_or("", String::as_str);
    let seeds: u64 = wanted(2).parse().unwrap_or(10);
    let evaluations: Option<u32> = wanted(3).parse().ok();
    println!(
        "mean, median and p90 over {seeds} seeds; share of reachable cells (worst last), evaluations and poses to 95 % of them"
    );
    for case in cases().iter().filter(|case| format!("{} {}", case.arm, case.name).contains(wanted(1))) {
        for name in ["particle", "search"].into_iter().filter(|name| name.contains(wanted(0))) {
            let mut rows: [Vec<f64>; 6] = Default::default();
            let begun = std::time::Instant::now();
            for seed in 0..seeds {
                let mut method = MethodSpec::by_name(name).ok_or("no such method")?;
                match &mut method {
                    MethodSpec::Particle(spec) => spec.max_evaluations = evaluations,
                    MethodSpec::Search(spec) => spec.max_evaluations = evaluations,
                    _ => {}
                }
                let problem = problem(case, method)?;
                let mut iet = Iet::new(&problem, seed)?;
                let mut world = iet.world()?;
                simulate(&mut iet, world.as_mut(), u64::MAX)?;
                let cells = (case.surface.columns * case.surface.rows) as usize;
                let reality = problem.execution.reality.as_ref().ok_or("no reality")?;
                let yardstick = greedy(&dense_covers(iet.chain(), case, reality, seed)?, cells);
                let reachable = f64::from(yardstick.last().copied().unwrap_or(0));
                // The accepted poses, once more, in a fresh world.
                world.reset();
                let mut seen = [0.0];
                let replayed: Vec<u32> = iet
                    .prefix()
                    .map(|pose| {
                        world.commit(pose, &mut seen);
                        world.cells().map_or(0, CellSet::count)
                    })
                    .collect();
                let (trials, poses) = (iet.log().len() as f64, replayed.len() as f64);
                let at = until(&replayed, 0.95 * reachable);
                let mut shown = 0;
                let best: Vec<u32> = iet
                    .log()
                    .iter()
                    .map(|trial| {
                        let here = replayed.get(shown).copied().unwrap_or(u32::MAX);
                        let percent = trial.observation.as_ref().map_or(0.0, |o| o[0]);
                        let is_next = iet.prefix().nth(shown).is_some_and(|pose| pose == trial.joints.as_slice());
                        if is_next && (percent - 100.0 * f64::from(here) / cells as f64).abs() < 1e-6 {
                            shown += 1;
                        }
                        shown.checked_sub(1).map_or(0, |index| replayed[index])
                    })
                    .collect();
                let claimed = iet.finish()?.painted_percent.unwrap_or(0.0);
                assert!((claimed - seen[0]).abs() < 1e-9, "claimed {claimed} %, replayed {} %", seen[0]);
                let last = f64::from(replayed.last().copied().unwrap_or(0));
                let row = [
                    trials,
                    poses,
                    100.0 * last / reachable,
                    until(&best, 0.95 * reachable),
                    at,
                    at / until(&yardstick, 0.95 * reachable),
                ];
                rows.iter_mut().zip(row).for_each(|(values, value)| values.push(value));
                if evaluations.is_some() || seeds < 4 {
                    eprintln!(
                        "seed {seed}: {row:.1?} of {reachable} reachable, greedy {} poses to all",
                        yardstick.len()
                    );
                }
            }
            let [a, b, c, d, e, f] = &mut rows;
            let worst = c.iter().copied().fold(f64::INFINITY, f64::min);
            println!(
                "{:5} {:18} {name:9} trials {} | poses {} | share {} min {worst:.1} | trials to 95 % {} | poses to 95 % {} | of greedy's {} | {:.1} s per run",
                case.arm,
                case.name,
                column(a),
                column(b),
                column(c),
                column(d),
                column(e),
                column(f),
                begun.elapsed().as_secs_f64() / seeds as f64
            );
        }
    }
    Ok(())
}
