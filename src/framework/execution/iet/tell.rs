//! Observations on their way into a run: they advance the search of a goal, end it and begin the next one.

use super::{CONFIRMATION, Iet, Search};
use crate::constraint::Proposal;
use crate::distance::distance;
use crate::execution::error::ProblemError;
use crate::execution::observations::{Observations, Seen};
use crate::execution::result::{GoalResult, TracePoint, record};
use crate::method::per_goal::{Best, Outcome, Provenance, StopReason, Tally};
use crate::method::whole_run::NextTrial;

/// Winner of a goal.
struct Hit {
    joints: Vec<f64>,
    observation: Vec<f64>,
    fitness: f64,
    provenance: Provenance,
    /// Discrepancy of a never-executed winner once it has been executed.
    confirmed: Option<f64>,
}

impl From<Best<'_>> for Hit {
    fn from(best: Best<'_>) -> Self {
        Self {
            joints: best.joints.to_vec(),
            observation: best.observation.to_vec(),
            fitness: best.fitness,
            provenance: best.provenance,
            confirmed: None,
        }
    }
}

impl Iet {
    /// Takes observations of candidates of the current goal. If one of them ends the goal, the rest are ignored and the
    /// run moves on to the next goal, so [`Iet::prefix`] has grown.
    ///
    /// # Errors
    /// [`ProblemError::NothingExecuted`] if the goal ended without any executed candidate, [`ProblemError::Infeasible`]
    /// if none satisfied the constraints.
    pub fn tell(&mut self, observations: &Observations) -> Result<(), ProblemError> {
        if self.plans_whole_run() {
            return self.tell_driver(observations);
        }
        let goal_index = self.results.len();
        for (id, joints, seen) in observations.iter() {
            if seen == Seen::Unknown {
                continue;
            }
            if id == CONFIRMATION {
                return self.tell_confirmation(seen);
            }
            self.tell_one(id, joints, seen, observations)?;
            if self.results.len() != goal_index || self.goal.ended.is_some() {
                return Ok(());
            }
        }
        self.end_goal_if_over()
    }

    fn see(&mut self, observation: &[f64]) {
        for (value, &source) in self.seen.iter_mut().zip(&self.setup.select) {
            *value = observation[source];
        }
    }

    /// [`Iet::tell`] for a method that plans the whole run: a lost observation counts as an evaluation.
    fn tell_driver(&mut self, observations: &Observations) -> Result<(), ProblemError> {
        let Search::WholeRun(driver) = &mut self.search else { return Ok(()) };
        if let Some((_, joints, seen)) =
            observations.iter().find(|trial| trial.0 == self.evaluations && trial.2 != Seen::Unknown)
        {
            driver.tell(&self.setup, joints, seen.features());
            self.evaluations += 1;
        }
        if driver.next == NextTrial::Finished && self.results.is_empty() {
            self.results = driver.results(&self.setup, &mut self.discrepancy, observations.provenance())?;
            self.painted = self.setup.painted.map(|_| driver.kept().unwrap_or(0.0));
        }
        Ok(())
    }

    fn tell_one(
        &mut self,
        id: u64,
        joints: &[f64],
        seen: Seen<'_>,
        observations: &Observations,
    ) -> Result<(), ProblemError> {
        let goal_index = self.results.len();
        let provenance = observations.provenance();
        if seen == Seen::Failed {
            self.goal.failures += 1;
        } else {
            self.evaluations += 1;
            self.goal.evaluations += 1;
            self.goal.real += u64::from(provenance == Provenance::Real);
        }
        if let Some(observation) = seen.features() {
            self.see(observation);
            let Search::PerGoal { goal: Some(search), .. } = &mut self.search else { return Ok(()) };
            let noise = self.setup.noise(self.seed, goal_index, id);
            let fitness = self.discrepancy.of(&self.seen) + noise;
            let feasible = search.is_feasible(id);
            if feasible && self.goal.best.is_none_or(|best| fitness < best) {
                self.goal.best = Some(fitness);
                let point = TracePoint { evaluations: self.goal.evaluations, discrepancy: fitness };
                record(&mut self.goal.trace, point);
            }
            if let Some(percent) = self.setup.painted.map(|index| observation[index])
                && self.goal.painted.is_none_or(|best| (percent - 100.0).abs() < (best - 100.0).abs())
            {
                self.goal.painted = Some(percent);
            }
            search.tell(id, Outcome::Observed { fitness, observation: &self.seen, provenance });
            let miss = || distance(&self.seen, self.setup.goals.row(goal_index));
            if feasible && self.setup.spec.tolerance.is_some_and(|tolerance| miss() <= tolerance) {
                let observation = self.seen.clone();
                let winner = Hit { fitness, joints: joints.to_vec(), observation, provenance, confirmed: None };
                return self.finish_goal(StopReason::Tolerance, winner);
            }
        } else if let Search::PerGoal { goal: Some(search), .. } = &mut self.search {
            search.tell(id, Outcome::Failed);
        }
        self.end_goal_if_over()
    }

