//! IET, Incrementally Evolved Trajectories (paper algorithm 1): one run of one seed, sans-I/O.
//!
//! For goal j an optimiser searches U_j. A candidate is judged by the discrepancy of O_1..O_j against X_1..X_j after
//! re-executing [`Iet::prefix`] U_1..U_j-1 and then the candidate; the best is appended. The machine asks for
//! candidates to be executed ([`Iet::ask`]) and takes observation vectors ([`Iet::tell`]); it knows neither world nor
//! clock.
//!
//! # Invariants
//! - Result bits depend on problem and seed only: not on batch sizes, saves and resumes, or threads.
//! - A method that plans the whole run names one pose at a time, and its results appear together at the end.

use super::discrepancy::PartialDiscrepancy;
use super::error::ProblemError;
use super::goal_search::GoalSearch;
use super::observations::{Observations, Seen};
use super::result::{GoalResult, Progress, RunResult, TracePoint, digest, record};
use super::setup::Setup;
use super::spec::Problem;
use super::state::{GoalState, IetState, STATE_VERSION};
use super::whole_run_driver::WholeRunDriver;
use crate::constraint::Proposal;
use crate::method::MethodKind;
use crate::method::per_goal::{Batch, Best, Outcome, PerGoalMethod, Provenance, StopReason, Tally};
use crate::method::whole_run::{NextTrial, Trial};
use crate::robot::Chain;
use crate::world::{self, World};

/// Candidate id for executing a winner that was never executed.
const CONFIRMATION: u64 = u64::MAX;

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

/// How the joints are found.
enum Search {
    /// One search per goal; `goal` is `None` exactly when the run is finished.
    PerGoal { method: Box<dyn PerGoalMethod>, goal: Option<GoalSearch> },
    /// All goals at once.
    WholeRun(WholeRunDriver),
}

/// One run of a problem.
pub struct Iet {
    setup: Setup,
    seed: u64,
    discrepancy: PartialDiscrepancy,
    search: Search,
    goal: GoalState,
    /// Like [`RunResult::painted_percent`], for the last finished goal.
    painted: Option<f64>,
    results: Vec<GoalResult>,
    evaluations: u64,
    /// Scratch space for the goals' m features of an observation.
    seen: Vec<f64>,
}

impl Iet {
    /// Starts a run by the problem's own method.
    ///
    /// # Errors
    /// [`ProblemError`] if robot, world, goals and method do not fit together.
    pub fn new(problem: &Problem, seed: u64) -> Result<Self, ProblemError> {
        let (setup, method) = Setup::of(problem)?;
        Self::begin(setup, method, seed)
    }

    /// Starts a run by the caller's own method in place of the one the problem names; the documentation of
    /// [`method`](crate::method) shows one.
    ///
    /// # Errors
    /// As [`Iet::new`].
    pub fn with_method(
        problem: &Problem,
        seed: u64,
        name: &'static str,
        method: MethodKind,
    ) -> Result<Self, ProblemError> {
        Self::begin(Setup::new(problem, name, &method)?, method, seed)
    }

    /// Resumes a saved run of the same problem.
    ///
    /// # Errors
    /// [`ProblemError`] if the state does not belong to the problem.
    pub fn resume(problem: &Problem, state: IetState) -> Result<Self, ProblemError> {
        let (setup, method) = Setup::of(problem)?;
        Self::go_on(setup, method, state)
    }

    /// Goes on from a saved run that [`Iet::with_method`] began with the same method.
    ///
    /// # Errors
    /// As [`Iet::resume`].
    pub fn resume_with_method(
        problem: &Problem,
        state: IetState,
        name: &'static str,
        method: MethodKind,
    ) -> Result<Self, ProblemError> {
        Self::go_on(Setup::new(problem, name, &method)?, method, state)
    }

    fn begin(setup: Setup, method: MethodKind, seed: u64) -> Result<Self, ProblemError> {
        let search = match method {
            MethodKind::PerGoal(method) => {
                Search::PerGoal { goal: Some(setup.start(method.as_ref(), seed, &[])?), method }
            }
            MethodKind::WholeRun(method) => {
                Search::WholeRun(WholeRunDriver::start(&setup, method.as_ref(), seed, &[])?)
            }
        };
        Ok(Self::bare(setup, search, seed))
    }

    fn go_on(setup: Setup, method: MethodKind, state: IetState) -> Result<Self, ProblemError> {
        let state = state.upgraded()?;
        let is_whole_run = matches!(method, MethodKind::WholeRun(_));
        state.check(is_whole_run, setup.goals.len(), setup.chain.len(), setup.goals.features().len())?;
        let search = match method {
            MethodKind::PerGoal(method) => {
                let resume = |saved| setup.resume(method.as_ref(), &state.results, saved, state.judge.clone());
                Search::PerGoal { goal: state.optimizer.clone().map(resume).transpose()?, method }
            }
            MethodKind::WholeRun(method) => {
                Search::WholeRun(WholeRunDriver::start(&setup, method.as_ref(), state.seed, &state.log)?)
            }
        };
        let mut iet = Self::bare(setup, search, state.seed);
        for result in &state.results {
            iet.discrepancy.append(&result.observation);
        }
        iet.results = state.results;
        iet.evaluations = state.evaluations;
        iet.goal = state.goal;
        iet.painted = state.painted;
        Ok(iet)
    }

