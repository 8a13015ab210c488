//! A finished repetition as it is stored: run, goals, convergence, trajectory.

use crate::app::Timestamp;
use crate::app::id::{JobId, RunId, TrajectoryId};
use crate::app::jobs::ExecutionWork;
use crate::app::ports::NewRun;
use crate::app::runs::{ConvergencePoint, RunGoal, RunGoals, RunView};
use crate::evaluate::Simulation;
use crate::framework::execution::{ProblemError, RunResult};
use uuid::Uuid;

/// What is stored of `simulation`; `ids` name the run and its trajectory.
///
/// # Errors
/// [`ProblemError::Unfinished`] before the last goal has ended.
pub(super) fn finished_run(
    simulation: Simulation,
    work: &ExecutionWork,
    job: JobId,
    repetition: u32,
    ids: (Uuid, Uuid),
    created_at: Timestamp,
) -> Result<NewRun, ProblemError> {
    let joint_names: Vec<String> = simulation.chain().genes().iter().map(|gene| gene.name.clone()).collect();
    let result = simulation.finish()?;
    let id = RunId::from_uuid(ids.0);
    let _ = TrajectoryId::from_uuid(ids.1);
    let view = RunView {
        id: id.clone(),
        job,
        repetition,
        action: work.action.clone(),
        robot: work.robot.clone(),
        world: work.world.clone(),
        method: work.problem.execution.method.name().to_owned(),
        metric: work.problem.execution.metric,
        seed: result.seed,
        evaluations: result.evaluations,
        discrepancy: result.discrepancy,
        painted_percent: result.painted_percent,
        goals: u32::try_from(result.goals.len()).unwrap_or(u32::MAX),
        digest: result.digest.clone(),
        trajectory: None,
        trajectory_problem: Some("trajectories are not planned yet".to_owned()),
        created_at,
    };
    let goals = RunGoals {
        run: id,
        features: work.problem.goals.features().to_vec(),
        joint_names,
        goals: goals(&result, work),
    };
    Ok(NewRun { view, goals, convergence: convergence(&result), trajectory: None })
}

fn goals(result: &RunResult, work: &ExecutionWork) -> Vec<RunGoal> {
    let wanted = work.problem.goals.rows();
    let goals = result.goals.iter().zip(wanted).map(|(goal, wanted)| RunGoal {
        index: u32::try_from(goal.index).unwrap_or(u32::MAX),
        evaluations: goal.evaluations,
        discrepancy: goal.discrepancy,
        stop_reason: goal.stop_reason,
        joints: goal.joints.clone(),
        observation: goal.observation.clone(),
        goal: wanted.to_vec(),
    });
    goals.collect()
}

/// One point an improvement, in evaluations since the run began.
fn convergence(result: &RunResult) -> Vec<ConvergencePoint> {
    let mut before = 0;
    let mut points = Vec::new();
    for goal in &result.goals {
        let goal_index = u32::try_from(goal.index).unwrap_or(u32::MAX);
        points.extend(goal.trace.iter().map(|point| ConvergencePoint {
            goal_index,
            evaluations: before + point.evaluations,
            discrepancy: point.discrepancy,
        }));
        before += goal.evaluations;
        points.push(ConvergencePoint { goal_index, evaluations: before, discrepancy: goal.discrepancy });
    }
    points
}
