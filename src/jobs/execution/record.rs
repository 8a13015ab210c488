//! A finished repetition as stored: run, goals, convergence, trajectory.

use crate::app::model::{
    ConvergencePoint, ExecutionWork, JobId, PathPose, RunGoal, RunGoals, RunId, RunView, Timestamp, TrajectoryId,
    TrajectoryView,
};
use crate::app::ports::{KeptTrials, NewRun};
use crate::app::trajectories::{digest, points_of};
use crate::framework::distance::distance;
use crate::framework::execution::{self, Iet, ProblemError, RunResult};
use crate::framework::motion::{Motion, deliver};
use crate::framework::trajectory::CheckedTrajectory;
use uuid::Uuid;

/// Ids and time of a repetition's results.
#[derive(Debug, Clone, Copy)]
pub(super) struct Marks {
    pub run: Uuid,
    pub trajectory: Uuid,
    pub created_at: Timestamp,
}

/// Converts the finished run `iet` into the records to store.
///
/// # Errors
/// [`ProblemError::Unfinished`] before the last goal has ended.
pub(super) fn finished_run(
    iet: Iet,
    work: &ExecutionWork,
    job: &JobId,
    repetition: u32,
    marks: Marks,
) -> Result<NewRun, ProblemError> {
    let chain = iet.chain().clone();
    let trials = KeptTrials { setup_key: work.setup_key.clone(), trials: iet.log().to_vec() };
    let result = iet.finish()?;
    let id = RunId::from_uuid(marks.run);
    let Motion { poses, trajectory, verdict, pose_times_s, largest_step, replay, cells } =
        deliver(&work.problem, &result, &work.planning)?;
    let path: Vec<PathPose> = result.path.iter().zip(poses).map(path_pose).collect();
    let (trajectory, trajectory_problem) = match trajectory {
        Ok(planned) => (Some(stored_trajectory((&planned, pose_times_s), &path, &id, work, job, marks)), None),
        Err(why) => (None, Some(why.to_string())),
    };
    let view = RunView {
        id: id.clone(),
        job: job.clone(),
        repetition,
        action: work.action.clone(),
        robot: work.robot.clone(),
        world: work.world.clone(),
        method: work.problem.execution.method.name().to_owned(),
        metric: work.problem.execution.metric,
        seed: result.seed,
        evaluations: result.evaluations,
        discrepancy: result.discrepancy,
        true_discrepancy: result.true_discrepancy,
        estimate: result.estimate,
        verdict: Some(verdict),
        valid: result.valid && replay.agrees,
        provenance: result.tally,
        painted_percent: replay.painted_percent,
        goals: u32::try_from(result.goals.len()).unwrap_or(u32::MAX),
        largest_step,
        replay: Some(replay),
        digest: result.digest.clone(),
        trajectory: trajectory.as_ref().map(|trajectory| trajectory.id.clone()),
        trajectory_problem,
        created_at: marks.created_at,
    };
    let goals = RunGoals {
        run: id,
        features: work.problem.goals.features().to_vec(),
        joint_names: chain.genes().iter().map(|gene| gene.name.clone()).collect(),
        goals: goals(&result, work),
        path,
        painted_cells: cells,
    };
    Ok(NewRun { view, goals, convergence: convergence(&result), trajectory, trials })
}

fn path_pose((found, joints): (&execution::PathPose, Vec<f64>)) -> PathPose {
    PathPose { joints, goals: found.goals.iter().map(|&goal| u32::try_from(goal).unwrap_or(u32::MAX)).collect() }
}

/// Times at which the goals are served, in order of the goals.
fn goal_times_s(pose_times_s: &[f64], path: &[PathPose]) -> Vec<f64> {
    pose_times_s.iter().zip(path).flat_map(|(time_s, pose)| pose.goals.iter().map(|_| *time_s)).collect()
}

fn stored_trajectory(
    (planned, pose_times_s): (&CheckedTrajectory, Vec<f64>),
    path: &[PathPose],
    run: &RunId,
    work: &ExecutionWork,
    job: &JobId,
    marks: Marks,
) -> TrajectoryView {
    let points = points_of(planned);
    TrajectoryView {
        id: TrajectoryId::from_uuid(marks.trajectory),
        run: run.clone(),
        job: job.clone(),
        robot: work.robot.clone(),
        joint_names: planned.joints().to_vec(),
        fixed_joints: planned.fixed_joints().clone(),
        duration_s: planned.duration_s(),
        goal_times_s: goal_times_s(&pose_times_s, path),
        pose_times_s,
        tightest: planned.tightest().to_vec(),
        notes: planned.notes().to_vec(),
        sha256: digest(&points),
        points,
        created_at: marks.created_at,
    }
}

fn goals(result: &RunResult, work: &ExecutionWork) -> Vec<RunGoal> {
    let wanted = work.problem.goals.rows();
    let goals = result.goals.iter().zip(wanted).map(|(goal, wanted)| RunGoal {
        index: u32::try_from(goal.index).unwrap_or(u32::MAX),
        evaluations: goal.evaluations,
        discrepancy: goal.discrepancy,
        stop_reason: goal.stop_reason,
        judgement: Some(goal.judgement),
        joints: goal.joints.clone(),
        observation: goal.observation.clone(),
        goal: wanted.to_vec(),
        residual: Some(distance(&goal.observation, wanted)),
        winner: goal.provenance,
        true_discrepancy: goal.true_discrepancy,
        feasible: goal.feasible,
        provenance: goal.tally,
    });
    goals.collect()
}

/// Rejects NaN and infinite values of a goal: JSON cannot represent them.
///
/// # Errors
/// A sentence with the number and the remedy.
pub(super) fn check_finite(goal: u32, discrepancy: f64, observation: &[f64]) -> Result<(), String> {
    let remedy = "its squares must stay below 1e308: use a unit with smaller numbers for demonstrations and world";
    if let Some(value) = observation.iter().find(|value| !value.is_finite()) {
        return Err(format!("an observation of goal {goal} is not finite ({value}): {remedy}"));
    }
    if !discrepancy.is_finite() {
        return Err(format!("the discrepancy of goal {goal} is not finite ({discrepancy}): {remedy}"));
    }
    Ok(())
}

/// One point per improvement, in evaluations since the run began.
fn convergence(result: &RunResult) -> Vec<ConvergencePoint> {
    let mut before = 0;
    let mut points = Vec::new();
    for goal in &result.goals {
        let goal_index = u32::try_from(goal.index).unwrap_or(u32::MAX);
        let known = goal.trace.iter().filter(|point| point.discrepancy.is_finite());
        points.extend(known.map(|point| ConvergencePoint {
            goal_index,
            evaluations: before + point.evaluations,
            discrepancy: point.discrepancy,
        }));
        before += goal.evaluations;
        points.push(ConvergencePoint { goal_index, evaluations: before, discrepancy: goal.discrepancy });
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_finite_is_told_with_its_goal_and_the_remedy() {
        assert_eq!(check_finite(3, 1e300, &[0.0, -1e308]), Ok(()));
        let told = check_finite(3, f64::INFINITY, &[1.0]).unwrap_err();
        assert!(told.starts_with("the discrepancy of goal 3 is not finite (inf): "), "{told}");
        let told = check_finite(0, f64::NAN, &[1.0, f64::NAN]).unwrap_err();
        assert!(told.starts_with("an observation of goal 0 is not finite (NaN): "), "{told}");
    }
}
