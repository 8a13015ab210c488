//! IET, Incrementally Evolved Trajectories (paper algorithm 1), one run of one seed, sans-I/O.
//!
//! For goal j an optimiser searches U_j; a candidate is judged by the discrepancy of O_1..O_j against X_1..X_j after
//! re-executing [`Iet::prefix`] U_1..U_j-1 and then the candidate. The best is appended. The machine says which
//! candidates it needs ([`Iet::ask`]) and is told observation vectors ([`Iet::tell`]); it knows no world and no clock.
//!
//! # Invariants
//! - Result bits depend on problem and seed only: not on batch sizes, saves and resumes, or threads.
//! - `optimizer` is present exactly while a goal is being searched.

use super::discrepancy::PartialDiscrepancy;
use super::error::ProblemError;
use super::observations::Observations;
use super::result::{GoalResult, Progress, RunResult, TracePoint, digest, record};
use super::setup::Setup;
use super::spec::Problem;
use super::state::{GoalState, IetState, STATE_VERSION};
use crate::framework::optimizer::{Batch, Optimizer, Outcome, StopReason, resume, start};
use crate::framework::robot::Chain;

/// One run of a problem.
pub struct Iet {
    setup: Setup,
    seed: u64,
    discrepancy: PartialDiscrepancy,
    optimizer: Option<Box<dyn Optimizer>>,
    goal: GoalState,
    results: Vec<GoalResult>,
    evaluations: u64,
    /// The m features of the goals, picked out of an observation.
    seen: Vec<f64>,
}

impl Iet {
    /// A fresh run.
    ///
    /// # Errors
    /// [`ProblemError`] if robot, world, goals and method do not fit together.
    pub fn new(problem: &Problem, seed: u64) -> Result<Self, ProblemError> {
        let mut iet = Self::bare(Setup::new(problem)?, seed);
        iet.start_goal()?;
        Ok(iet)
    }

    /// Goes on from a saved run of the same problem.
    ///
    /// # Errors
    /// [`ProblemError`] if the state does not belong to the problem.
    pub fn resume(problem: &Problem, state: IetState) -> Result<Self, ProblemError> {
        let setup = Setup::new(problem)?;
        state.check(setup.goals.len(), setup.chain.len(), setup.goals.features().len())?;
        let mut iet = Self::bare(setup, state.seed);
        for result in &state.results {
            iet.discrepancy.append(&result.observation);
        }
        iet.results = state.results;
        iet.evaluations = state.evaluations;
        iet.goal = state.goal;
        if let Some(saved) = state.optimizer {
            iet.optimizer = Some(resume(&iet.setup.spec.method, iet.setup.space(), saved)?);
        }
        Ok(iet)
    }

    fn bare(setup: Setup, seed: u64) -> Self {
        Self {
            discrepancy: PartialDiscrepancy::new(&setup.goals, setup.spec.metric),
            seed,
            optimizer: None,
            goal: GoalState::default(),
            results: Vec::with_capacity(setup.goals.len()),
            evaluations: 0,
            seen: vec![0.0; setup.goals.features().len()],
            setup,
        }
    }

    /// Everything needed to go on with the same bits.
    #[must_use]
    pub fn state(&self) -> IetState {
        IetState {
            version: STATE_VERSION,
            seed: self.seed,
            results: self.results.clone(),
            evaluations: self.evaluations,
            goal: self.goal.clone(),
            optimizer: self.optimizer.as_ref().map(|o| o.state()),
        }
    }

    /// The chain whose joints are searched.
    #[must_use]
    pub fn chain(&self) -> &Chain {
        &self.setup.chain
    }

    /// The seed of this run.
    #[must_use]
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// U_1..U_j-1: what must be executed, in order, before each candidate.
    #[must_use]
    pub fn prefix(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.results.iter().map(|r| r.joints.as_slice())
    }

