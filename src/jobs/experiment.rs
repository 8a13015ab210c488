//! Experiment jobs: pending runs on all cores, their rows stored as they finish.
//!
//! # Invariants
//! - Rows, progress and the progress event are one transaction. A resumed job executes exactly the runs without a row,
//!   and each run is a pure function of plan and seed, so the table does not depend on interruptions.
//! - A run in flight when the job is asked to stop is abandoned, not awaited; it has no row and runs again.
//! - Completion order and number of threads are not observable: rows are stored by cell and repetition.

use super::lease::{ClaimedJob, LeaseLost, Stop, blocking};
use crate::app::chain_text;
use crate::app::model::ExperimentId;
use crate::app::model::RowFilter;
use crate::app::model::{EventData, JobProgress, JobView};
use crate::app::ports::{Advance, Product, StoreError};
use crate::framework::experiment::{Experiment, Plan, RunError, RunId, RunRow, run_while};
use crate::framework::job::State;
use rayon::iter::{ParallelBridge as _, ParallelIterator as _};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use tokio::sync::mpsc::{Receiver, Sender, channel};
use tokio::time::{Instant, timeout};

/// Capacity of the queue of rows that are not stored yet; if it is full, the runs wait.
const ROWS_WAITING: usize = 1024;
/// Interval at which the job's state is read while no run ends.
const LOOK_UP: Duration = Duration::from_secs(1);

/// Runs the job to its end, or until it is asked to stop.
pub(super) async fn run(claimed: &ClaimedJob, job: &JobView, experiment: ExperimentId) -> Result<(), Stop> {
    claimed.start().await?;
    loop {
        let loaded = load(claimed, &experiment).await?;
        let mut running = RunningExperiment::new(claimed, job, &loaded);
        let state = running.go_through(loaded).await?;
        if running.finished == running.runs {
            return Ok(claimed.succeed(Advance::default()).await?);
        }
        // The runs in flight were abandoned. If the job continues after all, they run again.
        claimed.settle(state).await?;
    }
}

async fn load(claimed: &ClaimedJob, id: &ExperimentId) -> Result<Experiment, StoreError> {
    let store = &claimed.ports.store;
    let (plan, rows) = (store.experiment_plan(id).await?, store.experiment_rows(id, &RowFilter::default()).await?);
    Experiment::resume(plan, rows)
        .map_err(|error| StoreError::Corrupt { what: format!("rows of {id}"), cause: error.to_string() })
}

/// Executes the pending runs on all threads, started in the plan's order, as long as `going` is true.
fn run_pending(experiment: &Experiment, going: &AtomicBool, sender: Sender<RunRow>) -> Result<(), RunError> {
    let plan = experiment.plan();
    let pending: Vec<RunId> = experiment.pending().collect();
    let all = || {
        let each = pending.into_iter().par_bridge();
        each.try_for_each_with(sender, |sender, id| step(plan, id, going, sender))
    };
    // A thread pool per experiment, so that concurrent experiments share the cores fairly.
    let result = match rayon::ThreadPoolBuilder::new().build() {
        Ok(threads) => threads.install(all),
        Err(_) => all(),
    };
    match result {
        Err(Some(error)) => Err(error),
        Ok(()) | Err(None) => Ok(()),
    }
}

/// Executes one run; fails with `None` if it was asked to stop.
fn step(plan: &Plan, id: RunId, going: &AtomicBool, sender: &Sender<RunRow>) -> Result<(), Option<RunError>> {
    match run_while(plan, id, || going.load(Ordering::Acquire)) {
        Ok(Some(row)) => sender.blocking_send(row).map_err(|_| None),
        Ok(None) => Err(None),
        Err(error) => Err(Some(error)),
    }
}

struct RunningExperiment<'a> {
    claimed: &'a ClaimedJob,
    going: Arc<AtomicBool>,
    /// Finished rows that are not written yet.
    rows: Vec<RunRow>,
    written: Instant,
    finished: u64,
    runs: u64,
    cells: u64,
    repetitions: u32,
    evaluations: u64,
}

impl<'a> RunningExperiment<'a> {
    fn new(claimed: &'a ClaimedJob, job: &JobView, experiment: &Experiment) -> Self {
        Self {
            claimed,
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

    /// Executes the pending runs until all are finished or the job is asked to stop; returns the job's state.
    async fn go_through(&mut self, experiment: Experiment) -> Result<State, Stop> {
        let (sender, rows) = channel(ROWS_WAITING);
        let going = Arc::clone(&self.going);
        let work = blocking(move || run_pending(&experiment, &going, sender));
        let follow = async {
            let state = self.follow(rows).await;
            // Whatever the reason why the rows are no longer followed, runs still in flight are useless.
            self.going.store(false, Ordering::Release);
            state
        };
        let (ended, state) = tokio::join!(work, follow);
        let state = state?;
        ended?.map_err(|error| Stop::failed("problem", chain_text(&error)))?;
        Ok(state)
    }

    /// Writes rows as they arrive until there are no more; returns the job's state.
    async fn follow(&mut self, mut rows: Receiver<RunRow>) -> Result<State, LeaseLost> {
        let every = self.claimed.settings.checkpoint;
        let mut interrupt = self.claimed.interrupt();
        let mut state = State::Running;
        loop {
            let wait = if self.rows.is_empty() { LOOK_UP } else { every.saturating_sub(self.written.elapsed()) };
            let stopping = !self.going.load(Ordering::Acquire);
            let next = tokio::select! {
                next = timeout(wait, rows.recv()) => next,
                () = interrupt.raised(), if !stopping => {
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

    async fn write(&mut self) -> Result<State, LeaseLost> {
        let rows = std::mem::take(&mut self.rows);
        self.finished += rows.len() as u64;
        self.evaluations += rows.iter().map(|row| row.evaluations).sum::<u64>();
        let progress = self.progress();
        let shown = EventData::Progress { progress: progress.clone() };
        let (products, events) =
            if rows.is_empty() { (Vec::new(), Vec::new()) } else { (vec![Product::Rows(rows)], vec![shown]) };
        let step = Advance { products, events, progress: Some(progress), ..Advance::default() };
        let state = self.claimed.advance(step).await?;
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
