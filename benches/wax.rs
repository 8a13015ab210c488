//! One wax evaluation: incremental (one forward kinematics, one DTW row) against full recomputation (nine forward
//! kinematics, the whole DTW matrix), and a whole SST run.
//!
//! `cargo bench --bench wax`: the ratio of the two medians is the gain of IET's incremental form; items per second are
//! evaluations per second on one core.

use cgda::framework::execution::{PartialDiscrepancy, Problem, run};
use cgda::framework::recognition::discrepancy;
use cgda::framework::robot::{Chain, RobotModel};
use cgda::framework::world::{self, World};
use cgda::reproduce::shipped;
use divan::counter::ItemsCount;
use divan::{Bencher, black_box};

/// Evaluations per timed sample.
const POSES: usize = 1024;

fn main() {
    let problem = shipped::preset("paper-wax").expect("paper-wax is shipped").problem;
    let mut both = Both::new(&problem);
    for pose in &both.poses.clone() {
        assert_eq!(both.incremental(pose).to_bits(), both.whole(pose).to_bits(), "both ways give the same bits");
    }
    divan::main();
}

/// The last goal of wax: eight goals are observed, the ninth is searched.
struct Both {
    problem: Problem,
    world: Box<dyn World>,
    partial: PartialDiscrepancy,
    prefix: Vec<[f64; 3]>,
    poses: Vec<[f64; 3]>,
    observed: Vec<f64>,
}

impl Both {
    fn new(problem: &Problem) -> Self {
        let model = RobotModel::from_urdf(&problem.urdf).expect("the shipped arm is valid");
        let chain = Chain::new(&model, &problem.robot).expect("the shipped chain is valid");
        let mut world = world::build(&problem.world, &chain).expect("the shipped world is valid");
        let mut partial = PartialDiscrepancy::new(&problem.goals, problem.execution.metric);
        let pose = |k: usize| [0.1, 0.37, 0.73].map(|step| -0.26 + (step * k as f64) % 2.0);
        let prefix: Vec<[f64; 3]> = (0..problem.goals.len() - 1).map(pose).collect();
        let mut seen = [0.0; 3];
        for joints in &prefix {
            world.commit(joints, &mut seen);
            partial.append(&seen);
        }
        let observed = vec![0.0; problem.goals.values().len()];
        Self { problem: problem.clone(), world, partial, prefix, poses: (0..POSES).map(pose).collect(), observed }
    }

    fn incremental(&mut self, pose: &[f64]) -> f64 {
        let mut seen = [0.0; 3];
        self.world.observe(pose, &mut seen);
        self.partial.of(&seen)
    }

    fn whole(&mut self, pose: &[f64]) -> f64 {
        let (earlier, last) = self.observed.split_at_mut(3 * self.prefix.len());
        for (joints, seen) in self.prefix.iter().zip(earlier.chunks_exact_mut(3)) {
            self.world.observe(joints, seen);
        }
        self.world.observe(pose, last);
        discrepancy(self.problem.execution.metric, &self.observed, self.problem.goals.values(), 3)
    }
}

fn bench(bencher: Bencher<'_, '_>, evaluate: fn(&mut Both, &[f64]) -> f64) {
    let mut both = Both::new(&shipped::preset("paper-wax").expect("paper-wax is shipped").problem);
    let poses = both.poses.clone();
    bencher.counter(ItemsCount::new(POSES)).bench_local(|| {
        for pose in &poses {
            black_box(evaluate(&mut both, black_box(pose)));
        }
    });
}

#[divan::bench]
fn incremental(bencher: Bencher<'_, '_>) {
    bench(bencher, Both::incremental);
}

#[divan::bench]
fn full_recomputation(bencher: Bencher<'_, '_>) {
    bench(bencher, Both::whole);
}

/// Including the optimiser: about 9700 evaluations per run.
#[divan::bench(sample_count = 20)]
fn whole_sst_run(bencher: Bencher<'_, '_>) {
    let problem = shipped::preset("paper-wax").expect("paper-wax is shipped").problem;
    let evaluations = run(&problem, 1).expect("paper-wax runs").evaluations;
    bencher.counter(ItemsCount::new(evaluations)).bench_local(|| run(black_box(&problem), 1));
}
