//! Collision checks of a pose and of a motion: two arms, with and without the paper's wall.
//!
//! `cargo bench --bench collision`: times per check and the allocations of each; beside them the time of one evaluation of
//! wax and of paint.

use cgda::framework::collision::{CollisionModel, CollisionOptions, surface_obstacle};
use cgda::framework::constraint::Constraints;
use cgda::framework::method::whole_run::Space;
use cgda::framework::random::RandomStream;
use cgda::framework::robot::{Chain, RobotModel, RobotSpec};
use cgda::framework::world::{self, CoverageSpec, SurfaceView, World};
use cgda::reproduce::shipped;
use divan::{AllocProfiler, Bencher, black_box};

#[global_allocator]
static ALLOCATOR: AllocProfiler = AllocProfiler::system();

const ROBOTS: [&str; 2] = ["teo_right_arm", "seven_joint_arm"];
const POSES: usize = 256;

fn main() {
    divan::main();
}

/// The robot before the paper's wall, and random poses of it.
fn set_up(robot: &str) -> (CollisionModel, Vec<Vec<f64>>) {
    let urdf = match robot {
        "teo_right_arm" => include_str!("../examples/robots/teo_right_arm.urdf"),
        _ => include_str!("../examples/robots/seven_joint_arm.urdf"),
    };
    let model = RobotModel::from_urdf(urdf).expect("the robot is shipped");
    let chain = Chain::new(&model, &RobotSpec::default()).expect("the robot has one tip");
    let wall = CoverageSpec {
        origin_m: [0.6, -0.8, 0.32],
        column_step_m: [0.0, 0.2, 0.0],
        row_step_m: [0.0, 0.0, 0.2],
        columns: 4,
        rows: 4,
        radius_m: 0.13,
        resets: true,
        observes: SurfaceView::Percent,
    };
    let wall = surface_obstacle("wall", &wall, &chain, 0.01).expect("the wall is a plane");
    let built =
        CollisionModel::new(&model, &chain, &[wall], &CollisionOptions::default()).expect("the shapes are sound");
    let space = Space::of(&chain);
    let mut random = RandomStream::of_run(1, 0);
    let poses = (0..POSES).map(|_| {
        let mut joints = space.home();
        space.uniform(&mut random, &mut joints);
        joints
    });
    (built, poses.collect())
}

#[divan::bench(args = ROBOTS)]
fn collides(bencher: Bencher<'_, '_>, robot: &str) {
    let (model, poses) = set_up(robot);
    let mut workspace = model.workspace();
    let mut next = poses.iter().cycle();
    bencher.bench_local(|| black_box(model.collides(next.next().map_or(&[][..], |pose| pose), &mut workspace)));
}

#[divan::bench(args = ROBOTS)]
fn check(bencher: Bencher<'_, '_>, robot: &str) {
    let (model, poses) = set_up(robot);
    let mut workspace = model.workspace();
    let mut next = poses.iter().cycle();
    bencher.bench_local(|| {
        let found = model.check(next.next().map_or(&[][..], |pose| pose), &mut workspace);
        black_box(found.map(|clearance| clearance.distance_m))
    });
}

/// From home to the first random pose that the motion reaches without contact.
#[divan::bench(args = ROBOTS)]
fn free_motion(bencher: Bencher<'_, '_>, robot: &str) {
    let (model, poses) = set_up(robot);
    let mut workspace = model.workspace();
    let home = model.chain().home().to_vec();
    let is_free = |pose: &&Vec<f64>| model.check_motion(&home, pose, &mut model.workspace()).is_none();
    let to = poses.iter().find(is_free).expect("one of the motions is free");
    bencher.bench_local(|| black_box(model.check_motion(&home, to, &mut workspace).is_none()));
}

/// One evaluation of a shipped problem at a random pose, as the searches make it.
#[divan::bench(args = ["wax", "paint"])]
fn evaluation(bencher: Bencher<'_, '_>, preset: &str) {
    let (_, mut world, poses) = problem(preset);
    let mut shown = vec![0.0; world.features().len()];
    let mut next = poses.iter().cycle();
    bencher.bench_local(|| {
        world.observe(next.next().map_or(&[][..], |pose| pose), &mut shown);
        black_box(shown[0])
    });
}

/// The check that comes before it, scratch space included.
#[divan::bench(args = ["wax", "paint"])]
fn check_of_a_candidate(bencher: Bencher<'_, '_>, preset: &str) {
    let (constraints, _, poses) = problem(preset);
    let mut next = poses.iter().cycle();
    bencher.bench_local(|| black_box(constraints.allows(next.next().map_or(&[][..], |pose| pose))));
}

fn problem(preset: &str) -> (Constraints, Box<dyn World>, Vec<Vec<f64>>) {
    let mut problem = shipped::preset(preset).expect("the preset is shipped").problem;
    problem.execution.avoid_collisions();
    let model = RobotModel::from_urdf(&problem.urdf).expect("the robot is shipped");
    let chain = Chain::new(&model, &problem.robot).expect("the chain is shipped");
    let specs = &problem.execution.constraints;
    let constraints = Constraints::new(specs, &model, &problem.robot, &chain, &problem.world).expect("home is free");
    let world = world::build(&problem.world, &chain).expect("the world is shipped");
    let space = Space::of(&chain);
    let mut random = RandomStream::of_run(1, 0);
    let poses = (0..POSES).map(|_| {
        let mut joints = space.home();
        space.uniform(&mut random, &mut joints);
        joints
    });
    (constraints, world, poses.collect())
}
