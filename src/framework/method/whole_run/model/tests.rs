//! The methods on whole problems: evaluations and discrepancy in bounds, resumed runs, kernels against differences.

use super::columns::Columns;
use super::kernel::{Kernel, Poses};
use super::process::{Family, Process};
use super::{ModelIet, ModelSpec};
use crate::execution::{Iet, IetState, Problem, RunResult, run, simulate};
use crate::method::MethodSpec;
use crate::method::whole_run::space::{Axis, Space};
use crate::method::whole_run::{BroydenSpec, NextTrial, Trial, WholeRun};
use crate::preset;
use nalgebra::DMatrix;

fn axis(revolute: bool) -> Axis {
    Axis { lower: -1.0, upper: 1.5, home: 0.1, revolute }
}

fn shipped(name: &str, method: MethodSpec) -> Problem {
    let mut problem = preset::shipped(name).unwrap().problem;
    problem.execution.method = method;
    problem
}

#[test]
fn kernel_slopes_agree_with_differences() {
    let space = Space::new(vec![axis(true), axis(false), axis(true)]);
    let mut poses = Poses::new(&space);
    poses.push(&[0.3, -0.2, 1.1]);
    poses.push(&[-0.9, 0.7, 0.0]);
    let at = [0.5, 0.1, -0.4];
    poses.push(&at);
    for kernel in [Kernel::Trig(2.0), Kernel::Se(0.8)] {
        let mut columns = Columns::new(&poses, kernel);
        let mut there = |j: usize, by: f64| {
            columns.ask(&std::array::from_fn::<f64, 3, _>(|i| if i == j { at[i] + by } else { at[i] }));
            columns.slopes_there();
            (columns.k.clone(), columns.dk.clone())
        };
        let (k, dk) = there(0, 0.0);
        for (i, k) in k.iter().enumerate() {
            assert!((k - poses.between(kernel, 2, i)).abs() < 1e-15, "{kernel:?} pose {i}");
        }
        for j in 0..3 {
            let (ahead, behind) = (there(j, 1e-6).0, there(j, -1e-6).0);
            for i in 0..3 {
                let difference = (ahead[i] - behind[i]) / 2e-6;
                assert!((difference - dk[j * 3 + i]).abs() < 1e-8, "{kernel:?} pose {i} joint {j}");
            }
        }
    }
}

#[test]
fn the_process_goes_through_its_data_and_is_unsure_elsewhere() {
    let space = Space::new(vec![axis(true), axis(true)]);
    let mut poses = Poses::new(&space);
    let data = [[0.0, 0.0], [0.8, -0.5], [-0.7, 1.0]];
    for q in &data {
        poses.push(q);
    }
    let residuals = DMatrix::from_row_slice(3, 2, &[1.0, -2.0, 3.0, 0.5, -4.0, 1.0]);
    let mut process = Process::fit(&poses, &residuals, Family::Trig, 3.0, 0.0).unwrap();
    let mut mean = [0.0; 2];
    for (i, q) in data.iter().enumerate() {
        let variance = process.predict(q, &mut mean);
        assert!((mean[0] - residuals[(i, 0)]).abs() < 1e-3 && (mean[1] - residuals[(i, 1)]).abs() < 1e-3);
        assert!(variance < 1e-4 * process.amplitude_squared(), "{variance}");
    }
    assert!(process.predict(&[1.5, 1.5], &mut mean) > 1e-2 * process.amplitude_squared());
}

#[test]
fn asking_is_a_function_of_the_log() {
    let space = Space::new(vec![axis(true), axis(true)]);
    let goals = vec![vec![0.3, 0.4], vec![0.5, 0.1]];
    let fresh = || ModelIet::new(ModelSpec::default(), 0.01, space.clone(), goals.clone(), 7);
    let world = |q: &[f64]| vec![q[0].cos() + 0.3 * q[1].sin(), q[0].sin() * q[1].cos()];
    let mut whole = fresh();
    while let NextTrial::Execute { joints, goal } = whole.ask() {
        assert_eq!(whole.ask(), NextTrial::Execute { joints: joints.clone(), goal });
        let mut resumed = fresh();
        whole.log().iter().for_each(|t| resumed.tell(t.clone()));
        assert_eq!(resumed.ask(), NextTrial::Execute { joints: joints.clone(), goal });
        whole.tell(Trial { observation: Some(world(&joints)), cells: None, joints, goal });
    }
    assert!(whole.log().len() < 40);
}

#[test]
fn wax_takes_a_dozen_and_a_half_evaluations() {
    let result = run(&shipped("wax", MethodSpec::Model(ModelSpec::default())), 5000).unwrap();
    assert!(result.evaluations <= 16 && result.discrepancy <= 274.0, "{result:?}");
    let counted: u64 = result.goals.iter().map(|g| g.evaluations).sum();
    assert_eq!(counted, result.evaluations);
}

/// The run, saved and resumed after every `slice` evaluations.
pub(in crate::method::whole_run) fn interrupted(problem: &Problem, seed: u64, slice: u64) -> RunResult {
    let mut iet = Iet::new(problem, seed).unwrap();
    while !iet.is_finished() {
        let mut world = iet.world().unwrap();
        simulate(&mut iet, world.as_mut(), slice).unwrap();
        let saved = serde_json::to_string(&iet.state()).unwrap();
        iet = Iet::resume(problem, serde_json::from_str::<IetState>(&saved).unwrap()).unwrap();
    }
    iet.finish().unwrap()
}

#[test]
fn a_resumed_run_gives_the_same_bits() {
    for (name, method) in [
        ("wax-reachable", MethodSpec::Model(ModelSpec::default())),
        ("wax", MethodSpec::Broyden(BroydenSpec::default())),
    ] {
        let problem = shipped(name, method);
        assert_eq!(interrupted(&problem, 3, 4), run(&problem, 3).unwrap(), "{name}");
    }
}
