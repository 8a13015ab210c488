//! A decorator that limits the rate of evaluations, for jobs that people want to watch.
//!
//! It waits before it executes a batch, never between executing and answering: dropping the future while it waits loses
//! no trial. The rate changes no bit of a result.

use crate::app::ports::{Evaluator, EvaluatorError, Evaluators, RunContext, Trials};
use crate::framework::execution::Observations;
use crate::framework::method::per_goal::Provenance;
use async_trait::async_trait;
use std::time::Duration;
use tokio::time::Instant;

/// Approximate time per batch, s.
const BATCH_S: f64 = 0.1;

/// An evaluator with a limited rate.
pub struct Paced {
    inner: Box<dyn Evaluator>,
    /// Limit, evaluations per second.
    per_s: f64,
    /// Earliest start of the next batch.
    due: Instant,
}

impl Paced {
    /// Limits `inner` to about `per_s` evaluations per second.
    #[must_use]
    pub fn new(inner: Box<dyn Evaluator>, per_s: f64) -> Self {
        Self { inner, per_s, due: Instant::now() }
    }
}

#[async_trait]
impl Evaluator for Paced {
    fn provenance(&self) -> Provenance {
        self.inner.provenance()
    }

    fn most_at_once(&self) -> usize {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a rate times a time, >= 0")]
        let wanted = (self.per_s * BATCH_S) as usize;
        wanted.clamp(1, self.inner.most_at_once())
    }

    async fn evaluate(&mut self, trials: Trials<'_>, seen: &mut Observations) -> Result<(), EvaluatorError> {
        tokio::time::sleep_until(self.due).await;
        let took_s = trials.batch.len() as f64 / self.per_s;
        self.due = Instant::now() + Duration::from_secs_f64(took_s.clamp(0.0, 3600.0));
        self.inner.evaluate(trials, seen).await
    }
}

/// Limits every evaluator of `inner` to the rate that its job requests; without one, it is not limited.
pub struct PacedEvaluators<E>(pub E);

#[async_trait]
impl<E: Evaluators> Evaluators for PacedEvaluators<E> {
    async fn open(&self, run: RunContext<'_>) -> Result<Box<dyn Evaluator>, EvaluatorError> {
        let inner = self.0.open(run).await?;
        Ok(match run.max_evaluations_per_s {
            Some(per_s) => Box::new(Paced::new(inner, per_s)),
            None => inner,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::framework::method::per_goal::Batch;

    /// Answers immediately.
    struct Instantly;

    #[async_trait]
    impl Evaluator for Instantly {
        fn provenance(&self) -> Provenance {
            Provenance::Simulated
        }

        fn most_at_once(&self) -> usize {
            64
        }

        async fn evaluate(&mut self, trials: Trials<'_>, seen: &mut Observations) -> Result<(), EvaluatorError> {
            for (id, joints) in trials.batch.iter() {
                seen.observed(id, joints).fill(0.0);
            }
            Ok(())
        }
    }

    fn paced(per_s: f64) -> Paced {
        Paced::new(Box::new(Instantly), per_s)
    }

    #[test]
    fn a_batch_is_a_tenth_of_a_second_within_what_the_inner_evaluator_takes() {
        assert_eq!(paced(200.0).most_at_once(), 20);
        assert_eq!(paced(0.5).most_at_once(), 1);
        assert_eq!(paced(1e6).most_at_once(), 64);
    }

    #[tokio::test]
    async fn the_rate_is_kept_and_a_dropped_wait_loses_no_trial() {
        let mut batch = Batch::new(1, 20);
        for id in 0..20 {
            batch.push(id, &[0.0]);
        }
        let trials = Trials { repetition: 0, goal: 0, prefix: &[], batch: &batch };
        let mut seen = Observations::new(1, 1, Provenance::Simulated);
        let mut evaluator = paced(2000.0);
        let started = Instant::now();
        for _ in 0..3 {
            evaluator.evaluate(trials, &mut seen).await.unwrap();
        }
        assert!(started.elapsed() >= Duration::from_millis(20));
        assert_eq!(seen.iter().count(), 60);

        let mut evaluator = paced(0.01);
        evaluator.evaluate(trials, &mut seen).await.unwrap();
        seen.clear();
        let patience = Duration::from_millis(5);
        assert!(tokio::time::timeout(patience, evaluator.evaluate(trials, &mut seen)).await.is_err());
        assert_eq!(seen.iter().count(), 0, "nothing was executed that nobody heard of");
    }
}
