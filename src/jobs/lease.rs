//! A claimed job and its lease; every write of a worker goes through its claim.
//!
//! # Invariants
//! - A claim that may no longer hold stops the work. If renewals keep failing for half the lease, or one stays
//!   without an answer until five sixths of it, the worker gives the job up, before another worker can claim it.
//! - [`ClaimedJob::settle`] is the only answer to pause, cancel and shutdown. Whatever happens between reading a state
//!   and acting on it, either the job ends up in a state that no worker holds, or the work continues.

use super::Settings;
use crate::app::Ports;
use crate::app::model::JobFailure;
use crate::app::ports::{Advance, Claim, StoreError, Transition, Wake};
use crate::framework::job::{Event, State};
use std::time::Duration;
use tokio::sync::watch;
use tokio::task::JoinHandle;
use tokio_util::sync::CancellationToken;

/// Reasons why a worker loses a job.
#[derive(Debug, thiserror::Error)]
pub(super) enum LeaseLost {
    /// The claim no longer holds, or cannot be confirmed.
    #[error("the lease is lost")]
    Expired,
    /// The store failed; the job is requeued when its lease expires.
    #[error(transparent)]
    Store(StoreError),
}

/// Reasons why work on a job stops before its end.
#[derive(Debug)]
pub(super) enum Stop {
    /// The job was paused, cancelled or given back in an orderly way.
    Released,
    /// Another worker may have the job.
    Lost(LeaseLost),
    /// The job cannot be completed.
    Failed {
        /// Stable code.
        code: &'static str,
        /// The reason, with the numbers.
        message: String,
    },
}

impl Stop {
    /// A failure with a stable code.
    pub(super) fn failed(code: &'static str, message: impl Into<String>) -> Self {
        Self::Failed { code, message: message.into() }
    }
}

impl From<LeaseLost> for Stop {
    fn from(lost: LeaseLost) -> Self {
        Self::Lost(lost)
    }
}

impl From<StoreError> for Stop {
    fn from(error: StoreError) -> Self {
        match error {
            StoreError::Corrupt { .. } => Self::failed("corrupt_input", error.to_string()),
            error => Self::Lost(LeaseLost::Store(error)),
        }
    }
}

/// The event with which a worker answers `state`, or `None` if there is nothing to answer.
fn answer(state: State, is_stopping: bool) -> Option<Event> {
    match state {
        State::Pausing => Some(Event::Rest),
        State::Cancelling => Some(Event::Stop),
        State::Preparing | State::Running if is_stopping => Some(Event::Requeue),
        _ => None,
    }
}

/// Wakes a worker that waits: its lease is lost, the server stops, or a user asked for something.
#[derive(Clone)]
pub(super) struct Interrupt {
    stop: CancellationToken,
    lost: CancellationToken,
    state: watch::Receiver<State>,
}

impl Interrupt {
    /// Returns as soon as the work should be interrupted.
    pub(super) async fn raised(&mut self) {
        let asked = async {
            let asks = |state: &State| answer(*state, false).is_some();
            // After the last heartbeat the state does not change any more: only the two tokens can interrupt.
            if self.state.wait_for(asks).await.is_err() {
                std::future::pending::<()>().await;
            }
        };
        tokio::select! {
            () = self.lost.cancelled() => {}
            () = self.stop.cancelled() => {}
            () = asked => {}
        }
    }
}

/// A job that a worker holds; its lease is renewed until this is dropped.
pub(super) struct ClaimedJob {
    pub(super) ports: Ports,
    pub(super) settings: Settings,
    claim: Claim,
    stop: CancellationToken,
    lost: CancellationToken,
    /// The job's state as last read.
    state: watch::Sender<State>,
    heartbeat: JoinHandle<()>,
}

