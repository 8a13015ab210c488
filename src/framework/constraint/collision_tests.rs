//! Promises of `collision_free`: no pose in collision is executed or wins under any method and handling, and what cannot
//! be checked is refused by name.

use super::fixtures;
use super::*;
use crate::collision::{Obstacle, ObstacleShape, SphereObstacle};
use crate::execution::{Iet, Observations, Problem};
use crate::method::per_goal::{Batch, Provenance};
use crate::preset::shipped;
use crate::robot::{Chain, RobotModel};
use rstest::rstest;
use serde_json::{Value, json};

/// The shipped wall or wax with the robot's own shapes, and the wall as a solid.
fn problem(preset: &str, method: Value, handling: Value) -> Problem {
    let mut problem = shipped(preset).unwrap().problem;
    problem.execution.method = serde_json::from_value(method).unwrap();
    problem.execution.handling = serde_json::from_value(handling).unwrap();
    problem.execution.avoid_collisions();
    problem
}

fn constraints(problem: &Problem) -> Result<Constraints, ConstraintError> {
    let model = RobotModel::from_urdf(&problem.urdf).unwrap();
    let chain = Chain::new(&model, &problem.robot).unwrap();
    Constraints::new(&problem.execution.constraints, &model, &problem.robot, &chain, &problem.world)
}

/// All that was executed until the run ended or `most` executions.
fn executed(problem: &Problem, most: usize) -> Vec<Vec<f64>> {
    let mut iet = Iet::new(problem, 1).unwrap();
    let mut world = iet.world().unwrap();
    let mut scratch = vec![0.0; iet.world_features()];
    let mut batch = Batch::new(iet.chain().len(), 8);
    let mut all = Vec::new();
    while !iet.is_finished() && all.len() < most {
        world.reset();
        iet.prefix().for_each(|pose| world.commit(pose, &mut scratch));
        batch.clear(8);
        iet.ask(&mut batch);
        let mut observations = Observations::new(iet.chain().len(), scratch.len(), Provenance::Simulated);
        for (id, joints) in batch.iter() {
            world.observe(joints, observations.observed(id, joints));
            all.push(joints.to_vec());
        }
        iet.tell(&observations).unwrap();
    }
    all
}

#[rstest]
#[case::rejecting(json!({"strategy": "rejecting"}))]
#[case::repairing(json!({"strategy": "repairing"}))]
#[case::operators(json!({"strategy": "operators"}))]
#[case::death(json!({"strategy": "penalty", "penalty": {"kind": "death"}}))]
#[case::soft(json!({"strategy": "penalty", "penalty": {"kind": "static", "weight": 1.0}}))]
fn no_handling_executes_a_pose_in_collision(
    #[case] handling: Value,
    #[values("sst", "de", "cma_es", "pso")] method: &str,
    #[values("wax", "paint")] preset: &str,
) {
    let problem = problem(preset, json!({"name": method}), handling);
    let found = constraints(&problem).unwrap();
    let all = executed(&problem, 1500);
    assert!(!all.is_empty() && all.iter().all(|pose| !found.forbids(pose)));
    let mut unchecked = problem;
    unchecked.execution.constraints.clear();
    assert!(
        executed(&unchecked, 1500).iter().any(|pose| found.forbids(pose)),
        "without the constraint some poses collide"
    );
}

#[rstest]
#[case("paint", json!({"name": "particle", "particles": 8, "poses": 128}))]
#[case("paint", json!({"name": "search", "poses": 512}))]
#[case("wax", json!({"name": "model"}))]
#[case("wax", json!({"name": "broyden"}))]
fn no_method_that_plans_the_run_executes_a_pose_in_collision(#[case] preset: &str, #[case] method: Value) {
    let problem = problem(preset, method, json!({"strategy": "rejecting"}));
    let found = constraints(&problem).unwrap();
    let all = executed(&problem, 60);
    assert!(!all.is_empty() && all.iter().all(|pose| found.allows(pose)));
}

