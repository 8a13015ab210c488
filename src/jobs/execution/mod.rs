//! Execution jobs: one run per repetition, computed in slices with checkpoints in between.
//!
//! # Invariants
//! - Everything written together is consistent: finished runs, progress, checkpoint and their events are one
//!   transaction. A job that resumes from it computes the bits it would have computed without the stop.
//! - Pause and cancel are noticed after each write, at the latest after one checkpoint interval. An evaluation that
//!   takes longer is interrupted.
//! - The evaluator that executes the trials is chosen by the wiring; nothing here depends on a simulation.

mod checkpoint;
mod record;
mod report;
mod search;
#[cfg(test)]
mod search_tests;

use super::lease::{ClaimedJob, Stop, blocking};
use crate::app::model::{EventData, ExecutionWork, JobProgress, JobView};
use crate::app::ports::{Advance, EvaluatorError, Evaluators, NewRun, Product, RunContext, TrialId};
use crate::framework::execution::{Iet, Problem, ProblemError};
use crate::framework::job::State;
use checkpoint::Checkpoint;
use record::{Marks, check_finite, finished_run};
use report::Report;
use search::{Search, SliceEnd, SliceError};
use std::sync::Arc;
use std::time::Duration;
use tokio::runtime::Handle;
use tokio::time::Instant;

/// Finished goals are published immediately, at most this many times per checkpoint interval.
const GOALS_PER_CHECKPOINT: u32 = 5;
/// Duration of a slice; between slices the job obeys pause and cancel.
const SLICE: Duration = Duration::from_millis(25);

impl From<ProblemError> for Stop {
    fn from(error: ProblemError) -> Self {
        Self::failed("problem", error.to_string())
    }
}

/// Runs the job to its end, or until it is asked to stop.
pub(in crate::jobs) async fn run(
    claimed: &ClaimedJob,
    evaluators: &dyn Evaluators,
    job: &JobView,
    work: ExecutionWork,
    checkpoint: Option<Vec<u8>>,
) -> Result<(), Stop> {
    claimed.start().await?;
    RunningExecution::new(claimed, evaluators, job, work, checkpoint).run().await
}

struct RunningExecution<'a> {
    claimed: &'a ClaimedJob,
    evaluators: &'a dyn Evaluators,
    job: &'a JobView,
    work: ExecutionWork,
    problem: Arc<Problem>,
    saved: Checkpoint,
    report: Report,
    /// Finished runs that are not written yet.
    runs: Vec<NewRun>,
    events: Vec<EventData>,
    written: Option<Instant>,
}

impl<'a> RunningExecution<'a> {
    fn new(
        claimed: &'a ClaimedJob,
        evaluators: &'a dyn Evaluators,
        job: &'a JobView,
        work: ExecutionWork,
        checkpoint: Option<Vec<u8>>,
    ) -> Self {
        // A run is written together with the checkpoint after it, so the number of runs is the repetition.
        let repetition = u32::try_from(job.result.runs.len()).unwrap_or(u32::MAX);
        let saved = checkpoint.and_then(|bytes| Checkpoint::decode(&bytes, repetition)).unwrap_or_else(|| {
            let before = job.progress.total_evaluations - job.progress.evaluations.min(job.progress.total_evaluations);
            Checkpoint::at_start_of(repetition, before)
        });
        let problem = Arc::new(work.problem.clone());
        Self {
            claimed,
            evaluators,
            job,
            report: Report::new(Arc::clone(&problem), work.repetitions),
            problem,
            work,
            saved,
            runs: Vec::new(),
            events: Vec::new(),
            written: None,
        }
    }

    async fn run(&mut self) -> Result<(), Stop> {
        while self.saved.repetition < self.work.repetitions {
            let search = self.begin().await?;
            let search = self.repetition(search).await?;
            self.end(search).await?;
        }
        let progress = Some(self.report.at_end(self.runs.last(), self.saved.evaluations_before));
        let step = Advance { progress, ..self.take_step() };
        Ok(self.claimed.succeed(step).await?)
    }

    /// Starts the current repetition, with its evaluator, from its checkpoint or else from its seed.
    async fn begin(&mut self) -> Result<Search, Stop> {
        let seed = self.work.seed + u64::from(self.saved.repetition);
        let (problem, state) = (Arc::clone(&self.problem), self.saved.iet.take());
        let iet = blocking(move || {
            if let Some(state) = state {
                match Iet::resume(&problem, state) {
                    Ok(iet) => return Ok(iet),
                    Err(error) => tracing::warn!(error = %error, "ignored a checkpoint; the run starts again"),
                }
            }
            Iet::new(&problem, seed)
        })
        .await??;
        let run = RunContext {
            job: &self.job.id,
            repetition: self.saved.repetition,
            seed,
            problem: &self.problem,
            chain: iet.chain(),
            max_evaluations_per_s: self.work.max_evaluations_per_s,
        };
        let evaluator = match self.evaluators.open(run).await {
            Ok(evaluator) => evaluator,
            Err(error) => return Err(self.out_of_reach(error).await),
        };
        self.report.begin(self.saved.repetition, self.saved.evaluations_before, iet.log());
        Ok(Search::new(iet, evaluator, self.saved.repetition))
    }

