//! Workers, and the task that takes back what a lost worker held.

use super::held::{Gone, Held};
use super::{execution, experiment, generalization};
use crate::app::Ports;
use crate::app::model::Work;
use crate::app::ports::{Claimed, StoreError, Wake};
use std::time::Duration;
use tokio::sync::broadcast::{Receiver, error::RecvError};
use tokio::task::JoinSet;
use tokio_util::sync::CancellationToken;

/// How jobs are run.
#[derive(Debug, Clone)]
pub struct Settings {
    /// Jobs at a time.
    pub workers: usize,
    /// After so long without a sign of life a job is taken back.
    pub lease: Duration,
    /// Time between signs of life.
    pub heartbeat: Duration,
    /// Time between checkpoints.
    pub checkpoint: Duration,
    /// Losses in a row without a checkpoint after which a job fails.
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

/// Time between looks for jobs without a hint.
const LOOK_AGAIN: Duration = Duration::from_secs(1);

/// The running workers.
pub struct Runner {
    tasks: JoinSet<()>,
    stop: CancellationToken,
}

impl Runner {
    /// Takes over what an earlier server held, and starts the workers.
    ///
    /// # Errors
    /// [`StoreError`] when the store fails.
    pub async fn start(ports: &Ports, settings: &Settings) -> Result<Self, StoreError> {
        let orphans = ports.store.begin_epoch(ports.clock.now()).await?;
        if !orphans.is_empty() {
            tracing::info!(jobs = orphans.len(), "jobs of an earlier server go on from their checkpoints");
        }
        let stop = CancellationToken::new();
        let mut tasks = JoinSet::new();
        for _ in 0..settings.workers {
            tasks.spawn(work(ports.clone(), settings.clone(), stop.clone()));
        }
        tasks.spawn(reap(ports.clone(), stop.clone()));
        Ok(Self { tasks, stop })
    }

    /// Lets every worker write its checkpoint and give back its job; answers whether all did within `limit`.
    pub async fn shut_down(mut self, limit: Duration) -> bool {
        self.stop.cancel();
        let all = async { while self.tasks.join_next().await.is_some() {} };
        tokio::time::timeout(limit, all).await.is_ok()
    }
}

async fn work(ports: Ports, settings: Settings, stop: CancellationToken) {
    let mut wakes = ports.events.subscribe();
    while !stop.is_cancelled() {
        let (token, now) = (ports.ids.token(), ports.clock.now());
        match ports.store.claim(token, settings.lease, settings.max_crashes, now).await {
            Ok(Some(claimed)) => hold(&ports, &settings, claimed, &stop).await,
            Ok(None) => queued(&mut wakes, &stop).await,
            Err(error) => {
                tracing::error!(error = %error, cause = ?error, "no job could be claimed");
                rest(LOOK_AGAIN, &stop).await;
            }
        }
    }
}

async fn hold(ports: &Ports, settings: &Settings, claimed: Claimed, stop: &CancellationToken) {
    let Claimed { claim, job, work, checkpoint } = claimed;
    let id = job.id.clone();
    ports.events.publish(Wake::Job(id.clone()));
    let held = Held::new(ports.clone(), settings.clone(), claim, stop.clone());
    tracing::info!(job.id = %id, job.kind = job.kind.as_str(), job.attempt = job.attempt, "job claimed");
    // On its own task: a panic ends the attempt, not the worker; the job is taken back when its lease ends.
    let attempt = tokio::spawn(async move {
        match work {
            Work::Generalization(request) => generalization::run(&held, &job, request).await,
            Work::Execution(work) => execution::run(&held, &job, *work, checkpoint).await,
            Work::Experiment { experiment } => experiment::run(&held, &job, experiment).await,
        }
    });
    match attempt.await {
        Ok(Ok(())) => tracing::info!(job.id = %id, "job let go"),
        Ok(Err(Gone::Lost)) => tracing::warn!(job.id = %id, "job lost to another worker"),
        Ok(Err(Gone::Store(error))) => {
            tracing::error!(job.id = %id, error = %error, cause = ?error, "job abandoned: the store failed");
        }
        Err(panic) => tracing::error!(job.id = %id, error = %panic, "job abandoned: its worker panicked"),
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
            Err(error) => tracing::error!(error = %error, cause = ?error, "leases could not be checked"),
        }
    }
}

async fn rest(time: Duration, stop: &CancellationToken) {
    tokio::select! {
        () = tokio::time::sleep(time) => {}
        () = stop.cancelled() => {}
    }
}

/// Returns when a job may wait, at the latest after a second.
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
