//! Driver of a method that plans the whole run: it tells the method every observation and keeps the one pose that the
//! method proposes next. The log of trials is the whole state of such a run.

use super::discrepancy::PartialDiscrepancy;
use super::error::ProblemError;
use super::path::{Executed, PathPose, along_effects, along_goals};
use super::result::{GoalResult, TracePoint};
use super::setup::Setup;
use super::true_discrepancy::DiscrepancyEstimate;
use crate::constraint::Proposal;
use crate::method::per_goal::{Provenance, StopReason, Tally};
use crate::method::whole_run::{
    NextTrial, RunSetup, Space, StepLimits, Stepped, Targets, Trial, WholeRun, WholeRunMethod,
};
use std::sync::Arc;

/// A method with the trial that it proposes next.
pub(super) struct WholeRunDriver {
    method: Box<dyn WholeRun>,
    /// The target discrepancy and its measure, if the problem gives one.
    target: Option<(f64, PartialDiscrepancy)>,
    pub next: NextTrial,
}

impl WholeRunDriver {
    /// `method` on the problem of `setup`, told `log`.
    pub fn start(setup: &Setup, method: &dyn WholeRunMethod, seed: u64, log: &[Trial]) -> Result<Self, ProblemError> {
        let mut method = within_limits(setup, method, seed)?;
        for trial in log {
            method.tell(trial.clone());
        }
        let target = setup.spec.target_discrepancy;
        let target = target.map(|value| (value, PartialDiscrepancy::new(&setup.goals, setup.spec.metric)));
        let mut driver = Self { method, target, next: NextTrial::Finished };
        driver.next = driver.ask();
        Ok(driver)
    }

    /// The next trial of the method; `Finished` once the target discrepancy is reached.
    fn ask(&mut self) -> NextTrial {
        if self.reaches_target() { NextTrial::Finished } else { self.method.ask() }
    }

    /// Whether the best trials so far, one per goal, are within the target discrepancy.
    fn reaches_target(&mut self) -> bool {
        let Some((target, measure)) = &self.target else { return false };
        if self.method.log().is_empty() {
            return false;
        }
        let features = self.method.log().iter().find_map(|trial| Some(trial.observation.as_ref()?.len()));
        let untouched = vec![0.0; features.unwrap_or(0)];
        let mut measure = measure.clone();
        let mut discrepancy = f64::INFINITY;
        for outcome in self.method.outcomes() {
            let observation = match outcome.trial {
                Some(index) => self.method.log()[index].observation.as_deref(),
                None => outcome.distance.is_finite().then_some(untouched.as_slice()),
            };
            let Some(observation) = observation else { return false };
            discrepancy = measure.of(observation);
            measure.append(observation);
        }
        discrepancy <= *target
    }

    pub fn log(&self) -> &[Trial] {
        self.method.log()
    }

    /// The accepted poses, whose effects stay, in order.
    pub fn prefix(&self) -> impl Iterator<Item = &[f64]> {
        self.method.accepted().iter().map(|&index| self.method.log()[index].joints.as_slice())
    }

    /// Index of the goal that the next trial is for.
    pub fn goal(&self) -> usize {
        match &self.next {
            NextTrial::Execute { goal, .. } => *goal,
            NextTrial::Finished => self.log().last().map_or(0, |t| t.goal),
        }
    }

    /// Takes the observation at `joints`; `None` if it was lost.
    pub fn tell(&mut self, setup: &Setup, joints: &[f64], shown: Option<&[f64]>) {
        let observation = shown.map(|values| setup.select.iter().map(|&source| values[source]).collect());
        let cells = shown.and_then(|values| setup.cells(values));
        self.method.tell(Trial { joints: joints.to_vec(), observation, cells, goal: self.goal() });
        self.next = self.ask();
    }

    /// First feature of the last accepted trial that was observed; `None` if there is none.
    pub fn kept(&self) -> Option<f64> {
        let kept = self.method.accepted().iter().rev();
        kept.map(|&index| &self.method.log()[index]).find_map(|trial| Some(trial.observation.as_ref()?[0]))
    }

    /// The path of a run that has ended with `results`: every trial whose effect stays, or one pose per goal.
    pub fn path(&mut self, setup: &Setup, results: &[GoalResult]) -> Vec<PathPose> {
        if setup.painted.is_none() {
            return along_goals(results.iter().map(GoalResult::executed));
        }
        let served: Vec<Option<usize>> = self.method.outcomes().iter().map(|outcome| outcome.trial).collect();
        let log = self.method.log();
        let executed = |index: usize| {
            let trial: &Trial = &log[index];
            Executed { joints: &trial.joints, observation: trial.observation.as_deref() }
        };
        let untouched = vec![0.0; setup.select.len()];
        let start = Executed { joints: setup.chain.home(), observation: Some(&untouched) };
        along_effects(executed, start, &served, self.method.accepted())
    }

