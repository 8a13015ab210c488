//! Jobs: submitted once, run durably, watched by events with a durable sequence.

mod kind;
mod reference;
#[cfg(test)]
mod tests;
mod trial_reuse;
mod validate;
mod watch;

use crate::app::model::{
    AppError, CreateJob, ErrorKind, EventPage, JobFilter, JobId, JobResult, JobView, Keyset, Page, PageQuery, limits,
};
use crate::app::ports::{IdempotencyKey, NewJob, Submitted, Transition, Wake};
use crate::app::{UseCases, within};
use crate::framework::job::{Event, State};
use kind::Resolved;
use sha2::{Digest as _, Sha256};

impl UseCases {
    /// Resolves and submits a job.
    ///
    /// # Errors
    /// `Invalid` request, or a key that was used with another body; `NotFound` never: a wrong reference is `Invalid`.
    pub async fn create_job(&self, request: CreateJob, idempotency_key: Option<String>) -> Result<JobView, AppError> {
        let body = serde_json::to_vec(&request).map_err(AppError::internal)?;
        let key = idempotency_key.map(|key| checked_key(key, &body)).transpose()?;
        // What was submitted before is answered even if what it names is gone meanwhile.
        if let Some(key) = &key
            && let Some(job) = self.ports.store.submitted(key).await?
        {
            return Ok(job);
        }
        let resolved = kind::resolve(self, request).await?;
        self.submit(resolved, key).await
    }

    async fn submit(&self, resolved: Resolved, key: Option<IdempotencyKey>) -> Result<JobView, AppError> {
        let now = self.now();
        let view = JobView {
            id: JobId::from_uuid(self.ports.ids.uuid()),
            kind: resolved.work.kind(),
            name: resolved.name,
            state: State::Queued,
            state_reason: None,
            state_since: now,
            attempt: 0,
            progress: resolved.progress,
            request: resolved.request,
            result: JobResult::default(),
            failure: None,
            last_seq: 0,
            created_at: now,
            started_at: None,
            finished_at: None,
        };
        let experiment = resolved.experiment.map(|(id, plan)| kind::experiment::stored(id, plan, &view));
        let new = NewJob { view, work: resolved.work, uses: resolved.uses, experiment };
        match self.ports.store.submit(new, key).await? {
            Submitted::Created(job) => {
                tracing::info!(job.id = %job.id, job.caller = %self.caller, "job submitted");
                self.ports.events.publish(Wake::Queued);
                Ok(job)
            }
            Submitted::Existing(job) => Ok(job),
        }
    }

    /// Lists jobs, newest first.
    ///
    /// # Errors
    /// `Malformed` page.
    pub async fn list_jobs(&self, filter: JobFilter, page: PageQuery) -> Result<Page<JobView>, AppError> {
        let keyset = Keyset::new(&page, &format!("jobs {filter:?}"))?;
        let jobs = self.ports.store.jobs(&filter, &keyset).await?;
        Ok(keyset.page(jobs, |job| job.id.to_string()))
    }

    /// Reads one job.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn get_job(&self, id: &JobId) -> Result<JobView, AppError> {
        Ok(self.ports.store.job(id).await?)
    }

    /// Asks a job to pause at its next checkpoint.
    ///
    /// # Errors
    /// `NotFound`; `Conflict` if its state does not allow it.
    pub async fn pause_job(&self, id: &JobId) -> Result<JobView, AppError> {
        self.apply_event(id, Event::Pause).await
    }

    /// Resumes a paused job.
    ///
    /// # Errors
    /// `NotFound`; `Conflict` if its state does not allow it.
    pub async fn resume_job(&self, id: &JobId) -> Result<JobView, AppError> {
        self.apply_event(id, Event::Resume).await
    }

    /// Asks a job to end without a result; finished runs are kept.
    ///
    /// # Errors
    /// `NotFound`; `Conflict` if it has ended already.
    pub async fn cancel_job(&self, id: &JobId) -> Result<JobView, AppError> {
        self.apply_event(id, Event::Cancel).await
    }

    async fn apply_event(&self, id: &JobId, event: Event) -> Result<JobView, AppError> {
        let job = self.ports.store.apply_event(id, Transition::plain(event), self.now()).await?;
        self.ports.events.publish(Wake::Job(id.clone()));
        if job.state == State::Queued {
            self.ports.events.publish(Wake::Queued);
        }
        Ok(job)
    }

    /// Submits the same resolved job again, with the same seed.
    ///
    /// # Errors
    /// `NotFound`; with an idempotency key as for [`UseCases::create_job`].
    pub async fn clone_job(&self, id: &JobId, idempotency_key: Option<String>) -> Result<JobView, AppError> {
        let key = idempotency_key.map(|key| checked_key(key, format!("clone {id}").as_bytes())).transpose()?;
        let job = self.get_job(id).await?;
        let work = self.ports.store.work(id).await?;
        let resolved = kind::again(self, job, work).await?;
        self.submit(resolved, key).await
    }

    /// Events after `after_seq` (0 is from the first), at most `limit`.
    ///
    /// # Errors
    /// `NotFound`; `Malformed` limit.
    pub async fn job_events(&self, id: &JobId, after_seq: u64, limit: u32) -> Result<EventPage, AppError> {
        within("limit", limit, &limits::EVENTS)?;
        Ok(self.ports.store.events(id, after_seq, limit).await?)
    }
}

fn checked_key(key: String, body: &[u8]) -> Result<IdempotencyKey, AppError> {
    if !limits::IDEMPOTENCY_KEY_CHARS.contains(&limits::count(key.len()))
        || !key.bytes().all(|b| b.is_ascii_graphic() || b == b' ')
    {
        let bounds = limits::in_words(&limits::IDEMPOTENCY_KEY_CHARS);
        let message = format!("an idempotency key has {bounds} visible ASCII characters, this one has {}", key.len());
        return Err(AppError::new(ErrorKind::Malformed, "invalid_idempotency_key", message));
    }
    Ok(IdempotencyKey { key, body_sha256: hex::encode(Sha256::digest(body)) })
}
