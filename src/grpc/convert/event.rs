//! Conversion of job events.

use super::enumeration::Enumeration as _;
use super::time;
use crate::app::model::{EventData, JobEvent};
use crate::grpc::proto;
use proto::job_event::Data;

impl From<JobEvent> for proto::JobEvent {
    fn from(event: JobEvent) -> Self {
        let JobEvent { seq, job, at, data } = event;
        Self { seq, job: job.into(), at: Some(time(at)), data: Some(self::data(data)) }
    }
}

fn data(data: EventData) -> Data {
    match data {
        EventData::State { state, reason, attempt } => {
            Data::State(proto::JobStateChanged { state: state.number(), reason, attempt })
        }
        EventData::Progress { progress } => Data::Progress(progress.into()),
        EventData::Resync => Data::Resync(proto::JobResync {}),
        EventData::Goal { goal } => Data::Goal(goal.into()),
        EventData::Trial { trial } => Data::Trial(trial.into()),
        EventData::Run { run, trajectory, repetition, seed, evaluations, discrepancy, painted_percent, digest } => {
            Data::Run(proto::RunFinished {
                run: run.into(),
                trajectory: trajectory.map(Into::into),
                repetition,
                seed,
                evaluations,
                discrepancy,
                painted_percent,
                digest,
            })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::model::{GoalProgress, JobId, JobProgress, RunId, Timestamp, TrialProgress};
    use crate::framework::execution::{Judgement, Verdict};
    use crate::framework::job::State;
    use crate::framework::method::per_goal::StopReason;
    use uuid::Uuid;

    fn converted(data: EventData) -> Data {
        let job = JobId::from_uuid(Uuid::from_u128(1));
        let message = proto::JobEvent::from(JobEvent { seq: 7, job, at: Timestamp(2_000), data });
        assert_eq!((message.seq, message.at.map(|at| at.seconds)), (7, Some(2)));
        message.data.unwrap()
    }

    #[test]
    fn every_kind_of_event_stays_what_it_is() {
        let changed = EventData::State { state: State::Failed, reason: Some("why".to_owned()), attempt: 2 };
        let Data::State(changed) = converted(changed) else { panic!("a change of state") };
        assert_eq!((changed.state(), changed.attempt), (proto::JobState::Failed, 2));

        let progress = JobProgress { goal_evaluations: 3, total_evaluations: 4, ..JobProgress::default() };
        let Data::Progress(progress) = converted(EventData::Progress { progress }) else { panic!("progress") };
        assert_eq!((progress.goal_evaluations, progress.total_evaluations), (3, 4));

        let goal = GoalProgress {
            repetition: 1,
            index: 2,
            evaluations: 3,
            discrepancy: 4.5,
            stop_reason: StopReason::MaxEvaluations,
            judgement: Some(Judgement { verdict: Verdict::StoppedShort, distance: Some(0.3), tolerance: 0.2 }),
            joints: vec![0.1],
            observation: vec![0.2],
            residual: Some(0.3),
        };
        let Data::Goal(goal) = converted(EventData::Goal { goal }) else { panic!("a goal") };
        assert_eq!(goal.judgement.unwrap().verdict(), proto::Verdict::StoppedShort);
        assert_eq!((goal.stop_reason(), goal.residual), (proto::StopReason::MaxEvaluations, Some(0.3)));

        let trial = TrialProgress { repetition: 1, index: 2, goal: 3, residual: None };
        let Data::Trial(trial) = converted(EventData::Trial { trial }) else { panic!("a trial") };
        assert_eq!((trial.goal, trial.residual), (3, None));
        assert_eq!(converted(EventData::Resync), Data::Resync(proto::JobResync {}));

        let run = EventData::Run {
            run: RunId::from_uuid(Uuid::from_u128(5)),
            trajectory: None,
            repetition: 1,
            seed: 2,
            evaluations: 3,
            discrepancy: 4.5,
            painted_percent: Some(50.0),
            digest: "d".to_owned(),
        };
        let Data::Run(run) = converted(run) else { panic!("a run") };
        assert_eq!((run.seed, run.painted_percent, run.digest.as_str()), (2, Some(50.0), "d"));
    }
}