impl ClaimedJob {
    /// Keeps the lease of `claim` alive; `stop` is cancelled when the server stops.
    pub(super) fn new(ports: Ports, settings: Settings, claim: Claim, stop: CancellationToken) -> Self {
        let lost = CancellationToken::new();
        let state = watch::Sender::new(State::Preparing);
        let renewals = Renewals {
            renewed: ports.clock.elapsed(),
            ports: ports.clone(),
            settings: settings.clone(),
            claim: claim.clone(),
            lost: lost.clone(),
            state: state.clone(),
        };
        Self { ports, settings, claim, stop, lost, state, heartbeat: tokio::spawn(renewals.run()) }
    }

    /// Whether the server is stopping.
    pub(super) fn is_stopping(&self) -> bool {
        self.stop.is_cancelled()
    }

    /// Whether the work should be interrupted.
    pub(super) fn is_interrupted(&self) -> bool {
        self.is_stopping() || self.lost.is_cancelled() || answer(*self.state.borrow(), false).is_some()
    }

    /// A handle for work that waits for something else, to be woken by an interruption.
    pub(super) fn interrupt(&self) -> Interrupt {
        Interrupt { stop: self.stop.clone(), lost: self.lost.clone(), state: self.state.subscribe() }
    }

    /// Writes a step of the work, and wakes whoever follows the job.
    pub(super) async fn advance(&self, step: Advance) -> Result<State, LeaseLost> {
        if self.lost.is_cancelled() {
            return Err(LeaseLost::Expired);
        }
        match self.ports.store.advance(&self.claim, step, self.ports.clock.now()).await {
            Ok(state) => {
                self.state.send_replace(state);
                self.ports.events.publish(Wake::Job(self.claim.job.clone()));
                Ok(state)
            }
            Err(StoreError::LeaseLost { .. }) => Err(LeaseLost::Expired),
            Err(error) => Err(LeaseLost::Store(error)),
        }
    }

    /// Applies an event to the job. A user may have changed the state since it was read; if the state machine therefore
    /// rejects the event, the current state is returned.
    async fn transition(&self, transition: Transition) -> Result<State, LeaseLost> {
        match self.advance(Advance { transition: Some(transition), ..Advance::default() }).await {
            Err(LeaseLost::Store(StoreError::Transition(refused))) => Ok(refused.state),
            other => other,
        }
    }

    /// Starts the work, unless something else was requested in the meantime.
    pub(super) async fn start(&self) -> Result<(), Stop> {
        let state = self.transition(Transition::plain(Event::Start)).await?;
        self.settle(state).await
    }

    /// Obeys a user's request or a stopping server, given the job's `state`; `Ok` if the work continues. Everything
    /// worth keeping must have been written.
    ///
    /// # Errors
    /// [`Stop::Released`] after the job was paused, cancelled or returned.
    pub(super) async fn settle(&self, mut state: State) -> Result<(), Stop> {
        // A rejected event means that the user has requested something else in the meantime, which is then obeyed.
        while let Some(event) = answer(state, self.is_stopping()) {
            state = self.transition(Transition::plain(event)).await?;
        }
        match state {
            State::Preparing | State::Running => Ok(()),
            _ => Err(Stop::Released),
        }
    }

    /// Pauses the job until a person has dealt with `reason` and resumes it.
    pub(super) async fn rest(&self, reason: String) -> Stop {
        let because = |event| Transition { reason: Some(reason.clone()), ..Transition::plain(event) };
        let mut state = State::Running;
        loop {
            let event = match state {
                State::Running => Event::Pause,
                State::Pausing => Event::Rest,
                // No worker holds it any more, or it is being cancelled.
                state => return self.settle(state).await.err().unwrap_or(Stop::Released),
            };
            match self.transition(because(event)).await {
                Ok(next) => state = next,
                Err(lost) => return lost.into(),
            }
        }
    }

    /// Ends the job with its result.
    pub(super) async fn succeed(&self, step: Advance) -> Result<(), LeaseLost> {
        let transition = Some(Transition::plain(Event::Succeed));
        self.advance(Advance { transition, ..step }).await.map(drop)
    }