    /// Estimate of the true discrepancy of `results`; `None` unless the method models the features and knows their noise.
    pub fn estimate(&mut self, setup: &Setup, results: &[GoalResult], seed: u64) -> Option<DiscrepancyEstimate> {
        let poses: Vec<&[f64]> = results.iter().map(|result| result.joints.as_slice()).collect();
        let believed = self.method.believed(&poses)?;
        let measure = PartialDiscrepancy::new(&setup.goals, setup.spec.metric);
        Some(DiscrepancyEstimate::of(&believed, &measure, seed))
    }

    /// The results of all goals, once the method has finished.
    pub fn results(
        &mut self,
        setup: &Setup,
        discrepancy: &mut PartialDiscrepancy,
        provenance: Provenance,
    ) -> Result<Vec<GoalResult>, ProblemError> {
        let is_on_target = self.reaches_target();
        let outcomes = self.method.outcomes();
        let ended: Vec<StopReason> = (0..outcomes.len()).map(|goal| self.method.ended_by(goal)).collect();
        let log = self.method.log();
        let is_unserved = outcomes.iter().any(|outcome| outcome.trial.is_none() && outcome.distance.is_infinite());
        if log.is_empty() && is_unserved && !setup.constraints.is_empty() {
            let home = Proposal { joints: setup.chain.home(), origins: [None; 2], previous: None };
            let nearest = setup.constraints.violations(&home).collect();
            return Err(ProblemError::Infeasible { goal: 0, nearest, evaluations: 0 });
        }
        let mut results: Vec<GoalResult> = Vec::with_capacity(outcomes.len());
        for (index, outcome) in outcomes.iter().enumerate() {
            let of_goal = |trial: &&Trial| trial.goal == index;
            let evaluations = log.iter().filter(of_goal).count() as u64;
            let nothing = ProblemError::NothingExecuted { goal: index, trials: log.len() as u64 };
            let (joints, observation) = match outcome.trial.map(|t| &log[t]) {
                Some(trial) => (trial.joints.clone(), trial.observation.clone()),
                None if outcome.distance.is_finite() => {
                    (setup.chain.home().to_vec(), Some(vec![0.0; setup.select.len()]))
                }
                None => return Err(nothing),
            };
            let Some(observation) = observation else { return Err(nothing) };
            let value = discrepancy.of(&observation);
            let previous = results.last().map(|result| result.joints.as_slice());
            let pose = Proposal { joints: &joints, origins: [None; 2], previous };
            let feasible = setup.constraints.is_feasible(&pose);
            discrepancy.append(&observation);
            let stop_reason = if outcome.distance <= setup.tolerance {
                StopReason::Tolerance
            } else if is_on_target {
                StopReason::Target
            } else {
                ended[index]
            };
            results.push(GoalResult {
                index,
                evaluations,
                failures: 0,
                discrepancy: value,
                stop_reason,
                judgement: setup.judge(index, Some(&observation), stop_reason),
                joints,
                observation,
                provenance,
                true_discrepancy: None,
                feasible,
                tally: match provenance {
                    Provenance::Real => Tally { real: evaluations, ..Tally::default() },
                    _ => Tally { simulated: evaluations, ..Tally::default() },
                },
                trace: vec![TracePoint { evaluations, discrepancy: value }],
            });
        }
        Ok(results)
    }
}

/// A search by `method` that keeps to the constraints.
fn within_limits(setup: &Setup, method: &dyn WholeRunMethod, seed: u64) -> Result<Box<dyn WholeRun>, ProblemError> {
    let goals: Vec<Vec<f64>> = setup.goals.rows().map(<[f64]>::to_vec).collect();
    let space = space(setup);
    let limits = step_limits(setup, &space, method.max_step_deg());
    let targets = Targets { goals, tolerance: setup.tolerance };
    let inner = method.start(&RunSetup {
        space: &space,
        targets: &targets,
        seed,
        max_evaluations_per_goal: setup.spec.max_evaluations_per_goal,
        earlier: &setup.earlier,
        world: &setup.world,
        chain: &setup.chain,
        select: &setup.select,
    })?;
    Ok(Box::new(Stepped::new(inner, space, limits, targets, seed)))
}

fn step_limits(setup: &Setup, space: &Space, max_step_deg: Option<f64>) -> StepLimits {
    let between_goals = setup.constraints.joint_step();
    let between_trials = max_step_deg.map(f64::to_radians);
    let per_goal = between_goals.map(|(limit, _)| limit);
    let least = |scale: f64| {
        let per_trial = between_trials.map_or(f64::INFINITY, |step| step / scale);
        per_trial.min(per_goal.unwrap_or(f64::INFINITY))
    };
    let start = between_goals.and_then(|(_, start)| start.map(<[f64]>::to_vec));
    StepLimits {
        per_trial: space.axes.iter().map(|axis| least(axis.scale())).collect(),
        per_goal,
        start: start.or_else(|| between_trials.map(|_| space.home())),
        repeats: setup.world.properties().surface.is_some_and(|surface| surface.resets),
    }
}

fn space(setup: &Setup) -> Space {
    let space = Space::of(&setup.chain);
    if setup.constraints.is_empty() {
        return space;
    }
    let constraints = Arc::clone(&setup.constraints);
    space.only(Arc::new(move |pose| constraints.allows(pose)))
}
