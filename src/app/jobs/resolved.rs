//! A job that can be submitted.

use crate::app::model::{CreateJob, ExperimentId, JobProgress, Work};
use crate::app::ports::Usage;
use crate::framework::experiment::Plan;

/// A job that is ready to be submitted.
pub(super) struct Resolved {
    pub name: String,
    pub request: CreateJob,
    pub work: Work,
    pub uses: Usage,
    pub progress: JobProgress,
    /// The experiment to store with it.
    pub experiment: Option<(ExperimentId, Plan)>,
}

impl Resolved {
    pub(super) fn new(name: String, request: CreateJob, work: Work) -> Self {
        let (uses, progress) = match &work {
            Work::Generalization(_) | Work::Experiment { .. } => {
                (Usage::default(), JobProgress { repetitions: 1, ..JobProgress::default() })
            }
            Work::Execution(work) => {
                let uses = Usage {
                    action: Some(work.action.clone()),
                    robot: Some(work.robot.clone()),
                    world: Some(work.world.clone()),
                };
                let goals = u32::try_from(work.problem.goals.len()).unwrap_or(u32::MAX);
                (uses, JobProgress { repetitions: work.repetitions, goals, ..JobProgress::default() })
            }
        };
        Self { name, request, work, uses, progress, experiment: None }
    }

    /// A job that was resolved earlier.
    pub(super) fn again(name: String, request: CreateJob, work: Work) -> Self {
        Self::new(name, request, work)
    }
}
