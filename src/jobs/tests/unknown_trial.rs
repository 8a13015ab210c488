//! A trial of which nobody knows whether it was executed, all the way through the runner: the job rests, a person
//! resumes it, and it ends as if nothing had happened.

use super::{in_state, settings};
use crate::app::bench::{Bench, generalization};
use crate::app::model::{
    ActionId, CreateJob, ExecutionWork, JobId, JobProgress, JobResult, JobView, RobotId, Work, WorldId,
};
use crate::app::ports::{
    Evaluator, EvaluatorError, Evaluators, Jobs as _, NewJob, RunContext, Runs as _, TrialId, Trials, Usage,
};
use crate::framework::execution::{self, Observations, Problem, simulated_world};
use crate::framework::job::State;
use crate::framework::method::per_goal::Provenance;
use crate::framework::trajectory::PlanSpec;
use crate::framework::world::World;
use crate::jobs::Runner;
use crate::reproduce::shipped;
use async_trait::async_trait;
use rstest::rstest;
use std::sync::{Arc, Mutex};
use std::time::Duration;

const SEED: u64 = 3;

/// A trial and its joints.
type Asked = (TrialId, Vec<f64>);

/// Opens robots of a simulated kind. Of all trials asked for, they forget one: the outcome of the `forgets`th, from 0,
/// is unknown.
struct Forgetful {
    forgets: usize,
    most_at_once: usize,
    asked: Arc<Mutex<Vec<Asked>>>,
}

impl Forgetful {
    fn asked(&self) -> Vec<Asked> {
        self.asked.lock().unwrap().clone()
    }
}

struct Robot {
    world: Box<dyn World>,
    scratch: Vec<f64>,
    /// Poses of the prefix the world has seen.
    committed: usize,
    forgets: usize,
    most_at_once: usize,
    asked: Arc<Mutex<Vec<Asked>>>,
}

#[async_trait]
impl Evaluators for Forgetful {
    async fn open(&self, run: RunContext<'_>) -> Result<Box<dyn Evaluator>, EvaluatorError> {
        let world = simulated_world(run.problem, run.chain, run.seed)?;
        let scratch = vec![0.0; world.features().len()];
        let (forgets, most_at_once, asked) = (self.forgets, self.most_at_once, Arc::clone(&self.asked));
        Ok(Box::new(Robot { world, scratch, committed: 0, forgets, most_at_once, asked }))
    }
}

#[async_trait]
impl Evaluator for Robot {
    fn provenance(&self) -> Provenance {
        Provenance::Real
    }

    fn most_at_once(&self) -> usize {
        self.most_at_once
    }

    async fn evaluate(&mut self, trials: Trials<'_>, seen: &mut Observations) -> Result<(), EvaluatorError> {
        for pose in trials.prefix.iter().skip(self.committed) {
            self.world.commit(pose, &mut self.scratch);
        }
        self.committed = trials.prefix.len();
        for (candidate, joints) in trials.batch.iter() {
            let place = {
                let mut asked = self.asked.lock().unwrap();
                asked.push((trials.id(candidate), joints.to_vec()));
                asked.len() - 1
            };
            if place == self.forgets {
                seen.unknown(candidate, joints);
            } else {
                self.world.observe(joints, seen.observed(candidate, joints));
            }
        }
        Ok(())
    }
}

/// Submits an execution of `problem`.
async fn submit(bench: &Bench, problem: &Problem) -> JobId {
    let (ids, now) = (&bench.ports.ids, bench.ports.clock.now());
    let work = Work::Execution(Box::new(ExecutionWork {
        action: ActionId::from_uuid(ids.uuid()),
        robot: RobotId::from_uuid(ids.uuid()),
        world: WorldId::from_uuid(ids.uuid()),
        problem: problem.clone(),
        setup_key: None,
        seed: SEED,
        repetitions: 1,
        max_evaluations_per_s: None,
        planning: PlanSpec::default(),
    }));
    let view = JobView {
        id: JobId::from_uuid(ids.uuid()),
        kind: work.kind(),
        name: "wax".to_owned(),
        state: State::Queued,
        state_reason: None,
        state_since: now,
        attempt: 0,
        progress: JobProgress::default(),
        request: CreateJob::Generalization(generalization(Vec::new())),
        result: JobResult::default(),
        failure: None,
        last_seq: 0,
        created_at: now,
        started_at: None,
        finished_at: None,
    };
    let id = view.id.clone();
    bench.store.submit(NewJob { view, work, uses: Usage::default(), experiment: None }, None).await.unwrap();
    id
}

#[rstest]
#[case("wax", "sst", 1, 60)]
#[case("wax", "model", 1, 4)]
#[case("wax", "pso", 8, 60)]
#[case("paint", "sst", 1, 60)]
#[tokio::test]
async fn an_unknown_trial_pauses_the_job_and_is_asked_for_again_after_a_resume(
    #[case] preset: &str,
    #[case] method: &str,
    #[case] most_at_once: usize,
    #[case] forgets: usize,
) {
    let mut preset = shipped::preset(preset).unwrap();
    assert!(preset.select_method(method));
    let problem = preset.problem;
    let bench = Bench::new();
    let id = submit(&bench, &problem).await;
    let evaluators = Arc::new(Forgetful { forgets, most_at_once, asked: Arc::default() });
    let runner = Runner::start(&bench.ports, Arc::clone(&evaluators) as _, &settings()).await.unwrap();

    let resting = in_state(&bench, &id, State::Paused).await;
    let before = evaluators.asked();
    let unknown = &before[forgets];
    let TrialId { repetition, goal, candidate } = unknown.0;
    let reason = format!(
        "nobody knows whether trial {candidate} of goal {goal} (repetition {repetition}) was executed: look at the \
         robot, then resume the job to ask for the trial again, or cancel it"
    );
    assert_eq!(resting.state_reason, Some(reason));
    assert_eq!(resting.progress.total_evaluations, before.len() as u64 - 1, "the unknown trial is not an evaluation");

    bench.app.resume_job(&id).await.unwrap();
    let ended = in_state(&bench, &id, State::Succeeded).await;
    assert_eq!(evaluators.asked().get(before.len()), Some(unknown));
    let expected = execution::run(&problem, SEED).unwrap();
    let [run] = ended.result.runs.as_slice() else { panic!("one repetition was asked for: {ended:?}") };
    let run = bench.store.run(run).await.unwrap();
    assert_eq!((run.digest, run.evaluations), (expected.digest, expected.evaluations));
    assert_eq!(ended.attempt, 2);
    assert!(runner.shut_down(Duration::from_mins(1)).await);
}
