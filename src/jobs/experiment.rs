//! An experiment: pending runs on all cores, their rows stored as they end.
//!
//! # Invariants
//! - Rows, progress and the event that tells it are one transaction: a job that goes on later runs exactly the runs
//!   that have no row, and each run is a pure function of plan and seed, so the table does not depend on the stops.
//! - A run that is under way when the job is asked to rest is given up, not waited for; it has no row and runs again.
//! - Order of completion and number of threads cannot be seen: rows are kept by cell and repetition.

use super::held::{Gone, Held};
use crate::app::model::{EventData, ExperimentId, JobProgress, JobView, RowFilter};
use crate::app::ports::{Advance, StoreError, Transition};
use crate::framework::experiment::{Experiment, Plan, RunError, RunId, RunRow, run_while};
use crate::framework::job::{Event, State};
use rayon::iter::{ParallelBridge as _, ParallelIterator as _};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use tokio::sync::mpsc::{Receiver, Sender, channel};
use tokio::task::JoinHandle;
use tokio::time::{Instant, timeout};

/// Rows that may wait for the store before the runs wait for them.
const ROWS_WAITING: usize = 1024;
/// Where no run ends, the job's state is looked up so often.
const LOOK_UP: Duration = Duration::from_secs(1);

/// Runs the job to its end, or until it is asked to rest.
pub(super) async fn run(held: &Held, job: &JobView, experiment: ExperimentId) -> Result<(), Gone> {
    let loaded = match load(held, &experiment).await {
        Ok(loaded) => loaded,
        Err(error @ StoreError::Corrupt { .. }) => {
            return held.fail("corrupt_input", error.to_string()).await.map(drop);
        }
        Err(error) => return Err(Gone::Store(error)),
    };
    let state = held.transition(Transition::plain(Event::Start)).await?;
    if state != State::Running {
        return let_go(held, state).await;
    }
    let mut attempt = Attempt::new(held, job, &loaded);
    let (rows, work) = start(loaded, Arc::clone(&attempt.going));
    let outcome = attempt.follow(rows).await;
    // Whatever ended the following: nobody needs the runs under way.
    attempt.going.store(false, Ordering::Release);
    let ended = work.await;
    let state = outcome?;
    match ended {
        Ok(Ok(())) => {}
        Ok(Err(error)) => return held.fail("problem", whole_text(&error)).await.map(drop),
        Err(panic) => return held.fail("internal", format!("the computation panicked: {panic}")).await.map(drop),
    }
    if attempt.finished == attempt.runs {
        return held.transition(Transition::plain(Event::Succeed)).await.map(drop);
    }
    let_go(held, state).await
}

async fn load(held: &Held, id: &ExperimentId) -> Result<Experiment, StoreError> {
    let plan = held.ports.store.experiment_plan(id).await?;
    let rows = held.ports.store.experiment_rows(id, &RowFilter::default()).await?;
    Experiment::resume(plan, rows)
        .map_err(|error| StoreError::Corrupt { what: format!("rows of {id}"), cause: error.to_string() })
}

/// Does what a user or a stopping server asks; every row is written already.
async fn let_go(held: &Held, state: State) -> Result<(), Gone> {
    let event = match state {
        State::Pausing => Event::Rest,
        State::Cancelling => Event::Stop,
        State::Running => Event::Requeue,
        _ => return Ok(()),
    };
    match held.transition(Transition::plain(event)).await? {
        // Asked otherwise meanwhile: another worker, or this one, takes it up from its rows.
        State::Running if event == Event::Rest => held.transition(Transition::plain(Event::Requeue)).await.map(drop),
        State::Cancelling => held.transition(Transition::plain(Event::Stop)).await.map(drop),
        State::Pausing if event == Event::Requeue => held.transition(Transition::plain(Event::Rest)).await.map(drop),
        _ => Ok(()),
    }
}

