//! A problem that is ready to run: its robot, goals, world and method have been checked against one another.

use super::checks::{check_earlier, check_goals, check_method, check_spec};
use super::error::ProblemError;
use super::goal_search::GoalSearch;
use super::result::GoalResult;
use super::spec::{ExecutionSpec, Problem};
use super::verdict::{self, Judgement};
use crate::CellSet;
use crate::constraint::{Constraints, Judge, JudgeState, Rules};
use crate::distance::distance;
use crate::generalization::Goals;
use crate::method::MethodKind;
use crate::method::per_goal::{OptimizerState, PerGoalMethod, SearchSpace, StopReason};
use crate::method::whole_run::Trial;
use crate::robot::{Chain, RobotModel};
use crate::world::{self, WorldSpec};
use std::sync::Arc;

/// The parts of a problem that a run needs.
#[derive(Debug, Clone)]
pub(super) struct Setup {
    pub goals: Goals,
    pub chain: Chain,
    pub spec: ExecutionSpec,
    pub world: WorldSpec,
    /// For each feature of the goals, its index among the world's.
    pub select: Vec<usize>,
    pub world_features: usize,
    /// Index of the painted percentage among the world's features; `None` if the world has no surface.
    pub painted: Option<usize>,
    /// Largest distance of an observation from its goal that counts as reached, features' unit.
    pub tolerance: f64,
    pub constraints: Arc<Constraints>,
    /// Trials of earlier runs on the same robot.
    pub earlier: Vec<Trial>,
}

impl Setup {
    /// Checks a problem with its own method; `auto` is replaced by the method that it stands for.
    pub(super) fn of(problem: &Problem) -> Result<(Self, MethodKind), ProblemError> {
        let spec = &problem.execution;
        let chosen = spec.stands_for(&problem.world).map(|(method, _)| method);
        let method = chosen.as_ref().unwrap_or(&spec.method);
        check_method(method, &problem.world.properties())?;
        let Some(kind) = method.kind() else {
            let expected = "to be replaced by the method it stands for";
            return Err(ProblemError::Method { method: method.name(), expected });
        };
        Ok((Self::new(problem, method.name(), &kind)?, kind))
    }

    /// Checks a problem with `method` in place of its own.
    pub(super) fn new(problem: &Problem, name: &'static str, method: &MethodKind) -> Result<Self, ProblemError> {
        let spec = problem.execution.clone();
        check_spec(&spec, name, method)?;
        check_goals(&problem.goals)?;
        let model = RobotModel::from_urdf(&problem.urdf)?;
        let chain = Chain::new(&model, &problem.robot)?;
        // Before the constraints, which may make a solid of its surface.
        world::build(&problem.world, &chain)?;
        let constraints = Constraints::new(&spec.constraints, &model, &problem.robot, &chain, &problem.world)?;
        let needs = |expected| Err(ProblemError::Method { method: name, expected });
        match method {
            MethodKind::PerGoal(_) if !problem.world.properties().resets() => {
                return needs("a surface that is put back between trials: take particle or search if it cannot be");
            }
            MethodKind::WholeRun(_) if constraints.needs_a_population() => {
                return needs("constraints without population_velocity, for it breeds no population: take joint_step");
            }
            _ => {}
        }
        let shown = world::features(&problem.world)?;
        let mut select = Vec::with_capacity(problem.goals.features().len());
        for feature in problem.goals.features() {
            let index = shown.iter().position(|f| f.name == feature.name).ok_or_else(|| {
                let shown = shown.iter().map(|f| f.name.clone()).collect();
                ProblemError::UnknownFeature { feature: feature.name.clone(), shown }
            })?;
            if !feature.unit.is_empty() && feature.unit != shown[index].unit {
                return Err(ProblemError::Unit {
                    feature: feature.name.clone(),
                    goal_unit: feature.unit.clone(),
                    world_unit: shown[index].unit.clone(),
                });
            }
            select.push(index);
        }
        if problem.world.properties().surface.is_some() && matches!(method, MethodKind::WholeRun(_)) && select != [0] {
            return needs("goals of the one feature \"painted\"");
        }
        check_earlier(&problem.earlier, chain.len(), select.len())?;
        Ok(Self {
            tolerance: verdict::tolerance(&spec, &problem.world.properties(), &problem.goals),
            goals: problem.goals.clone(),
            chain,
            spec,
            world: problem.world.clone(),
            select,
            world_features: shown.len(),
            painted: problem.world.properties().surface.map(|_| 0),
            constraints: Arc::new(constraints),
            earlier: problem.earlier.clone(),
        })
    }

