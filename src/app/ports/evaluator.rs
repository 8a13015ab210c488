//! The Evaluator port: where the trials of an execution are carried out, a simulated world or a robot.
//!
//! A job's loop asks the search for candidates, checks them, hands them to the evaluator and passes the outcomes on to
//! the search. The evaluator decides nothing: it brings its world to the prefix, executes, and observes.
//!
//! # Invariants of every evaluator
//! - **A physical trial is never repeated by the program.** A trial has the same [`TrialId`] whenever it is asked for,
//!   also by another process after a crash. An evaluator that acts on the physical world stores its intent under that
//!   id before it acts, and the outcome before it answers. Asked again, it answers with the stored outcome; with an
//!   intent but no outcome it does not act but answers [`Seen::Unknown`]. Only a person lifts that.
//! - **Dropping is safe.** The future of [`Evaluator::evaluate`] is dropped when the job is paused or cancelled, the
//!   server stops or the lease is lost. The same trials are asked for again, in the same process or in another one.
//! - **The same trial shows the same**, as far as the world allows: with a deterministic evaluator a run's bits depend
//!   on problem and seed only.
//!
//! # Effect of an outcome on the run
//! | outcome | meaning | effect |
//! |---|---|---|
//! | [`Seen::Observed`] | executed and observed | an evaluation; the search learns from it |
//! | [`Seen::Lost`] | executed, the observation is missing | an evaluation that teaches nothing; never repeated |
//! | [`Seen::Failed`] | refused before it began: nothing moved | a failure, not an evaluation |
//! | [`Seen::Unknown`] | whether it was executed is unknown | the search learns nothing; the job rests until a person resumes it (the trial is asked for again) or cancels it |
//!
//! [`Seen::Observed`]: crate::framework::execution::Seen::Observed
//! [`Seen::Lost`]: crate::framework::execution::Seen::Lost
//! [`Seen::Failed`]: crate::framework::execution::Seen::Failed
//! [`Seen::Unknown`]: crate::framework::execution::Seen::Unknown

use crate::app::model::JobId;
use crate::framework::execution::{Observations, Problem, ProblemError};
use crate::framework::method::per_goal::{Batch, Provenance};
use crate::framework::robot::Chain;
use async_trait::async_trait;

/// The run an evaluator is opened for.
#[derive(Clone, Copy)]
pub struct RunContext<'a> {
    /// Job of the run.
    pub job: &'a JobId,
    /// Repetition, from 0.
    pub repetition: u32,
    /// Seed of this repetition.
    pub seed: u64,
    /// Goals, robot, world and method.
    pub problem: &'a Problem,
    /// The joints that move, in the order of every candidate.
    pub chain: &'a Chain,
    /// Evaluations per second the job asks for at most.
    pub max_evaluations_per_s: Option<f64>,
}

/// Identifies a trial within its job, the same whenever the trial is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TrialId {
    /// Repetition, from 0.
    pub repetition: u32,
    /// Goal the trial is made for, from 0.
    pub goal: usize,
    /// The candidate's id within its goal.
    pub candidate: u64,
}

/// Candidates to execute. Each one follows the whole prefix, not the candidate before it.
#[derive(Clone, Copy)]
pub struct Trials<'a> {
    /// Repetition, from 0.
    pub repetition: u32,
    /// Goal they are made for, from 0.
    pub goal: usize,
    /// Poses executed in this order before each candidate, rad or m; in the course of a run it only grows.
    pub prefix: &'a [Vec<f64>],
    /// The candidates, rad or m.
    pub batch: &'a Batch,
}

impl Trials<'_> {
    /// The id of the trial of `candidate`.
    #[must_use]
    pub fn id(&self, candidate: u64) -> TrialId {
        TrialId { repetition: self.repetition, goal: self.goal, candidate }
    }
}

/// Reasons why no trial of a batch was executed.
#[derive(Debug, thiserror::Error)]
pub enum EvaluatorError {
    /// The problem cannot be evaluated here.
    #[error(transparent)]
    Problem(#[from] ProblemError),
    /// The evaluator is out of reach: the job rests until a person resumes it.
    #[error("the evaluator does not answer: {reason}")]
    Unavailable {
        /// The reason, and what to do about it.
        reason: String,
    },
}

/// Carries out the trials of one run.
#[async_trait]
pub trait Evaluator: Send {
    /// Whether trials are simulated or real. Real ones are checked against the joint limits before they are handed over.
    fn provenance(&self) -> Provenance;

    /// Maximum number of candidates per call, at least 1. A robot takes one: of several, some may be wasted, because
    /// another one ends the goal; and if one stays unknown, a later one may end the goal first and change the run's
    /// bits.
    fn most_at_once(&self) -> usize;

    /// Executes `trials` and writes the outcome of each one into `seen`; a trial left out counts as unknown.
    ///
    /// # Errors
    /// [`EvaluatorError`] if none of them was executed.
    async fn evaluate(&mut self, trials: Trials<'_>, seen: &mut Observations) -> Result<(), EvaluatorError>;
}

/// Opens evaluators; plugged in by the wiring.
#[async_trait]
pub trait Evaluators: Send + Sync {
    /// Opens the evaluator of a run, which another process may have started.
    ///
    /// # Errors
    /// [`EvaluatorError`] if there is none for this problem, or it cannot be reached.
    async fn open(&self, run: RunContext<'_>) -> Result<Box<dyn Evaluator>, EvaluatorError>;
}
