//! Rules for every engine of the store, as pure functions: an engine reads, applies a rule and writes its answer.

use super::{Advance, StoreError, Transition};
use crate::app::model::{DemonstrationView, EventData, EventPage, JobEvent, JobFailure, Timestamp};
use crate::framework::job::{Event, InvalidTransition, State};

/// Time for which an idempotency key is kept after its job ended, milliseconds.
const KEEP_KEYS_MS: i64 = 48 * 3_600_000;

/// The time before which a key must have been given, and its job must have ended, for the key to be forgotten.
#[must_use]
pub fn keys_forgotten_before(now: Timestamp) -> Timestamp {
    Timestamp(now.0 - KEEP_KEYS_MS)
}

/// Refuses a change of a revision other than the one named.
///
/// # Errors
/// [`StoreError::Revision`].
pub fn check_revision(view: &DemonstrationView, if_match: Option<u64>) -> Result<(), StoreError> {
    match if_match {
        Some(expected) if expected != view.revision => {
            Err(StoreError::Revision { id: view.id.to_string(), present: view.revision, expected })
        }
        _ => Ok(()),
    }
}

/// The part of a job that a change of state touches.
#[derive(Debug, Clone, PartialEq)]
pub struct Standing {
    /// State of the job.
    pub state: State,
    /// Reason for the state; `None` if the state says it all.
    pub reason: Option<String>,
    /// Time of the last change of state.
    pub since: Timestamp,
    /// Number of times a worker claimed it.
    pub attempt: u32,
    /// Reason of the failure; `None` unless the job failed.
    pub failure: Option<JobFailure>,
    /// Time at which a worker first started it.
    pub started_at: Option<Timestamp>,
    /// Time at which it ended.
    pub finished_at: Option<Timestamp>,
}

impl Standing {
    /// A job that was submitted at this time.
    #[must_use]
    pub fn submitted(at: Timestamp) -> Self {
        let (state, attempt) = (State::Queued, 0);
        Self { state, reason: None, since: at, attempt, failure: None, started_at: None, finished_at: None }
    }

    /// The job after `transition`.
    ///
    /// # Errors
    /// [`InvalidTransition`] if its state does not accept the event.
    pub fn moved(&self, transition: &Transition, at: Timestamp) -> Result<Self, InvalidTransition> {
        let state = self.state.apply(transition.event)?;
        let starts = state == State::Running;
        Ok(Self {
            state,
            reason: transition.reason.clone(),
            since: at,
            attempt: self.attempt,
            failure: transition.failure.clone().or_else(|| self.failure.clone()),
            started_at: self.started_at.or(starts.then_some(at)),
            finished_at: state.is_final().then_some(at),
        })
    }

    /// The event that reports this state.
    #[must_use]
    pub fn event(&self) -> EventData {
        EventData::State { state: self.state, reason: self.reason.clone(), attempt: self.attempt }
    }

    /// Whether a claim on it stays valid: a job that no worker holds has none.
    #[must_use]
    pub fn keeps_claim(&self) -> bool {
        self.state.is_held()
    }

    /// Whether its checkpoint is still needed.
    #[must_use]
    pub fn keeps_checkpoint(&self) -> bool {
        !self.state.is_final()
    }
}

/// Cause of the loss of a worker.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Loss {
    /// The server it belonged to is gone.
    ServerStopped,
    /// The lease of the worker ran out.
    LeaseRanOut,
}

impl Loss {
    fn reason(self) -> &'static str {
        match self {
            Self::ServerStopped => "the server stopped",
            Self::LeaseRanOut => "the worker stopped answering",
        }
    }
}

/// The changes of state that take a job back from a lost worker: into the queue again, or to the end it was asked for.
///
/// # Errors
/// [`InvalidTransition`] if no worker holds a job in this state.
pub fn take_back(state: State, loss: Loss) -> Result<Vec<Transition>, InvalidTransition> {
    let lose = Transition { reason: Some(loss.reason().to_owned()), ..Transition::plain(Event::LoseWorker) };
    let mut steps = vec![lose];
    if state.apply(Event::LoseWorker)? == State::Interrupted {
        steps.push(Transition::plain(Event::Requeue));
    }
    Ok(steps)
}

/// The failure of a job that lost its worker `max_crashes` times in a row without progress: we assume that it crashes
/// the worker. `None` if it may be tried again.
#[must_use]
pub fn quarantine(crashes: u32, max_crashes: u32) -> Option<Transition> {
    if crashes < max_crashes {
        return None;
    }
    let message = format!("its worker was lost {crashes} times in a row without progress");
    let failure = JobFailure { code: "quarantined".to_owned(), message: message.clone() };
    Some(Transition { event: Event::Fail, reason: Some(message), failure: Some(failure) })
}