    /// The verdict on goal `index`, whose search ended for `stop_reason` with `observation` (m features); `None` if the
    /// winner was never executed.
    pub(super) fn judge(&self, index: usize, observation: Option<&[f64]>, stop_reason: StopReason) -> Judgement {
        let miss = observation.map(|seen| distance(seen, self.goals.row(index)));
        Judgement::new(miss, self.tolerance, stop_reason)
    }

    /// The verdict on a goal that has ended.
    pub(super) fn judge_again(&self, goal: &GoalResult) -> Judgement {
        let is_executed = goal.provenance.is_executed() || goal.true_discrepancy.is_some();
        self.judge(goal.index, is_executed.then_some(&goal.observation), goal.stop_reason)
    }

    /// The cells in an observation of all the world's features; `None` if cells are not seen.
    pub(super) fn cells(&self, values: &[f64]) -> Option<CellSet> {
        self.world.properties().surface.filter(|surface| surface.cells_seen)?;
        Some(CellSet::from_flags(values[1..].iter().map(|cell| *cell > 0.5)))
    }

    /// A fresh search by `method` for the goal after `results`.
    pub(super) fn start(
        &self,
        method: &dyn PerGoalMethod,
        seed: u64,
        results: &[GoalResult],
    ) -> Result<GoalSearch, ProblemError> {
        let goal = results.len() as u64;
        let optimizer = method.start(self.space(results), seed, goal)?;
        let judge = self.rules(results).map(|rules| Judge::new(rules, self.space(results), seed, goal));
        Ok(GoalSearch::new(optimizer, judge))
    }

    /// Resumes a saved search by `method` for the goal after `results`.
    pub(super) fn resume(
        &self,
        method: &dyn PerGoalMethod,
        results: &[GoalResult],
        state: OptimizerState,
        judge: Option<JudgeState>,
    ) -> Result<GoalSearch, ProblemError> {
        let optimizer = method.resume(self.space(results), state)?;
        let judge = match (self.rules(results), judge) {
            (Some(rules), Some(judge)) => Some(Judge::resume(rules, self.space(results), judge)?),
            (None, None) => None,
            (rules, judge) => {
                let (found, expected) = (usize::from(judge.is_some()), usize::from(rules.is_some()));
                return Err(ProblemError::Shape { what: "judges", found, expected });
            }
        };
        Ok(GoalSearch::new(optimizer, judge))
    }

    /// Rules for the goal after `results`; `None` if there are no constraints.
    fn rules(&self, results: &[GoalResult]) -> Option<Rules> {
        (!self.constraints.is_empty()).then(|| Rules {
            constraints: Arc::clone(&self.constraints),
            handling: self.spec.handling.clone(),
            on_infeasible: self.spec.on_infeasible,
            previous: results.last().map(|result| result.joints.clone()),
        })
    }

    /// Space that the optimiser of the goal after `results` searches.
    fn space(&self, results: &[GoalResult]) -> SearchSpace {
        SearchSpace {
            lower: self.chain.genes().iter().map(|g| g.lower).collect(),
            upper: self.chain.genes().iter().map(|g| g.upper).collect(),
            features: self.goals.features().len(),
            target: self.spec.target_discrepancy,
            near: results.last().map(|result| result.joints.clone()),
        }
    }

    /// The rounding noise of one candidate: uniform, of total width `rounding_noise`. It depends on seed, goal and
    /// candidate alone, so that the order of observations does not matter.
    pub(super) fn noise(&self, seed: u64, goal: usize, id: u64) -> f64 {
        let width = self.spec.rounding_noise;
        if width == 0.0 {
            return 0.0;
        }
        let word = mix(mix(mix(seed) ^ goal as u64) ^ id);
        width * ((word >> 11) as f64 / 9_007_199_254_740_992.0 - 0.5)
    }
}

/// SplitMix64's output function: G. L. Steele et al., OOPSLA 2014, DOI 10.1145/2714064.2660195.
fn mix(word: u64) -> u64 {
    let word = word.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let word = (word ^ (word >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let word = (word ^ (word >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    word ^ (word >> 31)
}
