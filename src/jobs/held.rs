//! A claimed job in a worker's hands: every write goes through its claim.

use super::Settings;
use crate::app::Ports;
use crate::app::model::JobFailure;
use crate::app::ports::{Advance, Claim, StoreError, Transition, Wake};
use crate::framework::job::{Event, State};
use tokio::task::JoinHandle;
use tokio::time::Instant;
use tokio_util::sync::CancellationToken;

/// Why a worker lets go of a job.
#[derive(Debug, thiserror::Error)]
pub(super) enum Gone {
    /// The claim does not hold any more, or it cannot be known whether it does.
    #[error("the lease is lost")]
    Lost,
    /// The store failed; the job is taken back when its lease ends.
    #[error(transparent)]
    Store(StoreError),
}

/// A claimed job.
pub(super) struct Held {
    pub(super) ports: Ports,
    pub(super) settings: Settings,
    claim: Claim,
    /// The server stops.
    pub(super) stop: CancellationToken,
    lost: CancellationToken,
    heartbeat: JoinHandle<()>,
}

impl Held {
    /// Holds `claim` and keeps its lease alive until dropped.
    pub(super) fn new(ports: Ports, settings: Settings, claim: Claim, stop: CancellationToken) -> Self {
        let lost = CancellationToken::new();
        let heartbeat = tokio::spawn(beat(ports.clone(), settings.clone(), claim.clone(), lost.clone()));
        Self { ports, settings, claim, stop, lost, heartbeat }
    }

    /// Writes what was done, and wakes whoever follows the job.
    pub(super) async fn advance(&self, step: Advance) -> Result<State, Gone> {
        if self.lost.is_cancelled() {
            return Err(Gone::Lost);
        }
        let state = self.ports.store.advance(&self.claim, step, self.ports.clock.now()).await;
        match state {
            Ok(state) => {
                self.ports.events.publish(Wake::Job(self.claim.job.clone()));
                Ok(state)
            }
            Err(StoreError::LeaseLost { .. }) => Err(Gone::Lost),
            Err(error) => Err(Gone::Store(error)),
        }
    }

    /// Changes the state; what the user asked meanwhile may forbid it, then the present state is the answer.
    pub(super) async fn transition(&self, transition: Transition) -> Result<State, Gone> {
        match self.advance(Advance { transition: Some(transition), ..Advance::default() }).await {
            Err(Gone::Store(StoreError::Transition(refused))) => Ok(refused.state),
            other => other,
        }
    }

    /// Ends the job without a result.
    pub(super) async fn fail(&self, code: &str, message: String) -> Result<State, Gone> {
        let failure = JobFailure { code: code.to_owned(), message: message.clone() };
        self.transition(Transition { event: Event::Fail, reason: Some(message), failure: Some(failure) }).await
    }

    /// Returns when the lease is lost or the server stops.
    pub(super) async fn interrupted(&self) {
        tokio::select! {
            () = self.lost.cancelled() => {}
            () = self.stop.cancelled() => {}
        }
    }
}

impl Drop for Held {
    fn drop(&mut self) {
        self.heartbeat.abort();
    }
}

/// Prolongs the lease. An error that lasts half a lease counts as a lost lease: nobody else can then hold the job yet.
async fn beat(ports: Ports, settings: Settings, claim: Claim, lost: CancellationToken) {
    let mut heard = Instant::now();
    loop {
        tokio::time::sleep(settings.heartbeat).await;
        match ports.store.heartbeat(&claim, settings.lease).await {
            Ok(_) => heard = Instant::now(),
            Err(StoreError::LeaseLost { .. }) => return lost.cancel(),
            Err(error) => {
                tracing::warn!(job.id = %claim.job, error = %error, "a heartbeat failed");
                if heard.elapsed() > settings.lease / 2 {
                    return lost.cancel();
                }
            }
        }
    }
}