    /// Runs slice after slice until every goal has ended.
    async fn repetition(&mut self, mut search: Search) -> Result<Search, Stop> {
        let mut published = search.iet.progress().results.len();
        loop {
            let (advanced, end) = self.slice(search).await?;
            search = advanced;
            let progress = search.iet.progress();
            let trials = self.report.news(search.iet.log());
            self.events.extend(trials.into_iter().map(|trial| EventData::Trial { trial }));
            for goal in progress.results.get(published..).unwrap_or_default() {
                let goal = self.report.goal(goal);
                check_finite(goal.index, goal.discrepancy, &goal.observation).map_err(not_finite)?;
                self.events.push(EventData::Goal { goal });
            }
            published = progress.results.len();
            match end {
                Ok(SliceEnd::Finished) => return Ok(search),
                Ok(SliceEnd::Due) => {
                    if self.is_due() {
                        self.write(self.report.progress(&progress), &self.saved.within(search.iet.state())).await?;
                    }
                }
                Ok(SliceEnd::Unknown(trial)) => {
                    self.keep(self.report.progress(&progress), &self.saved.within(search.iet.state())).await?;
                    return Err(self.claimed.rest(unknown(trial)).await);
                }
                Err(SliceError::Problem(error)) => return Err(error.into()),
                Err(SliceError::Evaluator(error)) => {
                    self.keep(self.report.progress(&progress), &self.saved.within(search.iet.state())).await?;
                    return Err(self.out_of_reach(error).await);
                }
            }
        }
    }

    /// Runs one slice on its own thread, because searches and simulated worlds may compute for long.
    async fn slice(&self, mut search: Search) -> Result<(Search, Result<SliceEnd, SliceError>), Stop> {
        let mut interrupt = self.claimed.interrupt();
        let runtime = Handle::current();
        blocking(move || {
            let due = Instant::now() + SLICE;
            let end = runtime.block_on(search.slice(due, interrupt.raised()));
            (search, end)
        })
        .await
    }

    async fn out_of_reach(&self, error: EvaluatorError) -> Stop {
        match error {
            EvaluatorError::Problem(error) => error.into(),
            error @ EvaluatorError::Unavailable { .. } => self.claimed.rest(error.to_string()).await,
        }
    }

    fn is_due(&self) -> bool {
        let Some(written) = self.written else { return true };
        let every = self.claimed.settings.checkpoint;
        let elapsed = written.elapsed();
        let has_news = !self.events.is_empty() && elapsed >= every / GOALS_PER_CHECKPOINT;
        elapsed >= every || has_news || self.claimed.is_interrupted()
    }

    /// Writes everything that is pending, then obeys requests that arrived in the meantime.
    async fn write(&mut self, shown: JobProgress, checkpoint: &Checkpoint) -> Result<(), Stop> {
        let state = self.keep(shown, checkpoint).await?;
        self.claimed.settle(state).await
    }

    /// Writes everything that is pending; returns the job's state.
    async fn keep(&mut self, shown: JobProgress, checkpoint: &Checkpoint) -> Result<State, Stop> {
        let brief = JobProgress { finished_goals: Vec::new(), trials: Vec::new(), ..shown.clone() };
        self.events.push(EventData::Progress { progress: brief });
        let encoded = checkpoint.encode().map_err(|error| Stop::failed("checkpoint", error.to_string()))?;
        let step = Advance { progress: Some(shown), checkpoint: Some(encoded), ..self.take_step() };
        let state = self.claimed.advance(step).await?;
        self.written = Some(Instant::now());
        Ok(state)
    }

    fn take_step(&mut self) -> Advance {
        let products = self.runs.drain(..).map(|run| Product::Run(Box::new(run))).collect();
        Advance { products, events: std::mem::take(&mut self.events), ..Advance::default() }
    }

    /// Turns the finished repetition into a run and moves on to the next one.
    async fn end(&mut self, search: Search) -> Result<(), Stop> {
        let ports = &self.claimed.ports;
        let marks = Marks { run: ports.ids.uuid(), trajectory: ports.ids.uuid(), created_at: ports.clock.now() };
        let (job, work, repetition) = (self.job.id.clone(), self.work.clone(), self.saved.repetition);
        let run = blocking(move || finished_run(search.iet, &work, &job, repetition, marks)).await??;
        for goal in &run.goals.goals {
            check_finite(goal.index, goal.discrepancy, &goal.observation).map_err(not_finite)?;
        }
        let view = &run.view;
        self.events.push(EventData::Run {
            run: view.id.clone(),
            trajectory: view.trajectory.clone(),
            repetition,
            seed: view.seed,
            evaluations: view.evaluations,
            discrepancy: view.discrepancy,
            painted_percent: view.painted_percent,
            digest: view.digest.clone(),
        });
        let before = self.saved.evaluations_before + view.evaluations;
        self.runs.push(run);
        self.saved = Checkpoint::at_start_of(repetition + 1, before);
        if self.saved.repetition < self.work.repetitions && self.is_due() {
            self.report.begin(self.saved.repetition, before, &[]);
            self.write(self.report.between(), &self.saved.clone()).await?;
        }
        Ok(())
    }
}

fn not_finite(message: String) -> Stop {
    Stop::failed("not_finite", message)
}

/// Reason shown for a job that pauses because of an unknown trial, with the remedy.
fn unknown(trial: TrialId) -> String {
    let TrialId { repetition, goal, candidate } = trial;
    format!(
        "nobody knows whether trial {candidate} of goal {goal} (repetition {repetition}) was executed: look at the \
         robot, then resume the job to ask for the trial again, or cancel it"
    )
}
