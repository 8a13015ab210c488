//! The methods for surfaces on the shipped wall: bounds on evaluations, worlds that cannot be put back, runs resumed.

use crate::execution::{Iet, Problem, run, simulate};
use crate::method::MethodSpec;
use crate::method::per_goal::StopReason;
use crate::method::whole_run::ParticleSpec;
use crate::method::whole_run::model::tests::interrupted;
use crate::method::whole_run::{Axis, CoverSpec, NextTrial, SearchIet, Space, Trial, WholeRun};
use crate::preset;
use crate::world::{Surface, SurfaceView, WorldSpec};
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
    assert!(!run.outcomes()[3].reached);
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
