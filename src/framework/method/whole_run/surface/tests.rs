//! The methods for surfaces on the shipped wall: bounds on evaluations, worlds that cannot be put back, runs resumed.

use crate::execution::{Iet, Problem, run, simulate};
use crate::generalization::Goals;
use crate::method::MethodSpec;
use crate::method::per_goal::StopReason;
use crate::method::whole_run::ParticleSpec;
use crate::method::whole_run::model::tests::interrupted;
use crate::method::whole_run::{Axis, CoverSpec, NextTrial, SearchIet, Space, Trial, WholeRun};
use crate::preset;
use crate::world::{CoverageSpec, DisturbanceSpec, Surface, SurfaceView, WorldSpec};
use proptest::prelude::*;
use rstest::rstest;

fn search(poses: u32, max_evaluations: u32) -> MethodSpec {
    MethodSpec::Search(CoverSpec { max_evaluations: Some(max_evaluations), poses, ..CoverSpec::default() })
}

fn particle(particles: u32, poses: u32, max_evaluations: u32) -> MethodSpec {
    MethodSpec::Particle(ParticleSpec {
        max_evaluations: Some(max_evaluations),
        particles,
        poses,
        ..ParticleSpec::default()
    })
}

fn paint(method: MethodSpec, resets: bool, observes: SurfaceView) -> Problem {
    let mut problem = preset::shipped("paint").unwrap().problem;
    problem.execution.method = method;
    if let WorldSpec::Coverage(surface) = &mut problem.world {
        (surface.resets, surface.observes) = (resets, observes);
    }
    problem
}

#[rstest]
fn a_resumed_run_gives_the_same_bits(
    #[values(search(256, 30), particle(6, 96, 24))] method: MethodSpec,
    #[values(true, false)] resets: bool,
    #[values(SurfaceView::Percent, SurfaceView::Cells)] observes: SurfaceView,
) {
    let problem = paint(method, resets, observes);
    assert_eq!(interrupted(&problem, 3, 5), run(&problem, 3).unwrap());
}

#[rstest]
fn all_that_is_done_to_a_surface_that_cannot_be_put_back_stays(
    #[values(search(256, 30), particle(6, 96, 24))] method: MethodSpec,
) {
    let problem = paint(method, false, SurfaceView::Percent);
    let mut iet = Iet::new(&problem, 8).unwrap();
    let mut world = iet.world().unwrap();
    let mut trials = 0;
    while !iet.is_finished() {
        assert_eq!(iet.prefix().count(), trials);
        simulate(&mut iet, world.as_mut(), 1).unwrap();
        trials += 1;
    }
    let result = iet.finish().unwrap();
    assert_eq!(result.evaluations, trials as u64);
    let shown: Vec<f64> = result.goals.iter().map(|goal| goal.observation[0]).collect();
    assert!(shown.is_sorted() && result.painted_percent == shown.last().copied(), "{shown:?}");
    for goal in &result.goals {
        assert_eq!(
            goal.stop_reason == StopReason::Tolerance,
            (goal.observation[0] - 6.25 * goal.index as f64).abs() < 3.0
        );
    }
}

/// A wall of many cells, wherever it is: what is claimed is what the accepted poses paint in a fresh world, every accepted
/// trial adds to it, and there is progress.
fn walls() -> impl Strategy<Value = CoverageSpec> {
    let step = 0.02..0.06_f64;
    let tilt = || -0.015..0.015_f64;
    (step.clone(), step, 8..24_u32, 8..24_u32, tilt(), tilt(), any::<bool>()).prop_map(
        |(column, row, columns, rows, forward, aside, seen)| CoverageSpec {
            origin_m: [0.55, -0.5 - 0.5 * column * f64::from(columns), 0.6 - 0.5 * row * f64::from(rows)],
            column_step_m: [forward, column, 0.0],
            row_step_m: [aside, 0.0, row],
            columns,
            rows,
            radius_m: 0.07,
            resets: true,
            observes: if seen { SurfaceView::Cells } else { SurfaceView::Percent },
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 6, ..ProptestConfig::default() })]
    #[test]
    fn what_is_claimed_is_painted_and_there_is_progress(wall in walls(), goals in 2..30_u32, seed in 0..1000_u64) {
        for (method, least) in [(search(512, 150), 5.0), (particle(20, 256, 30), 20.0)] {
            let mut problem = paint(method, true, SurfaceView::Percent);
            let share = |k| vec![100.0 * f64::from(k) / f64::from(goals - 1)];
            problem.goals = Goals::new(problem.goals.features().to_vec(), &(0..goals).map(share).collect::<Vec<_>>()).unwrap();
            problem.world = WorldSpec::Coverage(wall.clone());
            let mut iet = Iet::new(&problem, seed).unwrap();
            let mut world = iet.world().unwrap();
            simulate(&mut iet, world.as_mut(), u64::MAX).unwrap();
            world.reset();
            let mut seen = vec![0.0; world.features().len()];
            let mut before = 0.0;
            for pose in iet.prefix() {
                world.commit(pose, &mut seen);
                prop_assert!(seen[0] > before, "a pose that adds nothing was accepted");
                before = seen[0];
            }
            prop_assert_eq!(iet.finish().unwrap().painted_percent, Some(before));
            prop_assert!(before > least, "{} %", before);
        }
    }
}

