//! Runs.

use super::all;
use crate::app::model::{RunGoal, RunGoals, RunTrials, RunView};
use crate::framework::method::per_goal::StopReason;
use crate::grpc::proto;

impl From<RunView> for proto::Run {
    fn from(view: RunView) -> Self {
        Self {
            id: view.id.into(),
            job: view.job.into(),
            repetition: view.repetition,
            action: view.action.into(),
            robot: view.robot.into(),
            world: view.world.into(),
            method: view.method,
            metric: proto::Metric::from(view.metric) as i32,
            seed: view.seed,
            evaluations: view.evaluations,
            discrepancy: view.discrepancy,
            painted_percent: view.painted_percent,
            goals: view.goals,
            digest: view.digest,
            trajectory: view.trajectory.map(Into::into),
            trajectory_problem: view.trajectory_problem,
            created_at_ms: view.created_at.0,
        }
    }
}

impl From<RunGoals> for proto::RunGoals {
    fn from(view: RunGoals) -> Self {
        Self {
            run: view.run.into(),
            features: all(view.features),
            joint_names: view.joint_names,
            goals: all(view.goals),
        }
    }
}

impl From<RunTrials> for proto::RunTrials {
    fn from(view: RunTrials) -> Self {
        let trials = view.trials.into_iter().map(|trial| proto::Trial {
            joints: trial.joints,
            observation: trial.observation.unwrap_or_default(),
            goal: u32::try_from(trial.goal).unwrap_or(u32::MAX),
        });
        Self { run: view.run.into(), trials: trials.collect() }
    }
}

/// The name it has in JSON.
pub fn stop_reason(reason: StopReason) -> String {
    match reason {
        StopReason::Stagnation => "stagnation",
        StopReason::Target => "target",
        StopReason::Tolerance => "tolerance",
        StopReason::MaxEvaluations => "max_evaluations",
        StopReason::OutOfReach => "out_of_reach",
        StopReason::Infeasible => "infeasible",
    }
    .to_owned()
}

impl From<RunGoal> for proto::RunGoal {
    fn from(goal: RunGoal) -> Self {
        Self {
            index: goal.index,
            evaluations: goal.evaluations,
            discrepancy: goal.discrepancy,
            stop_reason: stop_reason(goal.stop_reason),
            joints: goal.joints,
            observation: goal.observation,
            goal: goal.goal,
            residual: goal.residual,
        }
    }
}
