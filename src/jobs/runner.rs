//! Workers, and the task that requeues the jobs of lost ones.

use super::lease::{ClaimedJob, LeaseLost, Stop};
use super::run_kind;
use crate::app::Ports;
use crate::app::ports::{Claimed, Evaluators, StoreError, Wake};
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::broadcast::{Receiver, error::RecvError};
use tokio::task::JoinSet;
use tokio_util::sync::CancellationToken;

/// Settings of the runner.
#[derive(Debug, Clone)]
pub struct Settings {
    /// Jobs that run at the same time.
    pub workers: usize,
    /// Lease duration: a job without a heartbeat for this long is requeued.
    pub lease: Duration,
    /// Time between heartbeats.
    pub heartbeat: Duration,
    /// Checkpoint interval.
    pub checkpoint: Duration,
    /// A job that loses its worker this many times in a row without a checkpoint fails.
    pub max_crashes: u32,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            workers: std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
            lease: Duration::from_secs(6),
            heartbeat: Duration::from_secs(2),
            checkpoint: Duration::from_millis(250),
            max_crashes: 3,
        }
    }
}

/// Polling interval for queued jobs, in case a wake-up is lost.
const LOOK_AGAIN: Duration = Duration::from_secs(1);

/// The running workers.
pub struct Runner {
    tasks: JoinSet<()>,
    stop: CancellationToken,
}

impl Runner {
    /// Requeues the jobs of an earlier server and starts the workers; `evaluators` carry out the trials of executions.
    ///
    /// # Errors
    /// [`StoreError`] when the store fails.
    pub async fn start(
        ports: &Ports,
        evaluators: Arc<dyn Evaluators>,
        settings: &Settings,
    ) -> Result<Self, StoreError> {
        let orphans = ports.store.begin_epoch(ports.clock.now()).await?;
        if !orphans.is_empty() {
            tracing::info!(jobs = orphans.len(), "jobs of an earlier server continue from their checkpoints");
        }
        let stop = CancellationToken::new();
        let mut tasks = JoinSet::new();
        for _ in 0..settings.workers {
            let worker = Worker {
                ports: ports.clone(),
                evaluators: Arc::clone(&evaluators),
                settings: settings.clone(),
                stop: stop.clone(),
            };
            tasks.spawn(worker.work());
        }
        tasks.spawn(reap(ports.clone(), stop.clone()));
        Ok(Self { tasks, stop })
    }

    /// Asks every worker to write its checkpoint and return its job; returns whether all did so within `limit`.
    pub async fn shut_down(mut self, limit: Duration) -> bool {
        self.stop.cancel();
        let all = async { while self.tasks.join_next().await.is_some() {} };
        tokio::time::timeout(limit, all).await.is_ok()
    }
}

struct Worker {
    ports: Ports,
    evaluators: Arc<dyn Evaluators>,
    settings: Settings,
    stop: CancellationToken,
}

impl Worker {
    async fn work(self) {
        let mut wakes = self.ports.events.subscribe();
        let Settings { lease, max_crashes, .. } = self.settings;
        while !self.stop.is_cancelled() {
            let (token, now) = (self.ports.ids.token(), self.ports.clock.now());
            match self.ports.store.claim(token, lease, max_crashes, now).await {
                Ok(Some(claimed)) => self.attempt(claimed).await,
                Ok(None) => queued(&mut wakes, &self.stop).await,
                Err(error) => {
                    tracing::error!(error = %error, cause = ?error, "cannot claim a job");
                    rest(LOOK_AGAIN, &self.stop).await;
                }
            }
        }
    }

    async fn attempt(&self, claimed: Claimed) {
        let Claimed { claim, job, work, checkpoint } = claimed;
        let id = job.id.clone();
        self.ports.events.publish(Wake::Job(id.clone()));
        tracing::info!(job.id = %id, job.kind = job.kind.as_str(), job.attempt = job.attempt, "job claimed");
        let claimed = ClaimedJob::new(self.ports.clone(), self.settings.clone(), claim, self.stop.clone());
        let evaluators = Arc::clone(&self.evaluators);
        // On its own task: a panic ends the attempt, not the worker; the job is requeued when its lease ends.
        let attempt = tokio::spawn(async move {
            let ended = run_kind(&claimed, evaluators.as_ref(), &job, work, checkpoint).await;
            match ended {
                Ok(()) | Err(Stop::Released) => Ok(()),
                Err(Stop::Failed { code, message }) => claimed.fail(code, message).await,
                Err(Stop::Lost(lost)) => Err(lost),
            }
        });
        match attempt.await {
            Ok(Ok(())) => tracing::info!(job.id = %id, "job released"),
            Ok(Err(LeaseLost::Expired)) => tracing::warn!(job.id = %id, "job lost to another worker"),
            Ok(Err(LeaseLost::Store(error))) => {
                tracing::error!(job.id = %id, error = %error, cause = ?error, "job abandoned: the store failed");
            }
            Err(panic) => tracing::error!(job.id = %id, error = %panic, "job abandoned: its worker panicked"),
        }
    }
}

async fn reap(ports: Ports, stop: CancellationToken) {
    while !stop.is_cancelled() {
        rest(LOOK_AGAIN, &stop).await;
        match ports.store.reap(ports.clock.now()).await {
            Ok(lost) => {
                for job in lost {
                    tracing::warn!(job.id = %job, "job taken back: its worker stopped answering");
                    ports.events.publish(Wake::Job(job));
                    ports.events.publish(Wake::Queued);
                }
            }
            Err(error) => tracing::error!(error = %error, cause = ?error, "cannot check leases"),
        }
    }
}

async fn rest(time: Duration, stop: &CancellationToken) {
    tokio::select! {
        () = tokio::time::sleep(time) => {}
        () = stop.cancelled() => {}
    }
}

/// Returns when a job may be waiting, at the latest after [`LOOK_AGAIN`].
async fn queued(wakes: &mut Receiver<Wake>, stop: &CancellationToken) {
    let hint = async {
        loop {
            match wakes.recv().await {
                Ok(Wake::Job(_)) => {}
                Ok(Wake::Queued) | Err(RecvError::Lagged(_)) => return,
                Err(RecvError::Closed) => std::future::pending().await,
            }
        }
    };
    tokio::select! {
        () = hint => {}
        () = rest(LOOK_AGAIN, stop) => {}
    }
}