/// Whether a step is progress, which resets the count of crashes: a checkpoint, or something that the job made.
#[must_use]
pub fn is_progress(step: &Advance) -> bool {
    step.checkpoint.is_some() || !step.products.is_empty()
}

/// The number of the event after number `last_seq`; 0 is before the first event.
#[must_use]
pub fn next_seq(last_seq: u64) -> u64 {
    last_seq + 1
}

/// The last event of a job and whether it is final, read before its events: what comes later is not shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tail {
    /// Number of its last event.
    pub last_seq: u64,
    /// Whether it ended.
    pub is_final: bool,
}

/// The page of `events` after `after_seq`, in order and up to the tail. A position that is unknown, or whose next
/// event is missing, asks the reader to begin anew.
#[must_use]
pub fn event_page(after_seq: u64, tail: Tail, events: Vec<JobEvent>) -> EventPage {
    let Tail { last_seq, is_final } = tail;
    if after_seq > last_seq {
        return EventPage { events: Vec::new(), resync: true, last_seq, end: false };
    }
    let seen = events.last().map_or(after_seq, |event| event.seq);
    let resync = events.first().is_some_and(|event| event.seq != next_seq(after_seq));
    EventPage { events, resync, last_seq, end: is_final && seen == last_seq }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::model::JobId;

    const AT: Timestamp = Timestamp(1_700_000_000_000);
    const LATER: Timestamp = Timestamp(1_700_000_001_000);

    fn after(events: &[Event]) -> Standing {
        let moved = |job: Standing, event: &Event| job.moved(&Transition::plain(*event), LATER).unwrap();
        events.iter().fold(Standing::submitted(AT), moved)
    }

    #[test]
    fn a_job_starts_once_and_ends_once() {
        let running = after(&[Event::Claim, Event::Start]);
        assert_eq!((running.started_at, running.finished_at), (Some(LATER), None));
        let again = running.moved(&Transition::plain(Event::Pause), AT).unwrap();
        assert_eq!(again.started_at, Some(LATER));
        let cancelled = after(&[Event::Cancel]);
        assert_eq!((cancelled.started_at, cancelled.finished_at), (None, Some(LATER)));
        assert!(!cancelled.keeps_checkpoint() && !cancelled.keeps_claim());
        assert!(cancelled.moved(&Transition::plain(Event::Cancel), AT).is_err());
    }

    #[test]
    fn a_lost_job_goes_back_into_the_queue_unless_it_was_to_end() {
        let events = |state| take_back(state, Loss::LeaseRanOut).unwrap().iter().map(|t| t.event).collect::<Vec<_>>();
        assert_eq!(events(State::Running), [Event::LoseWorker, Event::Requeue]);
        assert_eq!(events(State::Cancelling), [Event::LoseWorker]);
        let first = &take_back(State::Running, Loss::ServerStopped).unwrap()[0];
        assert_eq!(first.reason.as_deref(), Some("the server stopped"));
        assert!(take_back(State::Queued, Loss::LeaseRanOut).is_err());
    }

    #[test]
    fn a_job_is_tried_until_it_crashed_too_often() {
        assert_eq!(quarantine(2, 3), None);
        let failed = quarantine(3, 3).unwrap();
        assert_eq!((failed.event, failed.failure.unwrap().code.as_str()), (Event::Fail, "quarantined"));
        assert!(is_progress(&Advance { checkpoint: Some(vec![1]), ..Advance::default() }));
        assert!(!is_progress(&Advance {
            progress: Some(crate::app::model::JobProgress::default()),
            ..Advance::default()
        }));
    }

    #[test]
    fn keys_are_kept_for_two_days() {
        assert_eq!(keys_forgotten_before(AT).0, AT.0 - 172_800_000);
    }

    #[test]
    fn a_page_ends_with_the_last_event_of_a_final_job_and_tells_a_gap() {
        let event =
            |seq| JobEvent { seq, job: JobId::from_uuid(uuid::Uuid::from_u128(1)), at: AT, data: after(&[]).event() };
        let tail = Tail { last_seq: 3, is_final: true };
        let page = event_page(1, tail, vec![event(2), event(3)]);
        assert!(page.end && !page.resync);
        assert!(!event_page(0, tail, vec![event(1)]).end);
        assert!(event_page(0, tail, vec![event(2)]).resync, "event 1 is missing");
        assert!(event_page(4, tail, Vec::new()).resync, "the job has 3 events");
        assert!(event_page(3, tail, Vec::new()).end);
    }
}
