//! An execution: one run for each repetition, in slices, with checkpoints between them.
//!
//! # Invariants
//! - What is written together is consistent: runs that ended, progress, checkpoint and the events that tell them are
//!   one transaction; a job that goes on after it computes the bits it would have computed without the stop.
//! - Pause and cancel are seen after each write, so at the latest after the time between two checkpoints.

use super::checkpoint::Checkpoint;
use super::held::{Gone, Held};
use super::outcome::{Marks, check_finite, distance, finished_run};
use crate::app::model::{EventData, ExecutionWork, GoalProgress, JobProgress, JobView, TrialProgress};
use crate::app::ports::{Advance, NewRun, Transition};
use crate::evaluate::{Pace, Simulation};
use crate::framework::execution::{GoalResult, Problem, ProblemError, Progress};
use crate::framework::job::{Event, State};
use crate::framework::method::whole_run::Trial;
use std::collections::BTreeSet;
use std::sync::Arc;
use tokio::time::Instant;

/// Goals that ended are told at once, but not more often than so many times between two checkpoints.
const GOAL_SHARE: u32 = 5;

/// Why the work stops before its end.
enum Stop {
    /// The job was let go in an orderly way, or was lost.
    LetGo,
    Gone(Gone),
    Failed(&'static str, String),
}

impl From<Gone> for Stop {
    fn from(gone: Gone) -> Self {
        Self::Gone(gone)
    }
}

impl From<ProblemError> for Stop {
    fn from(error: ProblemError) -> Self {
        Self::Failed("problem", error.to_string())
    }
}

/// Runs the job to its end, or until it is asked to rest.
pub(super) async fn run(
    held: &Held,
    job: &JobView,
    work: ExecutionWork,
    checkpoint: Option<Vec<u8>>,
) -> Result<(), Gone> {
    let mut attempt = Attempt::new(held, job, work, checkpoint);
    match attempt.run().await {
        Ok(()) | Err(Stop::LetGo) => Ok(()),
        Err(Stop::Gone(gone)) => Err(gone),
        Err(Stop::Failed(code, message)) => held.fail(code, message).await.map(drop),
    }
}

struct Attempt<'a> {
    held: &'a Held,
    job: &'a JobView,
    work: ExecutionWork,
    problem: Arc<Problem>,
    saved: Checkpoint,
    pace: Pace,
    /// Ended, but not written yet.
    runs: Vec<NewRun>,
    events: Vec<EventData>,
    written: Option<Instant>,
    /// Trials of the present repetition, as shown.
    trials: Vec<TrialProgress>,
}

impl<'a> Attempt<'a> {
    fn new(held: &'a Held, job: &'a JobView, work: ExecutionWork, checkpoint: Option<Vec<u8>>) -> Self {
        // Runs are written together with the checkpoint after them, so their number tells the repetition.
        let repetition = u32::try_from(job.result.runs.len()).unwrap_or(u32::MAX);
        let saved = checkpoint.and_then(|bytes| Checkpoint::decode(&bytes, repetition)).unwrap_or_else(|| {
            let before = job.progress.total_evaluations - job.progress.evaluations.min(job.progress.total_evaluations);
            Checkpoint::at_start_of(repetition, before)
        });
        Self {
            held,
            job,
            problem: Arc::new(work.problem.clone()),
            pace: Pace::new(work.max_evaluations_per_s),
            work,
            saved,
            runs: Vec::new(),
            events: Vec::new(),
            written: None,
            trials: Vec::new(),
        }
    }

