//! One running repetition: ask, check, evaluate, tell, through the Evaluator port.
//!
//! # Invariants
//! - Slicing does not change a bit: a batch whose slice was interrupted before its evaluation is evaluated by the next
//!   one.
//! - A real trial outside the joint limits never reaches the evaluator; the search is told that it failed.
//! - The search is told nothing about a trial whose outcome is unknown. Its saved state asks for that trial again,
//!   which only a person may cause.

use crate::app::ports::{Evaluator, EvaluatorError, TrialId, Trials};
use crate::framework::execution::{Iet, Observations, ProblemError, Seen};
use crate::framework::method::per_goal::{Batch, Provenance};
use std::collections::BTreeSet;
use tokio::time::Instant;

/// Reason why a slice ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum SliceEnd {
    /// Its time is up, or it was interrupted.
    Due,
    /// Every goal has ended.
    Finished,
    /// Nobody knows whether this trial was executed.
    Unknown(TrialId),
}

/// Reasons why a slice failed.
#[derive(Debug, thiserror::Error)]
pub(super) enum SliceError {
    #[error(transparent)]
    Problem(#[from] ProblemError),
    #[error(transparent)]
    Evaluator(#[from] EvaluatorError),
}

/// A search and the evaluator that carries out its trials.
pub(super) struct Search {
    pub(super) iet: Iet,
    evaluator: Box<dyn Evaluator>,
    repetition: u32,
    prefix: Vec<Vec<f64>>,
    /// Proposed candidates whose outcomes the search has not been told.
    asked: Batch,
    /// Those of them that may be executed.
    checked: Batch,
    seen: Observations,
}

impl Search {
    /// A search whose trials `evaluator` carries out.
    pub(super) fn new(iet: Iet, evaluator: Box<dyn Evaluator>, repetition: u32) -> Self {
        let (genes, features) = (iet.chain().len(), iet.world_features());
        let most = evaluator.most_at_once().max(1);
        Self {
            seen: Observations::new(genes, features, evaluator.provenance()),
            asked: Batch::new(genes, most),
            checked: Batch::new(genes, most),
            prefix: Vec::new(),
            iet,
            evaluator,
            repetition,
        }
    }

    /// Evaluates batches until `due` or until `interrupted` returns; at least one batch unless it is interrupted.
    pub(super) async fn slice(
        &mut self,
        due: Instant,
        interrupted: impl Future<Output = ()>,
    ) -> Result<SliceEnd, SliceError> {
        tokio::pin!(interrupted);
        while !self.iet.is_finished() {
            self.ask();
            self.check();
            if !self.checked.is_empty() {
                let trials = Trials {
                    repetition: self.repetition,
                    goal: self.iet.goal_index(),
                    prefix: &self.prefix,
                    batch: &self.checked,
                };
                tokio::select! {
                    // A request that can be answered at once takes precedence.
                    biased;
                    evaluated = self.evaluator.evaluate(trials, &mut self.seen) => evaluated?,
                    () = &mut interrupted => return Ok(SliceEnd::Due),
                }
            }
            let unknown = self.unknown();
            self.iet.tell(&self.seen)?;
            self.asked.clear(0);
            if let Some(trial) = unknown {
                return Ok(SliceEnd::Unknown(trial));
            }
            if Instant::now() >= due {
                break;
            }
        }
        Ok(if self.iet.is_finished() { SliceEnd::Finished } else { SliceEnd::Due })
    }

    /// Asks the search for the next candidates and the prefix before them, unless some are left of an interrupted slice.
    fn ask(&mut self) {
        self.seen.clear();
        if !self.asked.is_empty() {
            return;
        }
        let known = self.prefix.len();
        self.prefix.extend(self.iet.prefix().skip(known).map(<[f64]>::to_vec));
        self.asked.clear(self.evaluator.most_at_once().max(1));
        self.iet.ask(&mut self.asked);
    }

    /// Selects the candidates that may be executed; real ones outside the joint limits count as failed.
    fn check(&mut self) {
        self.checked.clear(self.asked.len());
        let is_real = self.evaluator.provenance() == Provenance::Real;
        for (id, joints) in self.asked.iter() {
            if is_real && !within_limits(&self.iet, joints) {
                self.seen.failed(id, joints);
            } else {
                self.checked.push(id, joints);
            }
        }
    }

    /// The first trial whose outcome is unknown; a trial that the evaluator left out counts as unknown. `None` if every
    /// outcome is known.
    fn unknown(&self) -> Option<TrialId> {
        let known = || self.seen.iter().filter(|(_, _, seen)| *seen != Seen::Unknown).map(|(id, ..)| id);
        if known().count() == self.asked.len() {
            return None;
        }
        let known: BTreeSet<u64> = known().collect();
        let candidate = self.asked.iter().map(|(id, _)| id).find(|id| !known.contains(id))?;
        Some(TrialId { repetition: self.repetition, goal: self.iet.goal_index(), candidate })
    }
}

fn within_limits(iet: &Iet, joints: &[f64]) -> bool {
    let genes = iet.chain().genes();
    joints.len() == genes.len()
        && joints.iter().zip(genes).all(|(joint, gene)| (gene.lower..=gene.upper).contains(joint))
}
