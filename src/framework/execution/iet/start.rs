//! The beginning of a run and its resumption from a saved state.

use super::{Iet, Search};
use crate::execution::discrepancy::PartialDiscrepancy;
use crate::execution::error::ProblemError;
use crate::execution::goal_search::GoalSearch;
use crate::execution::setup::Setup;
use crate::execution::spec::Problem;
use crate::execution::state::{GoalState, IetState, STATE_VERSION};
use crate::execution::whole_run_driver::WholeRunDriver;
use crate::method::MethodKind;

impl Iet {
    /// Starts a run by the problem's own method.
    ///
    /// # Errors
    /// [`ProblemError`] if robot, world, goals and method do not fit together.
    pub fn new(problem: &Problem, seed: u64) -> Result<Self, ProblemError> {
        let (setup, method) = Setup::of(problem)?;
        Self::begin(setup, method, seed)
    }

    /// Starts a run by the caller's own method in place of the problem's; for an example, see the documentation of
    /// [`method`](crate::method).
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

    /// Resumes a saved run that [`Iet::with_method`] started with the same method.
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
        for result in &mut iet.results {
            result.judgement = iet.setup.judge_again(result);
        }
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
}
