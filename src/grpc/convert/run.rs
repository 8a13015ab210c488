//! Conversion of runs.

use super::enumeration::Enumeration as _;
use super::{all, time};
use crate::app::model::{Convergence, ConvergencePoint, PathPose, RunGoal, RunGoals, RunTrials, RunView};
use crate::framework::execution::{AlongMotion, Difference, DiscrepancyEstimate, Judgement, Replay, RunVerdict};
use crate::framework::method::per_goal::Tally;
use crate::framework::method::whole_run::Trial;
use crate::framework::motion::JointStep;
use crate::grpc::proto;

impl From<RunView> for proto::Run {
    fn from(view: RunView) -> Self {
        let RunView {
            id,
            job,
            repetition,
            action,
            robot,
            world,
            method,
            metric,
            seed,
            evaluations,
            discrepancy,
            true_discrepancy,
            estimate,
            verdict,
            valid,
            provenance,
            painted_percent,
            goals,
            largest_step,
            replay,
            digest,
            trajectory,
            trajectory_problem,
            created_at,
        } = view;
        Self {
            id: id.into(),
            job: job.into(),
            repetition,
            action: action.into(),
            robot: robot.into(),
            world: world.into(),
            method,
            metric: metric.number(),
            seed,
            evaluations,
            discrepancy,
            true_discrepancy,
            estimate: estimate.map(Into::into),
            verdict: verdict.map(Into::into),
            valid,
            provenance: Some(provenance.into()),
            painted_percent,
            goals,
            largest_step: largest_step.map(Into::into),
            replay: replay.map(Into::into),
            digest,
            trajectory: trajectory.map(Into::into),
            trajectory_problem,
            created_at: Some(time(created_at)),
        }
    }
}

impl From<JointStep> for proto::JointStep {
    fn from(step: JointStep) -> Self {
        let JointStep { joint, goal_index, size } = step;
        Self { joint, goal_index, size }
    }
}

impl From<Replay> for proto::Replay {
    fn from(replay: Replay) -> Self {
        let Replay { discrepancy, painted_percent, along, largest_difference, agrees } = replay;
        Self {
            discrepancy,
            painted_percent,
            along: along.map(Into::into),
            largest_difference: largest_difference.map(Into::into),
            agrees,
        }
    }
}

impl From<AlongMotion> for proto::AlongMotion {
    fn from(along: AlongMotion) -> Self {
        let AlongMotion { discrepancy, painted_percent } = along;
        Self { discrepancy, painted_percent }
    }
}

impl From<Difference> for proto::Difference {
    fn from(difference: Difference) -> Self {
        let Difference { pose, goal, feature, claimed, replayed } = difference;
        Self { pose, goal, feature, claimed, replayed }
    }
}

impl From<DiscrepancyEstimate> for proto::DiscrepancyEstimate {
    fn from(estimate: DiscrepancyEstimate) -> Self {
        let DiscrepancyEstimate { value, lower, upper } = estimate;
        Self { value, lower, upper }
    }
}

impl From<RunVerdict> for proto::RunVerdict {
    fn from(verdict: RunVerdict) -> Self {
        let RunVerdict { outcome, reached, stopped_short, out_of_reach } = verdict;
        Self { outcome: outcome.number(), reached, stopped_short, out_of_reach }
    }
}

impl From<Judgement> for proto::Judgement {
    fn from(judgement: Judgement) -> Self {
        let Judgement { verdict, distance, tolerance } = judgement;
        Self { verdict: verdict.number(), distance, tolerance }
    }
}

impl From<Tally> for proto::Tally {
    fn from(tally: Tally) -> Self {
        let Tally { simulated, real, inherited, granule, penalised, worsened, rejected, repaired } = tally;
        Self { simulated, real, inherited, granule, penalised, worsened, rejected, repaired }
    }
}

impl From<RunGoals> for proto::RunGoals {
    fn from(view: RunGoals) -> Self {
        let RunGoals { run, features, joint_names, goals, path, painted_cells } = view;
        Self {
            run: run.into(),
            features: all(features),
            joint_names,
            goals: all(goals),
            path: all(path),
            painted_cells: painted_cells.unwrap_or_default().into(),
        }
    }
}

impl From<PathPose> for proto::PathPose {
    fn from(pose: PathPose) -> Self {
        let PathPose { joints, goals } = pose;
        Self { joints, goals }
    }
}