    async fn run(&mut self) -> Result<(), Stop> {
        let state = self.held.transition(Transition::plain(Event::Start)).await?;
        self.obey(state).await?;
        while self.saved.repetition < self.work.repetitions {
            let mut simulation = self.begin().await?;
            let mut told = simulation.progress().results.len();
            self.trials = self.shown(simulation.trials(), 0);
            loop {
                let (advanced, progress) = self.slice(simulation).await?;
                simulation = advanced;
                let news = self.shown(simulation.trials(), self.trials.len());
                self.events.extend(news.iter().map(|trial| EventData::Trial { trial: trial.clone() }));
                self.trials.extend(news);
                let ended = progress.results.get(told..).unwrap_or_default();
                for goal in ended {
                    let goal = self.goal(goal);
                    check_finite(goal.index, goal.discrepancy, &goal.observation).map_err(not_finite)?;
                    self.events.push(EventData::Goal { goal });
                }
                told = progress.results.len();
                if progress.finished {
                    break;
                }
                if self.is_due() {
                    let checkpoint = self.saved.within(simulation.state());
                    self.write(&progress, &checkpoint).await?;
                }
            }
            self.end(simulation).await?;
        }
        let step = Advance {
            progress: Some(self.progress_at_end()),
            transition: Some(Transition::plain(Event::Succeed)),
            ..self.take_step()
        };
        self.held.advance(step).await?;
        Ok(())
    }

    /// The present repetition from where it was saved, or from its seed.
    async fn begin(&mut self) -> Result<Simulation, Stop> {
        let seed = self.work.seed + u64::from(self.saved.repetition);
        let (problem, state) = (Arc::clone(&self.problem), self.saved.iet.take());
        blocking(move || {
            if let Some(state) = state {
                match Simulation::resume(&problem, state) {
                    Ok(simulation) => return Ok(simulation),
                    Err(error) => tracing::warn!(error = %error, "a checkpoint is not used; the run starts again"),
                }
            }
            Simulation::start(&problem, seed)
        })
        .await?
        .map_err(Stop::from)
    }

    async fn slice(&mut self, mut simulation: Simulation) -> Result<(Simulation, Progress), Stop> {
        let budget = self.pace.budget();
        let started = Instant::now();
        let before = simulation.progress().evaluations;
        let (simulation, progress) =
            blocking(move || simulation.advance(budget).map(|progress| (simulation, progress))).await??;
        let rest = self.pace.took(progress.evaluations - before, started.elapsed());
        if !rest.is_zero() {
            tokio::select! {
                () = tokio::time::sleep(rest) => {}
                () = self.held.interrupted() => {}
            }
        }
        Ok((simulation, progress))
    }

    fn is_due(&self) -> bool {
        let Some(written) = self.written else { return true };
        let every = self.held.settings.checkpoint;
        let elapsed = written.elapsed();
        elapsed >= every || (!self.events.is_empty() && elapsed >= every / GOAL_SHARE) || self.held.stop.is_cancelled()
    }

    /// Writes everything there is to write, then does what was asked meanwhile.
    async fn write(&mut self, progress: &Progress, checkpoint: &Checkpoint) -> Result<(), Stop> {
        let shown = self.progress(progress);
        let brief = JobProgress { finished_goals: Vec::new(), trials: Vec::new(), ..shown.clone() };
        self.events.push(EventData::Progress { progress: brief });
        let encoded = checkpoint.encode().map_err(|error| Stop::Failed("checkpoint", error.to_string()))?;
        let step = Advance { progress: Some(shown), checkpoint: Some(encoded), ..self.take_step() };
        let state = self.held.advance(step).await?;
        self.written = Some(Instant::now());
        self.obey(state).await
    }

    /// Does what a user or a stopping server asks; everything is written already.
    async fn obey(&self, state: State) -> Result<(), Stop> {
        let event = match state {
            State::Pausing => Event::Rest,
            State::Cancelling => Event::Stop,
            State::Running if self.held.stop.is_cancelled() => Event::Requeue,
            State::Running => return Ok(()),
            _ => return Err(Stop::LetGo),
        };
        // A user may have asked for something else meanwhile: then that is done.
        match self.held.transition(Transition::plain(event)).await? {
            State::Running => Ok(()),
            State::Cancelling => {
                self.held.transition(Transition::plain(Event::Stop)).await?;
                Err(Stop::LetGo)
            }
            _ => Err(Stop::LetGo),
        }
    }

    fn take_step(&mut self) -> Advance {
        Advance { runs: std::mem::take(&mut self.runs), events: std::mem::take(&mut self.events), ..Advance::default() }
    }