/// Runs everything pending, in the plan's order as threads get free, until told to stop by `going`.
fn start(experiment: Experiment, going: Arc<AtomicBool>) -> (Receiver<RunRow>, JoinHandle<Result<(), RunError>>) {
    let (sender, rows) = channel(ROWS_WAITING);
    let work = tokio::task::spawn_blocking(move || {
        let pending: Vec<RunId> = experiment.pending().collect();
        let plan = experiment.plan();
        let all = || {
            let each = pending.into_iter().par_bridge();
            each.try_for_each_with(sender, |sender, id| step(plan, id, &going, sender))
        };
        // Threads of its own: an experiment beside another one gets its share of the cores, not what is left.
        let result = match rayon::ThreadPoolBuilder::new().build() {
            Ok(threads) => threads.install(all),
            Err(_) => all(),
        };
        match result {
            Err(Some(error)) => Err(error),
            Ok(()) | Err(None) => Ok(()),
        }
    });
    (rows, work)
}

/// One run; an error without content is the wish to stop.
fn step(plan: &Plan, id: RunId, going: &AtomicBool, sender: &Sender<RunRow>) -> Result<(), Option<RunError>> {
    match run_while(plan, id, || going.load(Ordering::Acquire)) {
        Ok(Some(row)) => sender.blocking_send(row).map_err(|_| None),
        Ok(None) => Err(None),
        Err(error) => Err(Some(error)),
    }
}

struct Attempt<'a> {
    held: &'a Held,
    going: Arc<AtomicBool>,
    /// Ended, but not written yet.
    rows: Vec<RunRow>,
    written: Instant,
    finished: u64,
    runs: u64,
    cells: u64,
    repetitions: u32,
    evaluations: u64,
}

impl<'a> Attempt<'a> {
    fn new(held: &'a Held, job: &JobView, experiment: &Experiment) -> Self {
        Self {
            held,
            going: Arc::new(AtomicBool::new(true)),
            rows: Vec::new(),
            written: Instant::now(),
            finished: experiment.rows().len() as u64,
            runs: experiment.plan().runs(),
            cells: experiment.plan().cells.len() as u64,
            repetitions: job.progress.repetitions,
            evaluations: experiment.rows().map(|row| row.evaluations).sum(),
        }
    }

    /// Writes rows as they come until there are no more, or the job is asked to stop; answers its state.
    async fn follow(&mut self, mut rows: Receiver<RunRow>) -> Result<State, Gone> {
        let every = self.held.settings.checkpoint;
        let mut state = State::Running;
        loop {
            let wait = if self.rows.is_empty() { LOOK_UP } else { every.saturating_sub(self.written.elapsed()) };
            let stopping = !self.going.load(Ordering::Acquire);
            let next = tokio::select! {
                next = timeout(wait, rows.recv()) => next,
                () = self.held.interrupted(), if !stopping => {
                    self.going.store(false, Ordering::Release);
                    continue;
                }
            };
            let ended = matches!(next, Ok(None));
            if let Ok(Some(row)) = next {
                self.rows.push(row);
            }
            if ended || self.written.elapsed() >= every {
                state = self.write().await?;
            }
            if ended {
                return Ok(state);
            }
            if state != State::Running {
                self.going.store(false, Ordering::Release);
            }
        }
    }

    async fn write(&mut self) -> Result<State, Gone> {
        let rows = std::mem::take(&mut self.rows);
        self.finished += rows.len() as u64;
        self.evaluations += rows.iter().map(|row| row.evaluations).sum::<u64>();
        let progress = self.progress();
        let events =
            if rows.is_empty() { Vec::new() } else { vec![EventData::Progress { progress: progress.clone() }] };
        let state = self.held.advance(Advance { rows, events, progress: Some(progress), ..Advance::default() }).await?;
        self.written = Instant::now();
        Ok(state)
    }

    fn progress(&self) -> JobProgress {
        let repetition = u32::try_from(self.finished / self.cells.max(1)).unwrap_or(u32::MAX);
        JobProgress {
            fraction: self.finished as f64 / self.runs.max(1) as f64,
            repetition: repetition.min(self.repetitions.saturating_sub(1)),
            repetitions: self.repetitions,
            total_evaluations: self.evaluations,
            ..JobProgress::default()
        }
    }
}

fn whole_text(error: &RunError) -> String {
    match std::error::Error::source(error) {
        Some(cause) => format!("{error}: {cause}"),
        None => error.to_string(),
    }
}
