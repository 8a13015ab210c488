//! Following a job: stored events first, then live ones.
//!
//! A follower reads the store in pages and is woken by hints; it holds at most one page, however slow its reader is.

use crate::app::UseCases;
use crate::app::model::{AppError, EventData, JobEvent, JobId, JobView, limits};
use crate::app::ports::Wake;
use futures_util::StreamExt as _;
use futures_util::stream::{self, BoxStream};
use std::collections::VecDeque;
use std::time::Duration;
use tokio::sync::broadcast::{Receiver, error::RecvError};
use tokio::time::timeout;

/// Maximum delay caused by a lost hint.
const LOOK_AGAIN: Duration = Duration::from_secs(1);

struct Follower {
    app: UseCases,
    id: JobId,
    after_seq: u64,
    wakes: Receiver<Wake>,
    page: VecDeque<JobEvent>,
    end: bool,
}

impl Follower {
    async fn next(&mut self) -> Result<Option<JobEvent>, AppError> {
        loop {
            if let Some(event) = self.page.pop_front() {
                self.after_seq = event.seq;
                return Ok(Some(event));
            }
            if self.end {
                return Ok(None);
            }
            let page = self.app.job_events(&self.id, self.after_seq, *limits::EVENTS.end()).await?;
            if page.resync {
                self.after_seq = page.last_seq;
                self.end = self.app.get_job(&self.id).await?.state.is_final();
                let at = self.app.now();
                return Ok(Some(JobEvent { seq: page.last_seq, job: self.id.clone(), at, data: EventData::Resync }));
            }
            self.end = page.end;
            self.page = page.events.into();
            if self.page.is_empty() && !self.end {
                // A missing hint is compensated by looking again.
                let _ = timeout(LOOK_AGAIN, woken(&mut self.wakes, &self.id)).await;
            }
        }
    }
}

/// Returns when the job `id` may have changed.
async fn woken(wakes: &mut Receiver<Wake>, id: &JobId) {
    loop {
        match wakes.recv().await {
            Ok(Wake::Job(job)) if job == *id => return,
            Ok(_) => {}
            Err(RecvError::Lagged(_)) => return,
            // Nothing publishes any more; only the timeout remains.
            Err(RecvError::Closed) => std::future::pending().await,
        }
    }
}

impl UseCases {
    /// Streams every event after `after_seq`: stored ones first, then live ones; ends after the event of a final state.
    ///
    /// An unknown position gives one `resync` event; the stream then continues after the job's last event.
    ///
    /// # Errors
    /// `NotFound`. The stream itself ends with an error if the store fails.
    pub async fn watch_job(
        &self,
        id: &JobId,
        after_seq: u64,
    ) -> Result<BoxStream<'static, Result<JobEvent, AppError>>, AppError> {
        // Subscribes before the first read, so that no event is missed in between.
        let wakes = self.ports.events.subscribe();
        self.get_job(id).await?;
        let follower =
            Follower { app: self.clone(), id: id.clone(), after_seq, wakes, page: VecDeque::new(), end: false };
        let events = stream::unfold(Some(follower), |state| async {
            let mut follower = state?;
            match follower.next().await {
                Ok(event) => event.map(|event| (Ok(event), Some(follower))),
                Err(error) => Some((Err(error), None)),
            }
        });
        Ok(events.boxed())
    }

    /// Returns the job as soon as it has an event after `after_seq` or is final, at the latest after `limit` (at most
    /// 60 s).
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn wait_job(&self, id: &JobId, after_seq: u64, limit: Duration) -> Result<JobView, AppError> {
        let mut wakes = self.ports.events.subscribe();
        let time_is_up = tokio::time::sleep(limit.min(Duration::from_millis(u64::from(limits::MAX_WAIT_MS))));
        tokio::pin!(time_is_up);
        loop {
            let job = self.get_job(id).await?;
            if job.last_seq > after_seq || job.state.is_final() {
                return Ok(job);
            }
            tokio::select! {
                _ = timeout(LOOK_AGAIN, woken(&mut wakes, id)) => {}
                () = &mut time_is_up => return self.get_job(id).await,
            }
        }
    }
}