impl From<RunGoal> for proto::RunGoal {
    fn from(view: RunGoal) -> Self {
        let RunGoal {
            index,
            evaluations,
            discrepancy,
            stop_reason,
            judgement,
            joints,
            observation,
            goal,
            residual,
            winner,
            true_discrepancy,
            feasible,
            provenance,
        } = view;
        Self {
            index,
            evaluations,
            discrepancy,
            stop_reason: stop_reason.number(),
            judgement: judgement.map(Into::into),
            joints,
            observation,
            goal,
            residual,
            winner: winner.number(),
            true_discrepancy,
            feasible,
            provenance: Some(provenance.into()),
        }
    }
}

impl From<RunTrials> for proto::RunTrials {
    fn from(view: RunTrials) -> Self {
        let RunTrials { run, trials } = view;
        Self { run: run.into(), trials: all(trials) }
    }
}

impl From<Trial> for proto::Trial {
    fn from(trial: Trial) -> Self {
        let Trial { joints, observation, cells, goal } = trial;
        Self {
            joints,
            observed: observation.is_some(),
            observation: observation.unwrap_or_default(),
            cells: cells.unwrap_or_default().into(),
            goal: u32::try_from(goal).unwrap_or(u32::MAX),
        }
    }
}

impl From<Convergence> for proto::Convergence {
    fn from(view: Convergence) -> Self {
        let Convergence { run, points } = view;
        Self { run: run.into(), points: all(points) }
    }
}

impl From<ConvergencePoint> for proto::ConvergencePoint {
    fn from(point: ConvergencePoint) -> Self {
        let ConvergencePoint { goal_index, evaluations, discrepancy } = point;
        Self { goal_index, evaluations, discrepancy }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::framework::execution::Verdict;
    use crate::framework::method::per_goal::{Provenance, StopReason};
    use crate::framework::recognition::Metric;

    #[test]
    fn an_invalid_run_says_so() {
        let view = RunView {
            metric: Metric::SumOfFeatures,
            true_discrepancy: Some(6.5),
            valid: false,
            provenance: Tally { simulated: 1, rejected: 7, ..Tally::default() },
            ..RunView::sample()
        };
        let message = proto::Run::from(view.clone());
        assert!(!message.valid && proto::Run::from(RunView { valid: true, ..view }).valid);
        assert_eq!(message.true_discrepancy, Some(6.5));
        let tally = message.provenance.unwrap();
        assert_eq!((tally.simulated, tally.rejected, tally.repaired), (1, 7, 0));
        assert_eq!(message.metric(), proto::Metric::SumOfFeatures);
        let verdict = message.verdict.unwrap();
        assert_eq!(verdict.outcome(), proto::RunOutcome::GoalsMissed);
        assert_eq!((verdict.reached, verdict.stopped_short, verdict.out_of_reach), (6, 2, 1));
        let estimate = message.estimate.unwrap();
        assert_eq!((estimate.value, estimate.lower, estimate.upper), (0.3, 0.2, 0.5));
        let step = message.largest_step.unwrap();
        assert_eq!((step.joint.as_str(), step.goal_index, step.size), ("j2", 1, 0.4));
    }

    #[test]
    fn a_goal_says_why_it_ended_and_whether_its_joints_are_allowed() {
        let goal = RunGoal {
            index: 1,
            evaluations: 2,
            discrepancy: 3.5,
            stop_reason: StopReason::OutOfReach,
            judgement: Some(Judgement { verdict: Verdict::OutOfReach, distance: Some(0.1), tolerance: 0.05 }),
            joints: vec![0.1],
            observation: vec![0.2],
            goal: vec![0.3],
            residual: Some(0.1),
            winner: Provenance::Inherited,
            true_discrepancy: None,
            feasible: false,
            provenance: Tally { penalised: 9, ..Tally::default() },
        };
        let message = proto::RunGoal::from(goal);
        assert_eq!(message.stop_reason(), proto::StopReason::OutOfReach);
        let judgement = message.judgement.unwrap();
        assert_eq!(judgement.verdict(), proto::Verdict::OutOfReach);
        assert_eq!((judgement.distance, judgement.tolerance), (Some(0.1), 0.05));
        assert_eq!(message.winner(), proto::Provenance::Inherited);
        assert!(!message.feasible);
        assert_eq!(message.provenance.unwrap().penalised, 9);
    }

    #[test]
    fn a_lost_observation_is_not_an_empty_one() {
        let seen =
            Trial { joints: vec![0.1], observation: Some(vec![5.0]), cells: Some(vec![u64::MAX].into()), goal: 2 };
        let message = proto::Trial::from(seen.clone());
        assert!(message.observed);
        assert_eq!((message.observation.as_slice(), message.cells.as_slice()), (&[5.0][..], &[u64::MAX][..]));
        let lost = proto::Trial::from(Trial { observation: None, cells: None, ..seen });
        assert!(!lost.observed && lost.observation.is_empty() && lost.cells.is_empty());
        assert_eq!(lost.goal, 2);
    }
}
