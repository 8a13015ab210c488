//! Jobs as users see and steer them.

use super::{Data, Experiment, Job, Key, MemoryStore, found, page};
use crate::app::model::{
    EventData, EventPage, JobEvent, JobFilter, JobId, JobResult, JobView, Keyset, Timestamp, Work,
};
use crate::app::ports::rules::{Standing, Tail, event_page, keys_forgotten_before, next_seq};
use crate::app::ports::store::{IdempotencyKey, Jobs, NewJob, StoreError, Submitted, Transition};
use crate::framework::job::State;
use async_trait::async_trait;
use std::collections::BTreeMap;

impl Job {
    fn standing(&self) -> Standing {
        let JobView { state, state_reason, state_since, attempt, failure, started_at, finished_at, .. } =
            self.view.clone();
        Standing { state, reason: state_reason, since: state_since, attempt, failure, started_at, finished_at }
    }

    /// Appends an event and gives it the next number.
    pub(super) fn append(&mut self, data: EventData, at: Timestamp) {
        self.view.last_seq = next_seq(self.view.last_seq);
        self.events.push(JobEvent { seq: self.view.last_seq, job: self.view.id.clone(), at, data });
    }

    /// Moves the job to its next state and appends the event that reports it.
    pub(super) fn apply(&mut self, transition: &Transition, at: Timestamp) -> Result<State, StoreError> {
        let standing = self.standing().moved(transition, at)?;
        let event = standing.event();
        if !standing.keeps_claim() {
            self.lease = None;
        }
        if !standing.keeps_checkpoint() {
            self.checkpoint = None;
        }
        let Standing { state, reason, since, attempt, failure, started_at, finished_at } = standing;
        let view = self.view.clone();
        self.view = JobView {
            state,
            state_reason: reason,
            state_since: since,
            attempt,
            failure,
            started_at,
            finished_at,
            ..view
        };
        self.append(event, at);
        Ok(state)
    }
}

impl Data {
    /// The job with what it made so far.
    pub(super) fn view(&self, job: &Job) -> JobView {
        let id = &job.view.id;
        let mut runs: Vec<_> = self.runs.values().filter(|run| run.view.job == *id).collect();
        runs.sort_by_key(|run| run.view.repetition);
        let result = JobResult {
            action: self.actions.values().find(|(action, _)| action.job == *id).map(|(action, _)| action.id.clone()),
            runs: runs.iter().map(|run| run.view.id.clone()).collect(),
            experiment: self
                .experiments
                .values()
                .find(|kept| kept.new.view.job == *id)
                .map(|kept| kept.new.view.id.clone()),
        };
        JobView { result, ..job.view.clone() }
    }

    fn by_key(&self, key: &IdempotencyKey) -> Result<Option<JobView>, StoreError> {
        let Some(given) = self.keys.get(&key.key) else { return Ok(None) };
        if given.body_sha256 != key.body_sha256 {
            return Err(StoreError::KeyReused { key: key.key.clone() });
        }
        Ok(self.jobs.get(&given.job).map(|job| self.view(job)))
    }

    fn forget_keys(&mut self, before: Timestamp) {
        let ended = |job: &JobId| self.jobs.get(job).and_then(|job| job.view.finished_at);
        self.keys.retain(|_, key| key.given_at >= before || ended(&key.job).is_none_or(|at| at >= before));
    }

    fn submit(&mut self, new: NewJob, key: Option<IdempotencyKey>) -> Result<Submitted, StoreError> {
        let at = new.view.created_at;
        if let Some(key) = key {
            self.forget_keys(keys_forgotten_before(at));
            if let Some(job) = self.by_key(&key)? {
                return Ok(Submitted::Existing(job));
            }
            let IdempotencyKey { key, body_sha256 } = key;
            self.keys.insert(key, Key { body_sha256, job: new.view.id.clone(), given_at: at });
        }
        let NewJob { view, work, uses, experiment } = new;
        let id = view.id.clone();
        let mut job = Job { view, work, uses, crashes: 0, lease: None, checkpoint: None, events: Vec::new() };
        job.append(Standing::submitted(at).event(), at);
        if let Some(new) = experiment {
            self.experiments.insert(new.view.id.clone(), Experiment { new, rows: BTreeMap::new() });
        }
        let view = self.view(&job);
        self.jobs.insert(id, job);
        Ok(Submitted::Created(view))
    }
}

#[async_trait]
impl Jobs for MemoryStore {
    async fn submit(&self, new: NewJob, key: Option<IdempotencyKey>) -> Result<Submitted, StoreError> {
        self.write(|data| data.submit(new, key))
    }

    async fn submitted(&self, key: &IdempotencyKey) -> Result<Option<JobView>, StoreError> {
        self.read(|data| data.by_key(key))
    }

    async fn job(&self, id: &JobId) -> Result<JobView, StoreError> {
        self.read(|data| found(data.jobs.get(id).map(|job| data.view(job)), "job", id))
    }

    async fn work(&self, id: &JobId) -> Result<Work, StoreError> {
        self.read(|data| found(data.jobs.get(id).map(|job| job.work.clone()), "job", id))
    }

    async fn jobs(&self, filter: &JobFilter, keyset: &Keyset) -> Result<Vec<JobView>, StoreError> {
        let is_wanted = |job: &Job| {
            (filter.states.is_empty() || filter.states.contains(&job.view.state))
                && filter.kind.is_none_or(|kind| kind == job.view.kind)
        };
        Ok(self.read(|data| page(&data.jobs, keyset, is_wanted).iter().map(|job| data.view(job)).collect()))
    }

    async fn events(&self, id: &JobId, after_seq: u64, limit: u32) -> Result<EventPage, StoreError> {
        let job = self.read(|data| found(data.jobs.get(id).cloned(), "job", id))?;
        let tail = Tail { last_seq: job.view.last_seq, is_final: job.view.state.is_final() };
        let events = job.events.into_iter().filter(|event| event.seq > after_seq).take(limit as usize);
        Ok(event_page(after_seq, tail, events.collect()))
    }

    async fn apply_event(&self, id: &JobId, transition: Transition, at: Timestamp) -> Result<JobView, StoreError> {
        self.write(|data| {
            found(data.jobs.get_mut(id), "job", id)?.apply(&transition, at)?;
            found(data.jobs.get(id).map(|job| data.view(job)), "job", id)
        })
    }
}