    /// Ends the job without a result.
    pub(super) async fn fail(&self, code: &str, message: String) -> Result<(), LeaseLost> {
        let failure = JobFailure { code: code.to_owned(), message: message.clone() };
        self.transition(Transition { event: Event::Fail, reason: Some(message), failure: Some(failure) })
            .await
            .map(drop)
    }
}

impl Drop for ClaimedJob {
    fn drop(&mut self) {
        self.heartbeat.abort();
    }
}

/// Renews the lease of a claim until it is lost, and notes the state of the job.
struct Renewals {
    ports: Ports,
    settings: Settings,
    claim: Claim,
    lost: CancellationToken,
    state: watch::Sender<State>,
    /// Time of the last renewal by the service's monotonic clock.
    renewed: Duration,
}

impl Renewals {
    async fn run(mut self) {
        loop {
            tokio::time::sleep(self.settings.heartbeat).await;
            let asked = self.ports.clock.elapsed();
            let renewal = self.ports.store.heartbeat(&self.claim, self.settings.lease);
            match tokio::time::timeout(self.patience(), renewal).await {
                Ok(Ok(state)) => {
                    self.renewed = asked;
                    self.state.send_replace(state);
                }
                Ok(Err(StoreError::LeaseLost { .. })) => return self.lost.cancel(),
                Ok(Err(error)) => {
                    tracing::warn!(job.id = %self.claim.job, error = %error, "a heartbeat failed");
                    if self.since_renewal() > self.settings.lease / 2 {
                        return self.lost.cancel();
                    }
                }
                Err(_) => {
                    tracing::warn!(job.id = %self.claim.job, "a heartbeat got no answer");
                    return self.lost.cancel();
                }
            }
        }
    }

    fn since_renewal(&self) -> Duration {
        self.ports.clock.elapsed().saturating_sub(self.renewed)
    }

    /// Longest wait for the answer to the next renewal: until five sixths of the lease have passed, because a slow store
    /// is not a reason to give the job up while nobody else can claim it; at least a twelfth of the lease.
    fn patience(&self) -> Duration {
        let lease = self.settings.lease;
        (lease * 5 / 6).saturating_sub(self.since_renewal()).max(lease / 12)
    }
}

/// Runs CPU-bound work on a blocking thread. A panic fails the job, because a retry would panic again.
pub(super) async fn blocking<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> Result<T, Stop> {
    let done = tokio::task::spawn_blocking(work).await;
    done.map_err(|panic| Stop::failed("internal", format!("the computation panicked: {panic}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_answer_is_accepted_and_leads_to_a_state_nobody_holds_or_to_work() {
        for found in State::ALL {
            for is_stopping in [false, true] {
                let mut state = found;
                while let Some(event) = answer(state, is_stopping) {
                    state = state.apply(event).unwrap();
                }
                let works = !is_stopping && matches!(state, State::Preparing | State::Running);
                assert!(works || !state.is_held(), "{found:?} becomes {state:?}");
            }
        }
    }

    #[test]
    fn what_a_user_asked_last_is_done_whatever_was_answered_before() {
        // The worker reads a state, a user asks for something else, and the worker's answer meets the new state.
        for (read, asked, expected) in [
            (State::Pausing, Event::Resume, State::Running),
            (State::Pausing, Event::Cancel, State::Cancelled),
            (State::Running, Event::Pause, State::Paused),
            (State::Running, Event::Cancel, State::Cancelled),
        ] {
            let mut present = read.apply(asked).unwrap();
            let mut known = read;
            let is_stopping = read == State::Running;
            while let Some(event) = answer(known, is_stopping) {
                present = present.apply(event).unwrap_or_else(|refused| refused.state);
                known = present;
            }
            assert_eq!(present, expected, "{read:?} {asked:?}");
        }
    }
}
