//! One proposal of MODEL-IET: seven joints, three features, nine open goals, after 20, 40 and 60 trials.
//!
//! `cargo bench --bench model`: a proposal must not keep a robot waiting; the bound is 20 ms after 60 trials.

use cgda::framework::execution::Iet;
use cgda::framework::method::whole_run::{ModelIet, ModelSpec, Space, Trial, WholeRun};
use cgda::framework::random::RandomStream;
use cgda::reproduce::shipped;
use divan::{Bencher, black_box};

fn main() {
    divan::main();
}

/// A run after `trials` measured poses, spread over the box and none of them near a goal.
fn after(trials: usize, noise: f64) -> ModelIet {
    let problem = shipped::preset("circle-seven-joints").expect("the preset is shipped").problem;
    let iet = Iet::new(&problem, 1).expect("the preset can be run");
    let mut world = iet.world().expect("the preset has a world");
    let space = Space::of(iet.chain());
    let goals = problem.goals.rows().map(<[f64]>::to_vec).collect();
    let spec = ModelSpec { noise, ..ModelSpec::default() };
    let mut run = ModelIet::new(spec, 1.0, space.clone(), goals, 1);
    let mut random = RandomStream::of_run(1, 0);
    for goal in (0..problem.goals.len()).cycle().take(trials) {
        let (mut joints, mut seen) = (space.home(), vec![0.0; 3]);
        space.uniform(&mut random, &mut joints);
        world.observe(&joints, &mut seen);
        run.tell(Trial { joints, observation: Some(seen), cells: None, goal });
    }
    run
}

#[divan::bench(args = [20, 40, 60])]
fn exact(bencher: Bencher<'_, '_>, trials: usize) {
    let mut run = after(trials, 0.0);
    bencher.bench_local(|| black_box(run.ask()));
}

#[divan::bench(args = [60])]
fn noisy(bencher: Bencher<'_, '_>, trials: usize) {
    let mut run = after(trials, 2.5);
    bencher.bench_local(|| black_box(run.ask()));
}
