//! Unit tests of the jobs on a service in memory. Nothing here waits for a time to pass: tests wait for events, and the
//! clock of leases is moved by hand.

mod experiment;
mod generalization;
mod lease;
mod unknown_trial;

use super::Settings;
use super::lease::ClaimedJob;
use crate::app::bench::Bench;
use crate::app::model::{JobId, JobView, Work};
use crate::app::ports::{Claimed, Events as _, Jobs as _, Transition};
use crate::framework::job::{Event, State};
use std::time::Duration;
use tokio_util::sync::CancellationToken;

/// Frequent heartbeats and checkpoints, and a lease that only ends if a test moves the clock.
fn settings() -> Settings {
    Settings {
        workers: 1,
        lease: Duration::from_hours(1),
        heartbeat: Duration::from_millis(1),
        checkpoint: Duration::from_millis(5),
        ..Settings::default()
    }
}

/// A claimed job as the `run` of its kind gets it.
struct Held {
    claimed: ClaimedJob,
    /// In state `Preparing`.
    job: JobView,
    work: Work,
    /// Stops the server.
    stop: CancellationToken,
}

/// Claims the oldest queued job.
async fn claim(bench: &Bench) -> Held {
    claim_with(bench, settings()).await
}

/// Like [`claim`], with other settings.
async fn claim_with(bench: &Bench, settings: Settings) -> Held {
    let (ports, stop) = (&bench.ports, CancellationToken::new());
    let claimed = ports.store.claim(ports.ids.token(), settings.lease, 3, ports.clock.now()).await.unwrap();
    let Claimed { claim, job, work, .. } = claimed.unwrap();
    let claimed = ClaimedJob::new(ports.clone(), settings, claim, stop.clone());
    Held { claimed, job, work, stop }
}

/// Asks for something as a user does.
async fn ask(bench: &Bench, id: &JobId, event: Event) {
    let now = bench.ports.clock.now();
    bench.store.apply_event(id, Transition::plain(event), now).await.unwrap();
}

/// The job as soon as it meets `condition`, which it must before its end.
async fn until(bench: &Bench, id: &JobId, condition: impl Fn(&JobView) -> bool) -> JobView {
    let mut wakes = bench.events.subscribe();
    loop {
        let job = bench.store.job(id).await.unwrap();
        if condition(&job) {
            return job;
        }
        assert!(!job.state.is_final(), "{job:?}");
        // A receiver that lags looks again, too.
        let _ = wakes.recv().await;
    }
}

/// The job as soon as it is in `state`.
async fn in_state(bench: &Bench, id: &JobId, state: State) -> JobView {
    until(bench, id, |job| job.state == state).await
}
