//! Jobs as workers hold them.

use super::{Connection, Data, Job, Lease, MemoryStore, found, taken};
use crate::app::model::{ActionGoals, ActionView, JobId, Timestamp};
use crate::app::ports::rules::{Loss, is_progress, quarantine, take_back};
use crate::app::ports::store::{Advance, Claim, Claimed, NewRun, Product, Queue, StoreError, Transition};
use crate::framework::experiment::RunRow;
use crate::framework::job::{Event, State};
use async_trait::async_trait;
use std::time::Duration;

impl Data {
    /// The job that `claim` holds.
    fn held(&mut self, claim: &Claim) -> Result<&mut Job, StoreError> {
        let epoch = self.epoch;
        let holds = |lease: &Lease| lease.token == claim.token && lease.epoch == epoch;
        let held = self.jobs.get_mut(&claim.job).filter(|job| job.lease.as_ref().is_some_and(holds));
        held.ok_or_else(|| StoreError::LeaseLost { job: claim.job.clone() })
    }

    fn lose(&mut self, loss: Loss, is_lost: impl Fn(&Lease) -> bool, at: Timestamp) -> Result<Vec<JobId>, StoreError> {
        let mut lost = Vec::new();
        for job in self.jobs.values_mut().filter(|job| job.lease.as_ref().is_some_and(&is_lost)) {
            for transition in take_back(job.view.state, loss)? {
                job.apply(&transition, at)?;
            }
            lost.push(job.view.id.clone());
        }
        Ok(lost)
    }

    fn claim(&mut self, lease: Lease, max_crashes: u32, at: Timestamp) -> Result<Option<Claimed>, StoreError> {
        let claimed = loop {
            let Some(job) = self.jobs.values_mut().find(|job| job.view.state == State::Queued) else {
                return Ok(None);
            };
            match quarantine(job.crashes, max_crashes) {
                Some(failure) => drop(job.apply(&failure, at)?),
                None => break job,
            }
        };
        claimed.view.attempt += 1;
        claimed.crashes += 1;
        let claim = Claim { job: claimed.view.id.clone(), token: lease.token.clone() };
        claimed.lease = Some(lease);
        claimed.apply(&Transition::plain(Event::Claim), at)?;
        let job = claimed.clone();
        Ok(Some(Claimed { claim, job: self.view(&job), work: job.work, checkpoint: job.checkpoint }))
    }

    fn insert_action(&mut self, mut view: ActionView, goals: ActionGoals) {
        let versions = self.actions.values().filter(|(other, _)| other.name == view.name);
        view.version = versions.map(|(other, _)| other.version).max().unwrap_or(0) + 1;
        self.actions.insert(view.id.clone(), (view, goals));
    }

    fn insert_run(&mut self, new: NewRun) -> Result<(), StoreError> {
        let place = |run: &NewRun| (run.view.job.clone(), run.view.repetition);
        if self.runs.contains_key(&new.view.id) || self.runs.values().any(|run| place(run) == place(&new)) {
            return Err(taken("run"));
        }
        self.runs.insert(new.view.id.clone(), new);
        Ok(())
    }

    fn insert_row(&mut self, job: &JobId, row: RunRow) -> Result<(), StoreError> {
        let of_job = self.experiments.values_mut().find(|kept| kept.new.view.job == *job);
        let experiment = found(of_job, "experiment of job", job)?;
        match experiment.rows.insert((row.id.cell, row.id.repetition), row) {
            Some(_) => Err(taken("row")),
            None => Ok(()),
        }
    }

    fn advance(&mut self, claim: &Claim, step: Advance, at: Timestamp) -> Result<State, StoreError> {
        self.held(claim)?;
        let is_progress = is_progress(&step);
        let Advance { products, progress, checkpoint, events, transition } = step;
        for product in products {
            match product {
                Product::Action(made) => self.insert_action(made.0, made.1),
                Product::Run(run) => self.insert_run(*run)?,
                Product::Rows(rows) => rows.into_iter().try_for_each(|row| self.insert_row(&claim.job, row))?,
            }
        }
        let job = self.held(claim)?;
        if is_progress {
            job.crashes = 0;
        }
        if let Some(progress) = progress {
            job.view.progress = progress;
        }
        job.checkpoint = checkpoint.or_else(|| job.checkpoint.take());
        for event in events {
            job.append(event, at);
        }
        match transition {
            Some(transition) => job.apply(&transition, at),
            None => Ok(job.view.state),
        }
    }
}

#[async_trait]
impl Queue for MemoryStore {
    async fn begin_epoch(&self, at: Timestamp) -> Result<Vec<JobId>, StoreError> {
        self.write(|data| {
            data.epoch += 1;
            let epoch = data.epoch;
            data.lose(Loss::ServerStopped, |lease| lease.epoch != epoch, at)
        })
    }

    async fn claim(
        &self,
        token: String,
        lease: Duration,
        max_crashes: u32,
        at: Timestamp,
    ) -> Result<Option<Claimed>, StoreError> {
        let until = self.clock.elapsed() + lease;
        self.write(|data| data.claim(Lease { token, epoch: data.epoch, until }, max_crashes, at))
    }

    async fn heartbeat(&self, claim: &Claim, lease: Duration) -> Result<State, StoreError> {
        let mut connection = self.connection.subscribe();
        connection
            .wait_for(|connection| *connection != Connection::Hanging)
            .await
            .map_err(|_| StoreError::Unavailable)?;
        let until = self.clock.elapsed() + lease;
        self.write(|data| {
            let job = data.held(claim)?;
            if let Some(held) = &mut job.lease {
                held.until = until;
            }
            Ok(job.view.state)
        })
    }

    async fn advance(&self, claim: &Claim, step: Advance, at: Timestamp) -> Result<State, StoreError> {
        self.write(|data| data.advance(claim, step, at))
    }

    async fn reap(&self, at: Timestamp) -> Result<Vec<JobId>, StoreError> {
        let now = self.clock.elapsed();
        self.write(|data| data.lose(Loss::LeaseRanOut, |lease| lease.until < now, at))
    }
}
