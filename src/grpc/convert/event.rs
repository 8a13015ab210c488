//! Events of jobs.

use crate::app::model::{EventData, JobEvent};
use crate::grpc::proto;
use proto::job_event::Data;

impl From<JobEvent> for proto::JobEvent {
    fn from(event: JobEvent) -> Self {
        let data = Some(data(event.data));
        Self { seq: event.seq, job: event.job.into(), at_ms: event.at.0, data }
    }
}

fn data(data: EventData) -> Data {
    match data {
        EventData::State { state, reason, attempt } => {
            let state = proto::JobState::from(state) as i32;
            Data::State(proto::JobStateChanged { state, reason, attempt })
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