    fn bare(setup: Setup, search: Search, seed: u64) -> Self {
        Self {
            discrepancy: PartialDiscrepancy::new(&setup.goals, setup.spec.metric),
            seed,
            search,
            goal: GoalState::default(),
            painted: None,
            results: Vec::with_capacity(setup.goals.len()),
            evaluations: 0,
            seen: vec![0.0; setup.goals.features().len()],
            setup,
        }
    }

    /// The driver of a method that plans the whole run.
    fn driver(&self) -> Option<&WholeRunDriver> {
        if let Search::WholeRun(driver) = &self.search { Some(driver) } else { None }
    }

    /// Complete state, from which a resumed search continues bit for bit.
    #[must_use]
    pub fn state(&self) -> IetState {
        let searching = if let Search::PerGoal { goal: Some(search), .. } = &self.search { Some(search) } else { None };
        let (optimizer, judge) = searching.map(GoalSearch::state).unzip();
        IetState {
            version: STATE_VERSION,
            seed: self.seed,
            results: self.results.clone(),
            evaluations: self.evaluations,
            goal: self.goal.clone(),
            painted: self.painted,
            optimizer,
            judge: judge.flatten(),
            log: self.log().to_vec(),
        }
    }

    /// The chain whose joints are searched.
    #[must_use]
    pub fn chain(&self) -> &Chain {
        &self.setup.chain
    }

    /// Whether a whole-run method is at work: it names one pose at a time and may compute long for each.
    #[must_use]
    pub fn plans_whole_run(&self) -> bool {
        self.driver().is_some()
    }

    /// The seed of this run.
    #[must_use]
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// The simulated world of this run: as described, or as far off as `reality` says.
    ///
    /// # Errors
    /// [`ProblemError::World`]; cannot occur for a run that could be created.
    pub fn world(&self) -> Result<Box<dyn World>, ProblemError> {
        let reality = self.setup.spec.reality.as_ref();
        Ok(world::simulated(&self.setup.world, reality, &self.setup.chain, self.seed)?)
    }

    /// Poses to execute, in order, before each candidate: U_1..U_j-1, or the accepted poses of a whole-run method.
    pub fn prefix(&self) -> impl Iterator<Item = &[f64]> {
        let accepted = self.driver().into_iter().flat_map(WholeRunDriver::prefix);
        let results = if self.plans_whole_run() { &[] } else { self.results.as_slice() };
        accepted.chain(results.iter().map(|r| r.joints.as_slice()))
    }

    /// All trials so far of a whole-run method; a later run on the same robot may start from them.
    #[must_use]
    pub fn log(&self) -> &[Trial] {
        self.driver().map_or(&[], WholeRunDriver::log)
    }

    /// Whether every goal has ended.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.results.len() == self.setup.goals.len()
    }

    /// Goal the next candidates are for, from 0; the number of goals once the run is finished.
    #[must_use]
    pub fn goal_index(&self) -> usize {
        if self.is_finished() {
            return self.results.len();
        }
        self.driver().map_or(self.results.len(), WholeRunDriver::goal)
    }

    /// Number of features of the world, and so of values in an observation.
    #[must_use]
    pub fn world_features(&self) -> usize {
        self.setup.world_features
    }

    /// Adds candidates of the current goal to `batch`; none if the run is finished.
    ///
    /// If a goal's winner was never executed, it is requested once more to measure its true discrepancy. An empty batch
    /// of an unfinished run means that the goal ended without execution: tell no observations, then bring the world to
    /// the grown [`Iet::prefix`] and ask again.
    pub fn ask(&mut self, batch: &mut Batch) {
        match &mut self.search {
            Search::WholeRun(driver) => {
                if let (NextTrial::Execute { joints, .. }, false) = (&driver.next, batch.is_full()) {
                    batch.push(self.evaluations, joints);
                }
            }
            Search::PerGoal { goal: None, .. } => {}
            Search::PerGoal { goal: Some(search), .. } => {
                if self.goal.ended.is_none() {
                    search.ask(batch);
                }
                if batch.is_empty()
                    && self.goal.ended.or(search.stop()).is_some()
                    && let Some(best) = search.best()
                    && !best.provenance.is_executed()
                {
                    batch.push(CONFIRMATION, best.joints);
                }
            }
        }
    }

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

    /// As [`Iet::tell`], for a method that plans the whole run: a lost observation costs an evaluation too.
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
            let distance = || -> f64 {
                let goal = self.setup.goals.row(goal_index);
                self.seen.iter().zip(goal).map(|(o, x)| (o - x) * (o - x)).sum::<f64>().sqrt()
            };
            if feasible && self.setup.spec.tolerance.is_some_and(|tolerance| distance() <= tolerance) {
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
        self.results.push(GoalResult {
            index: self.results.len(),
            evaluations: state.evaluations,
            failures: state.failures,
            discrepancy: winner.fitness,
            true_discrepancy: winner.confirmed,
            stop_reason,
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

    /// Progress of the run.
    #[must_use]
    pub fn progress(&self) -> Progress {
        Progress {
            goal_index: self.goal_index(),
            goals: self.setup.goals.len(),
            evaluations: self.evaluations,
            goal_evaluations: if self.is_finished() { 0 } else { self.goal.evaluations },
            best_discrepancy: if self.is_finished() { None } else { self.goal.best },
            finished: self.is_finished(),
            results: self.results.clone(),
        }
    }

    /// Number of evaluations over all goals so far.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// Returns the finished run.
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
            true_discrepancy: last.true_discrepancy,
            valid: last.feasible,
            painted_percent: self.painted,
            tally: self.results.iter().map(|goal| goal.tally).sum(),
            digest: digest(&self.results),
            goals: self.results,
        })
    }
}