    /// Ends the goal if its search is over, unless a winner must first be executed.
    fn end_goal_if_over(&mut self) -> Result<(), ProblemError> {
        let Search::PerGoal { goal: Some(search), .. } = &self.search else { return Ok(()) };
        let trials = self.goal.evaluations + self.goal.failures;
        let used_up = self.setup.spec.max_evaluations_per_goal.is_some_and(|most| trials >= most);
        let reason = search.stop().or(used_up.then_some(StopReason::MaxEvaluations));
        let Some(reason) = self.goal.ended.or(reason) else { return Ok(()) };
        let Some(best) = search.best() else {
            let goal = self.results.len();
            let nearest = search.nearest_violations().map(<[f64]>::to_vec);
            return Err(nearest.map_or(ProblemError::NothingExecuted { goal, trials }, |nearest| {
                ProblemError::Infeasible { goal, nearest, evaluations: self.evaluations }
            }));
        };
        if best.provenance.is_executed() {
            let winner = best.into();
            return self.finish_goal(reason, winner);
        }
        self.goal.ended = Some(reason);
        Ok(())
    }

    /// Ends the goal after the execution of its never-executed winner, which does not count as an evaluation. If the
    /// observation is lost, the true discrepancy stays unknown.
    fn tell_confirmation(&mut self, seen: Seen<'_>) -> Result<(), ProblemError> {
        if seen == Seen::Failed {
            let (goal, trials) = (self.results.len(), self.goal.evaluations + self.goal.failures + 1);
            return Err(ProblemError::NothingExecuted { goal, trials });
        }
        if let Some(observation) = seen.features() {
            self.see(observation);
        }
        let Search::PerGoal { goal: Some(search), .. } = &self.search else { return Ok(()) };
        let (Some(best), Some(reason)) = (search.best(), self.goal.ended.or(search.stop())) else {
            return Ok(());
        };
        let mut winner = Hit::from(best);
        if seen != Seen::Lost {
            winner.confirmed = Some(self.discrepancy.of(&self.seen));
            winner.observation.clone_from(&self.seen);
        }
        self.finish_goal(reason, winner)
    }

    fn finish_goal(&mut self, stop_reason: StopReason, winner: Hit) -> Result<(), ProblemError> {
        let state = std::mem::take(&mut self.goal);
        let tally = match &mut self.search {
            Search::PerGoal { goal, .. } => goal.take().map_or_else(Tally::default, |search| search.tally()),
            Search::WholeRun(_) => Tally::default(),
        };
        self.painted = self.setup.painted.map(|_| state.painted.unwrap_or(0.0));
        self.discrepancy.append(&winner.observation);
        let previous = self.results.last().map(|result| result.joints.as_slice());
        let proposal = Proposal { joints: &winner.joints, origins: [None; 2], previous };
        let feasible = winner.provenance != Provenance::Penalised && self.setup.constraints.is_feasible(&proposal);
        let tally = Tally { simulated: state.evaluations - state.real, real: state.real, ..tally };
        let is_executed = winner.provenance.is_executed() || winner.confirmed.is_some();
        let index = self.results.len();
        self.results.push(GoalResult {
            index,
            evaluations: state.evaluations,
            failures: state.failures,
            discrepancy: winner.fitness,
            true_discrepancy: winner.confirmed,
            stop_reason,
            judgement: self.setup.judge(index, is_executed.then_some(&winner.observation), stop_reason),
            joints: winner.joints,
            observation: winner.observation,
            provenance: winner.provenance,
            feasible,
            tally,
            trace: state.trace,
        });
        if self.is_finished() { Ok(()) } else { self.start_goal() }
    }

    fn start_goal(&mut self) -> Result<(), ProblemError> {
        if let Search::PerGoal { method, goal } = &mut self.search {
            *goal = Some(self.setup.start(method.as_ref(), self.seed, &self.results)?);
        }
        Ok(())
    }
}
