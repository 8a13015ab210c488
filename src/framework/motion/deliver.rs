//! Delivery of a finished run: its motion, planned, checked and replayed.

use super::equivalent::nearest;
use super::error::MotionError;
use super::step::{JointStep, largest_step};
use super::way;
use crate::CellSet;
use crate::collision::CollisionModel;
use crate::execution::{
    Moves, Problem, ProblemError, Replay, Replayed, RunResult, RunVerdict, SAMPLES_PER_MOVE, replay,
};
use crate::robot::{Chain, RobotModel};
use crate::trajectory::{CheckedTrajectory, PlanSpec, Waypoint, plan};

/// The motion of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// Poses of the motion, one per pose of the run's path; joints in gene order, rad or m.
    pub poses: Vec<Vec<f64>>,
    /// The trajectory from home through the poses, or the reason why there is none.
    pub trajectory: Result<CheckedTrajectory, MotionError>,
    /// Times at which the poses are reached, seconds; empty if there is no trajectory.
    pub pose_times_s: Vec<f64>,
    /// Largest move of one joint between successive poses; `None` if there are no poses.
    pub largest_step: Option<JointStep>,
    /// The effect of the motion, beside that which the run claims.
    pub replay: Replay,
    /// The verdict on the run, invalid if the replay differs.
    pub verdict: RunVerdict,
    /// The cells that the motion covers, painting at its poses; `None` unless the world is a surface.
    pub cells: Option<CellSet>,
}

/// Joins the path of `result` into a motion, checks it and replays it in the world of `problem`. If the problem's
/// constraints ask for it, the motion leads around whatever the straight one would touch.
///
/// # Errors
/// [`ProblemError`] if the result does not belong to the problem.
pub fn deliver(problem: &Problem, result: &RunResult, planning: &PlanSpec) -> Result<Motion, ProblemError> {
    let model = RobotModel::from_urdf(&problem.urdf)?;
    let chain = Chain::new(&model, &problem.robot)?;
    let collisions = match problem.execution.collision_free() {
        Some(spec) => Some(spec.model(&model, &chain, &problem.world)?),
        None => None,
    };
    let found: Vec<Vec<f64>> = result.path.iter().map(|pose| pose.joints.clone()).collect();
    let poses = nearest(&chain, chain.home(), &found);
    let planner = Planner { chain: &chain, collisions: collisions.as_ref(), interval_s: problem.goals.interval_s() };
    let (mut trajectory, pose_times_s) = match planner.plan(result, &poses, planning) {
        Ok((trajectory, times_s)) => (Ok(trajectory), times_s),
        Err(error) => (Err(error), Vec::new()),
    };
    let between = trajectory.as_ref().map_or_else(|_| Vec::new(), |planned| between(planned, &pose_times_s));
    let Replayed { replay, cells } = replay(problem, result, Moves { poses: &poses, between: &between })?;
    if let (false, Some(difference)) = (replay.agrees, &replay.largest_difference) {
        trajectory = Err(MotionError::Replay(difference.to_string()));
    }
    let largest_step = largest_step(&chain, &result.path, &poses);
    let verdict = result.verdict().replayed(replay.agrees);
    Ok(Motion { poses, trajectory, pose_times_s, largest_step, replay, verdict, cells })
}

struct Planner<'a> {
    chain: &'a Chain,
    collisions: Option<&'a CollisionModel>,
    interval_s: Option<f64>,
}

impl Planner<'_> {
    /// The trajectory from home through `poses`, and the times at which they are reached.
    fn plan(
        &self,
        result: &RunResult,
        poses: &[Vec<f64>],
        planning: &PlanSpec,
    ) -> Result<(CheckedTrajectory, Vec<f64>), MotionError> {
        let home = self.chain.home();
        let (way, mut notes) = match self.collisions {
            Some(model) => {
                let way = way::around(model, home, &result.path, poses, result.seed)?;
                let note = format!("free of collisions; {} of {} moves are detours", way.detours, poses.len());
                (way, vec![note])
            }
            None => (way::straight(&result.path, poses), vec!["collisions are not checked".to_owned()]),
        };
        let plan = |spec: &PlanSpec| plan(self.chain, home, &way.waypoints, self.interval_s, spec);
        let mut trajectory = plan(planning)?;
        if let Some(contact) =
            self.collisions.filter(|_| planning.blend).and_then(|model| way::contact(model, &trajectory))
        {
            notes.push(format!("the arm stops at the goals: passing them, {contact}"));
            trajectory = plan(&PlanSpec { blend: false, ..planning.clone() })?;
        }
        let pose_times_s = pose_times_s(&trajectory, &way.waypoints);
        Ok((trajectory.noting(notes), pose_times_s))
    }
}

fn pose_times_s(trajectory: &CheckedTrajectory, way: &[Waypoint]) -> Vec<f64> {
    let reached = trajectory.waypoint_times_s().iter().zip(way);
    reached.filter(|(_, waypoint)| waypoint.rest).map(|(time_s, _)| *time_s).collect()
}

/// For each pose but the first, poses at even times on the way to it, which end with it.
fn between(trajectory: &CheckedTrajectory, pose_times_s: &[f64]) -> Vec<Vec<Vec<f64>>> {
    let samples = |ends: &[f64]| {
        let at = |step: usize| {
            let share = step as f64 / SAMPLES_PER_MOVE as f64;
            trajectory.positions_at(ends[0] + (ends[1] - ends[0]) * share)
        };
        (1..=SAMPLES_PER_MOVE).map(at).collect()
    };
    pose_times_s.windows(2).map(samples).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::execution::run;
    use crate::preset::shipped;

    #[test]
    fn a_motion_passes_every_pose_of_the_path_and_shows_its_effect() {
        for (name, method) in [("wax", "model"), ("paint", "particle"), ("paint", "search")] {
            let mut preset = shipped(name).unwrap();
            assert!(preset.select_method(method));
            let result = run(&preset.problem, 1).unwrap();
            let motion = deliver(&preset.problem, &result, &PlanSpec::default()).unwrap();
            let trajectory = motion.trajectory.unwrap();
            let reached: Vec<&[f64]> =
                trajectory.points().iter().filter(|p| p.waypoint.is_some()).map(|p| p.positions.as_slice()).collect();
            assert_eq!(reached, motion.poses.iter().map(Vec::as_slice).collect::<Vec<_>>());
            assert!(motion.replay.agrees && motion.replay.along.is_some());
            if let Some(claimed) = result.painted_percent {
                assert_eq!(motion.replay.painted_percent, Some(claimed), "{name} {method}");
            }
        }
    }

    #[test]
    fn a_motion_that_does_not_do_what_the_run_claims_is_not_delivered() {
        let mut preset = shipped("paint").unwrap();
        assert!(preset.select_method("particle"));
        let mut result = run(&preset.problem, 1).unwrap();
        result.path.remove(4);
        let motion = deliver(&preset.problem, &result, &PlanSpec::default()).unwrap();
        let error = motion.trajectory.unwrap_err().to_string();
        assert!(error.starts_with("the replay differs: at pose "), "{error}");
        assert!(error.contains("the run claims painted = "), "{error}");
    }
}