#[test]
fn the_violation_is_the_depth_and_0_exactly_if_free() {
    let problem = problem("paint", json!({"name": "sst"}), json!({"strategy": "rejecting"}));
    let found = constraints(&problem).unwrap();
    let violation = |pitch: f64| {
        let joints = [pitch, 0.0, 0.0];
        found.violations(&Proposal { joints: &joints, origins: [None; 2], previous: None }).sum::<f64>()
    };
    let depths: Vec<f64> = (0..=15).map(|tenth| violation(f64::from(tenth) / 10.0)).collect();
    assert_eq!(depths[0].to_bits(), 0.0_f64.to_bits(), "the arm hangs down at home");
    assert!(depths[15] > 0.05, "it reaches through the wall when it is raised: {depths:?}");
    for (tenth, depth) in depths.iter().enumerate() {
        assert_eq!(*depth > 0.0, found.forbids(&[tenth as f64 / 10.0, 0.0, 0.0]), "{depths:?}");
    }
}

/// A ball around the hand at home.
fn ball() -> Obstacle {
    let arm = fixtures::arm();
    let center_m = crate::robot::tool_position(&arm.chain, arm.chain.home()).into();
    Obstacle { name: "ball".to_owned(), shape: ObstacleShape::Sphere(SphereObstacle { center_m, radius_m: 0.05 }) }
}

#[test]
fn a_home_pose_in_collision_is_refused_with_the_pair_the_distance_and_the_remedy() {
    let arm = fixtures::arm();
    let spec = CollisionFreeSpec { obstacles: vec![ball()], ..CollisionFreeSpec::default() };
    let new = |spec: &CollisionFreeSpec| {
        let specs = [ConstraintSpec::CollisionFree(spec.clone())];
        Constraints::new(&specs, &arm.model, &arm.robot, &arm.chain, &fixtures::world()).map(drop)
    };
    let error = new(&spec).unwrap_err().to_string();
    for part in ["\"ball\"", "0.0000 m", "margin of 0.001 m", "another home pose", "exclude the pair"] {
        assert!(error.contains(part), "{part}: {error}");
    }
    let with_ball = |link: &str| [link.to_owned(), "ball".to_owned()];
    let excluded = ["object", "hand", "forearm", crate::collision::TOOL].map(with_ball).to_vec();
    assert_eq!(new(&CollisionFreeSpec { excluded, ..spec.clone() }), Ok(()));
    let twice = [ConstraintSpec::CollisionFree(spec), ConstraintSpec::CollisionFree(CollisionFreeSpec::default())];
    let error = Constraints::new(&twice, &arm.model, &arm.robot, &arm.chain, &fixtures::world()).unwrap_err();
    assert_eq!(error, ConstraintError::SecondCollisionFree);
}

#[test]
fn a_wrong_member_is_named_by_its_path() {
    let wrong = json!({"kind": "collision_free", "margin": 0.1});
    let error = serde_json::from_value::<ConstraintSpec>(wrong).unwrap_err().to_string();
    assert!(error.contains("unknown field `margin`"), "{error}");
    let all: ConstraintSpec = serde_json::from_value(json!({"kind": "collision_free"})).unwrap();
    assert_eq!(all, ConstraintSpec::CollisionFree(CollisionFreeSpec::default()));
}

#[test]
fn the_solid_wall_leaves_every_cell_paintable_but_not_from_behind() {
    let problem = problem("paint", json!({"name": "sst"}), json!({"strategy": "rejecting"}));
    let found = constraints(&problem).unwrap();
    let model = RobotModel::from_urdf(&problem.urdf).unwrap();
    let chain = Chain::new(&model, &problem.robot).unwrap();
    let mut world = crate::world::build(&problem.world, &chain).unwrap();
    let mut random = crate::random::RandomStream::new(1, 1);
    let mut shown = vec![0.0; 1];
    for _ in 0..60_000 {
        let pose: Vec<f64> = chain.genes().iter().map(|gene| random.between(gene.lower, gene.upper)).collect();
        let tool = crate::robot::tool_position(&chain, &pose);
        if found.allows(&pose) {
            world.commit(&pose, &mut shown);
            let is_beside = !(-0.93..=-0.07).contains(&tool.y) || !(0.19..=1.05).contains(&tool.z);
            assert!(tool.x < 0.6 || is_beside, "{pose:?} is behind the wall: {tool:?}");
        }
    }
    assert_eq!(shown, [100.0]);
}