    /// Turns the finished repetition into a run and goes to the next one.
    async fn end(&mut self, simulation: Simulation) -> Result<(), Stop> {
        let ports = &self.held.ports;
        let marks = Marks { run: ports.ids.uuid(), trajectory: ports.ids.uuid(), created_at: ports.clock.now() };
        let (job, work, repetition) = (self.job.id.clone(), self.work.clone(), self.saved.repetition);
        let run = blocking(move || finished_run(simulation, &work, &job, repetition, marks)).await??;
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
            let fresh = Progress {
                goal_index: 0,
                goals: self.problem.goals.len(),
                evaluations: 0,
                goal_evaluations: 0,
                best_discrepancy: None,
                finished: false,
                results: Vec::new(),
            };
            let checkpoint = self.saved.clone();
            self.write(&fresh, &checkpoint).await?;
        }
        Ok(())
    }

    fn progress(&self, progress: &Progress) -> JobProgress {
        // A method that owns the run goes back and forth between goals: those it has tried tell how far it is.
        let tried = self.trials.iter().map(|trial| trial.goal).collect::<BTreeSet<u32>>().len();
        let goals_done = if progress.finished || tried == 0 { progress.goal_index } else { tried - 1 };
        let done = goals_done as f64 / progress.goals.max(1) as f64;
        let repetitions = self.work.repetitions;
        JobProgress {
            fraction: (f64::from(self.saved.repetition) + done) / f64::from(repetitions),
            repetition: self.saved.repetition,
            repetitions,
            goal_index: narrow(progress.goal_index),
            goals: narrow(progress.goals),
            evaluations: progress.evaluations,
            goal_evaluations: progress.goal_evaluations,
            total_evaluations: self.saved.evaluations_before + progress.evaluations,
            discrepancy: progress.best_discrepancy,
            finished_goals: progress.results.iter().map(|goal| self.goal(goal)).collect(),
            trials: if progress.evaluations == 0 { Vec::new() } else { self.trials.clone() },
        }
    }

    fn progress_at_end(&self) -> JobProgress {
        let last = self.runs.last();
        let goals = narrow(self.problem.goals.len());
        let results = last.map(|run| run.goals.goals.as_slice()).unwrap_or_default();
        let repetition = self.work.repetitions - 1;
        JobProgress {
            fraction: 1.0,
            repetition,
            repetitions: self.work.repetitions,
            goal_index: goals,
            goals,
            evaluations: last.map_or(0, |run| run.view.evaluations),
            goal_evaluations: 0,
            total_evaluations: self.saved.evaluations_before,
            discrepancy: last.map(|run| run.view.discrepancy),
            finished_goals: results.iter().map(|goal| GoalProgress::of_run(repetition, goal)).collect(),
            trials: self.trials.clone(),
        }
    }

    fn goal(&self, goal: &GoalResult) -> GoalProgress {
        GoalProgress {
            repetition: self.saved.repetition,
            index: narrow(goal.index),
            evaluations: goal.evaluations,
            discrepancy: goal.discrepancy,
            stop_reason: goal.stop_reason,
            joints: goal.joints.clone(),
            observation: goal.observation.clone(),
            residual: Some(distance(&goal.observation, self.problem.goals.row(goal.index))),
        }
    }

    /// Trials from `first` on as they are shown.
    fn shown(&self, trials: &[Trial], first: usize) -> Vec<TrialProgress> {
        let goals = &self.problem.goals;
        let show = |(index, trial): (usize, &Trial)| TrialProgress {
            repetition: self.saved.repetition,
            index: narrow(index),
            goal: narrow(trial.goal),
            residual: trial.observation.as_ref().map(|seen| distance(seen, goals.row(trial.goal))),
        };
        trials.iter().enumerate().skip(first).map(show).collect()
    }
}

fn not_finite(message: String) -> Stop {
    Stop::Failed("not_finite", message)
}

fn narrow(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

/// CPU work on its own thread; a panic there ends the job, for it would come again.
async fn blocking<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> Result<T, Stop> {
    let done = tokio::task::spawn_blocking(work).await;
    done.map_err(|panic| Stop::Failed("internal", format!("the computation panicked: {panic}")))
}