/// The wall as 20 x 30 cells, of which the tool covers several at once.
fn fine(mut problem: Problem) -> Problem {
    if let WorldSpec::Coverage(wall) = &mut problem.world {
        (wall.columns, wall.rows, wall.radius_m) = (30, 20, 0.06);
        (wall.origin_m, wall.column_step_m, wall.row_step_m) = ([0.6, -0.7, 0.4], [0.0, 0.014, 0.0], [0.0, 0.0, 0.02]);
    }
    problem
}

#[test]
fn a_resumed_walk_gives_the_same_bits() {
    let problem = fine(paint(search(256, 60), true, SurfaceView::Percent));
    let whole = run(&problem, 3).unwrap();
    assert!(whole.painted_percent > Some(10.0), "{:?} %", whole.painted_percent);
    assert_eq!(interrupted(&problem, 3, 45), whole);
}

#[test]
fn a_wall_of_600_cells_is_painted_by_few_poses_of_several_cells() {
    let mut problem = fine(paint(MethodSpec::Particle(ParticleSpec::default()), true, SurfaceView::Percent));
    problem.execution.reality =
        Some(DisturbanceSpec { link_share: 0.05, base_shift_m: 0.02, ..DisturbanceSpec::default() });
    let result = run(&problem, 3).unwrap();
    assert!(result.painted_percent >= Some(95.0), "{:?} %", result.painted_percent);
    assert!(result.evaluations < 100, "{} evaluations", result.evaluations);
}

#[test]
fn the_start_shows_the_first_goal_and_goals_between_cells_are_served_by_the_nearest() {
    let mut problem = paint(MethodSpec::Particle(ParticleSpec::default()), true, SurfaceView::Percent);
    let goals = [1.0, 8.0, 20.0, 29.0, 62.0, 100.0].map(|share| vec![share]);
    problem.goals = Goals::new(problem.goals.features().to_vec(), &goals).unwrap();
    let result = run(&problem, 5).unwrap();
    let shown: Vec<f64> = result.goals.iter().map(|goal| goal.observation[0]).collect();
    assert_eq!(shown, [0.0, 6.25, 18.75, 31.25, 62.5, 100.0]);
    assert!(result.goals.iter().all(|goal| goal.stop_reason == StopReason::Tolerance));
}

#[test]
fn a_search_of_one_goal_at_a_time_refuses_what_cannot_be_put_back() {
    let mut problem = preset::shipped("paint").unwrap().problem;
    if let WorldSpec::Coverage(surface) = &mut problem.world {
        surface.resets = false;
    }
    let error = Iet::new(&problem, 1).err().unwrap().to_string();
    assert!(error.contains("sst") && error.contains("particle or search"), "{error}");
}

fn row_of_four(resets: bool) -> Surface {
    Surface { columns: 4, rows: 1, resets, cells_seen: true }
}

/// A strip of four cells along one joint, a quarter of its range each.
fn strip(q: f64) -> u64 {
    1 << [0.25, 0.5, 0.75].iter().filter(|&&edge| q >= edge).count()
}

#[test]
fn a_gain_of_two_is_refused_while_the_world_can_be_put_back() {
    let axis = Axis { lower: 0.0, upper: 1.0, home: 0.0, revolute: true };
    let space = Space::new(vec![axis]);
    let goals: Vec<Vec<f64>> = (0..5).map(|k| vec![25.0 * f64::from(k)]).collect();
    let spec = CoverSpec { poses: 64, ..CoverSpec::default() };
    let mut run = SearchIet::new(&spec, row_of_four(true), &space, &goals, 1);
    let mut told = |gained: u64| {
        let NextTrial::Execute { joints, goal } = run.ask() else { panic!("not over") };
        let observation = Some(vec![25.0 * f64::from(gained.count_ones())]);
        run.tell(Trial { joints, observation, cells: Some(vec![gained].into()), goal });
        run.accepted().len()
    };
    assert_eq!([told(0b0011), told(0b0001), told(0b0001), told(0b0111), told(0b0011)], [0, 1, 1, 1, 2]);
    assert_eq!(run.outcomes()[3].distance, 25.0);
}

#[test]
fn seen_cells_lead_to_the_others() {
    let axis = Axis { lower: 0.0, upper: 1.0, home: 0.0, revolute: true };
    let space = Space::new(vec![axis]);
    let goals: Vec<Vec<f64>> = (0..5).map(|k| vec![25.0 * f64::from(k)]).collect();
    let spec = CoverSpec { poses: 64, ..CoverSpec::default() };
    let mut run = SearchIet::new(&spec, row_of_four(false), &space, &goals, 1);
    let mut painted = 0;
    while let NextTrial::Execute { joints, goal } = run.ask() {
        painted |= strip(joints[0]);
        let observation = Some(vec![25.0 * f64::from(painted.count_ones())]);
        run.tell(Trial { joints, observation, cells: Some(vec![painted].into()), goal });
    }
    assert!(painted == 0b1111 && run.log().len() <= 8, "{:?}", run.log());
}

#[test]
fn paint_takes_a_trial_a_square_with_a_simulator() {
    let result = run(&paint(particle(80, 1024, 400), true, SurfaceView::Percent), 5000).unwrap();
    assert!(result.evaluations <= 20, "{} evaluations", result.evaluations);
    assert_eq!(result.painted_percent, Some(100.0));
}

#[test]
fn paint_takes_a_few_dozen_with_the_cells_seen_and_nothing_known() {
    let result = run(&paint(search(2048, 45), true, SurfaceView::Cells), 5001).unwrap();
    assert!(result.painted_percent >= Some(93.75), "{:?} %", result.painted_percent);
}