    /// Whether every goal has ended.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.results.len() == self.setup.goals.len()
    }

    /// Number of features of the world: values an observation holds.
    #[must_use]
    pub fn world_features(&self) -> usize {
        self.setup.world_features
    }

    /// Adds candidates of the current goal to `batch`; none when the run is finished.
    pub fn ask(&mut self, batch: &mut Batch) {
        if let Some(optimizer) = &mut self.optimizer {
            optimizer.ask(batch);
        }
    }

    /// Takes observations of candidates of the current goal. When one of them ends the goal, the rest are ignored and
    /// the run moves on to the next goal, so that [`Iet::prefix`] has grown.
    ///
    /// # Errors
    /// [`ProblemError::NothingExecuted`] if the goal ended without any executed candidate.
    pub fn tell(&mut self, observations: &Observations) -> Result<(), ProblemError> {
        let goal_index = self.results.len();
        for (id, joints, observation) in observations.iter() {
            self.tell_one(id, joints, observation, observations)?;
            if self.results.len() != goal_index {
                break;
            }
        }
        Ok(())
    }

    fn tell_one(
        &mut self,
        id: u64,
        joints: &[f64],
        observation: Option<&[f64]>,
        observations: &Observations,
    ) -> Result<(), ProblemError> {
        let Some(optimizer) = &mut self.optimizer else { return Ok(()) };
        let goal_index = self.results.len();
        let mut ended = None;
        if let Some(observation) = observation {
            for (value, &source) in self.seen.iter_mut().zip(&self.setup.select) {
                *value = observation[source];
            }
            let noise = self.setup.noise(self.seed, goal_index, id);
            let fitness = self.discrepancy.of(&self.seen) + noise;
            self.evaluations += 1;
            self.goal.evaluations += 1;
            if self.goal.best.is_none_or(|best| fitness < best) {
                self.goal.best = Some(fitness);
                let point = TracePoint { evaluations: self.goal.evaluations, discrepancy: fitness };
                record(&mut self.goal.trace, point);
            }
            if let Some(percent) = self.setup.painted.map(|index| observation[index])
                && self.goal.painted.is_none_or(|best| (percent - 100.0).abs() < (best - 100.0).abs())
            {
                self.goal.painted = Some(percent);
            }
            let provenance = observations.provenance();
            optimizer.tell(id, Outcome::Observed { fitness, observation: &self.seen, provenance });
            let distance = || -> f64 {
                let goal = self.setup.goals.row(goal_index);
                self.seen.iter().zip(goal).map(|(o, x)| (o - x) * (o - x)).sum::<f64>().sqrt()
            };
            if self.setup.spec.tolerance.is_some_and(|tolerance| distance() <= tolerance) {
                let seen = self.seen.clone();
                let result = self.result(fitness, StopReason::Tolerance, joints.to_vec(), seen, provenance);
                return self.finish_goal(result);
            }
            ended = optimizer.stop();
        } else {
            self.goal.failures += 1;
            optimizer.tell(id, Outcome::Failed);
            ended = ended.or(optimizer.stop());
        }
        let trials = self.goal.evaluations + self.goal.failures;
        if self.setup.spec.max_evaluations_per_goal.is_some_and(|most| trials >= most) {
            ended = ended.or(Some(StopReason::MaxEvaluations));
        }
        let Some(reason) = ended else { return Ok(()) };
        let Some(best) = optimizer.best() else {
            return Err(ProblemError::NothingExecuted { goal: goal_index, failures: self.goal.failures });
        };
        let (joints, seen) = (best.joints.to_vec(), best.observation.to_vec());
        let (fitness, provenance) = (best.fitness, best.provenance);
        let result = self.result(fitness, reason, joints, seen, provenance);
        self.finish_goal(result)
    }

    fn result(
        &mut self,
        discrepancy: f64,
        stop_reason: StopReason,
        joints: Vec<f64>,
        observation: Vec<f64>,
        provenance: crate::framework::optimizer::Provenance,
    ) -> GoalResult {
        GoalResult {
            index: self.results.len(),
            evaluations: self.goal.evaluations,
            failures: self.goal.failures,
            discrepancy,
            stop_reason,
            joints,
            observation,
            provenance,
            trace: std::mem::take(&mut self.goal.trace),
        }
    }

    fn finish_goal(&mut self, result: GoalResult) -> Result<(), ProblemError> {
        self.discrepancy.append(&result.observation);
        self.results.push(result);
        self.optimizer = None;
        if self.is_finished() {
            return Ok(());
        }
        self.goal = GoalState::default();
        self.start_goal()
    }

    fn start_goal(&mut self) -> Result<(), ProblemError> {
        let stream = self.results.len() as u64;
        self.optimizer = Some(start(&self.setup.spec.method, self.setup.space(), self.seed, stream)?);
        Ok(())
    }

    /// Where the run stands.
    #[must_use]
    pub fn progress(&self) -> Progress {
        Progress {
            goal_index: self.results.len(),
            goals: self.setup.goals.len(),
            evaluations: self.evaluations,
            goal_evaluations: if self.is_finished() { 0 } else { self.goal.evaluations },
            best_discrepancy: if self.is_finished() { None } else { self.goal.best },
            finished: self.is_finished(),
            results: self.results.clone(),
        }
    }

    /// Evaluations of all goals so far.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// The finished run.
    ///
    /// # Errors
    /// [`ProblemError::Unfinished`] before the last goal has ended.
    pub fn finish(self) -> Result<RunResult, ProblemError> {
        let goals = self.setup.goals.len();
        let unfinished = ProblemError::Unfinished { goal: self.results.len(), goals };
        let Some(last) = self.results.last().filter(|_| self.is_finished()) else { return Err(unfinished) };
        Ok(RunResult {
            seed: self.seed,
            evaluations: self.evaluations,
            discrepancy: last.discrepancy,
            painted_percent: self.goal.painted,
            digest: digest(&self.results),
            goals: self.results,
        })
    }
}
