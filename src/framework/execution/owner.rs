//! Methods that own the whole run, plugged into [`super::Iet`]: they are told every observation and name one pose at a
//! time; the run's state is their log.

use super::discrepancy::PartialDiscrepancy;
use super::error::ProblemError;
use super::result::{GoalResult, TracePoint};
use super::setup::Setup;
use crate::constraint::Proposal as Pose;
use crate::method::MethodSpec;
use crate::method::per_goal::{Provenance, StopReason, Tally};
use crate::method::whole_run::ParticleSpec;
use crate::method::whole_run::{
    Broyden, CoverSpec, FeatureMap, Grid, ModelIet, ModelSpec, ParticleIet, Prior, Proposal, SearchIet, Simulator,
    Space, StepLimits, Stepped, Targets, Trial, WholeRun,
};
use crate::robot::Chain;
use crate::world::{self, Surface, SurfaceView, World, WorldSpec};
use std::sync::Arc;

/// Share of the goals' extent that is near enough where no tolerance is given.
const TOLERANCE_SHARE: f64 = 0.1;

/// A method at work, with what it wants next.
pub(super) struct Owner {
    method: Box<dyn WholeRun>,
    /// The target discrepancy, and what measures it.
    target: Option<(f64, PartialDiscrepancy)>,
    pub next: Proposal,
}

impl Owner {
    /// The method of `setup`, told `log`; none where each goal has a search of its own.
    pub fn start(setup: &Setup, seed: u64, log: &[Trial]) -> Result<Option<Self>, ProblemError> {
        let Some(mut method) = method(setup, seed)? else { return Ok(None) };
        for trial in log {
            method.tell(trial.clone());
        }
        let target = setup.spec.target_discrepancy;
        let target = target.map(|value| (value, PartialDiscrepancy::new(&setup.goals, setup.spec.metric)));
        let mut owner = Self { method, target, next: Proposal::Finished };
        owner.next = owner.ask();
        Ok(Some(owner))
    }

    /// What the method wants next; nothing once the target discrepancy is reached.
    fn ask(&mut self) -> Proposal {
        if self.reaches_target() { Proposal::Finished } else { self.method.ask() }
    }

    /// Whether the best trials so far, one a goal, make up a run of the target discrepancy.
    fn reaches_target(&mut self) -> bool {
        let Some((target, measure)) = &self.target else { return false };
        if self.method.log().is_empty() {
            return false;
        }
        let mut measure = measure.clone();
        let mut discrepancy = f64::INFINITY;
        for outcome in self.method.outcomes() {
            let trial = outcome.trial.map(|index| &self.method.log()[index]);
            let Some(observation) = trial.and_then(|trial| trial.observation.as_deref()) else { return false };
            discrepancy = measure.of(observation);
            measure.append(observation);
        }
        discrepancy <= *target
    }

    pub fn log(&self) -> &[Trial] {
        self.method.log()
    }

    /// The poses whose effect stays, in order.
    pub fn prefix(&self) -> impl Iterator<Item = &[f64]> {
        self.method.accepted().iter().map(|&index| self.method.log()[index].joints.as_slice())
    }

    /// The goal being tried.
    pub fn goal(&self) -> usize {
        match &self.next {
            Proposal::Execute { goal, .. } => *goal,
            Proposal::Finished => self.log().last().map_or(0, |t| t.goal),
        }
    }

    /// Takes what the world showed at `joints`; none where that was lost.
    pub fn tell(&mut self, setup: &Setup, joints: &[f64], shown: Option<&[f64]>) {
        let observation = shown.map(|values| setup.select.iter().map(|&source| values[source]).collect());
        let cells = shown.and_then(|values| setup.cells(values));
        self.method.tell(Trial { joints: joints.to_vec(), observation, cells, goal: self.goal() });
        self.next = self.ask();
    }

    /// What the trials whose effect stays have brought the first feature to, once one was seen.
    pub fn kept(&self) -> Option<f64> {
        let kept = self.method.accepted().iter().rev();
        kept.map(|&index| &self.method.log()[index]).find_map(|trial| Some(trial.observation.as_ref()?[0]))
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
        let used_up: Vec<bool> = (0..outcomes.len()).map(|goal| self.method.is_used_up(goal)).collect();
        let log = self.method.log();
        if log.is_empty() && !setup.constraints.is_empty() {
            let home = Pose { joints: setup.chain.home(), origins: [None; 2], previous: None };
            let nearest = setup.constraints.violations(&home).collect();
            return Err(ProblemError::Infeasible { goal: 0, nearest, evaluations: 0 });
        }
        let mut results: Vec<GoalResult> = Vec::with_capacity(outcomes.len());
        for (index, outcome) in outcomes.iter().enumerate() {
            let of_goal = |trial: &&Trial| trial.goal == index;
            let evaluations = log.iter().filter(of_goal).count() as u64;
            let nothing = ProblemError::NothingExecuted { goal: index, trials: log.len() as u64 };
            let Some(trial) = outcome.trial.map(|t| &log[t]) else { return Err(nothing) };
            let Some(observation) = trial.observation.clone() else { return Err(nothing) };
            let value = discrepancy.of(&observation);
            let previous = results.last().map(|result| result.joints.as_slice());
            let pose = Pose { joints: &trial.joints, origins: [None; 2], previous };
            let feasible = setup.constraints.is_feasible(&pose);
            discrepancy.append(&observation);
            results.push(GoalResult {
                index,
                evaluations,
                failures: 0,
                discrepancy: value,
                stop_reason: if outcome.reached {
                    StopReason::Tolerance
                } else if is_on_target {
                    StopReason::Target
                } else if used_up[index] {
                    StopReason::MaxEvaluations
                } else {
                    StopReason::OutOfReach
                },
                joints: trial.joints.clone(),
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

/// The method within what the constraints allow.
fn method(setup: &Setup, seed: u64) -> Result<Option<Box<dyn WholeRun>>, ProblemError> {
    let goals: Vec<Vec<f64>> = setup.goals.rows().map(<[f64]>::to_vec).collect();
    let tolerance = setup.spec.tolerance.unwrap_or_else(|| TOLERANCE_SHARE * extent(&goals));
    let space = space(setup);
    let limits = step_limits(setup, &space);
    let targets = Targets { goals, tolerance };
    let Some(inner) = unbounded(setup, &space, targets.clone(), seed)? else { return Ok(None) };
    Ok(Some(Box::new(Stepped::new(inner, space, limits, targets, seed))))
}

fn step_limits(setup: &Setup, space: &Space) -> StepLimits {
    let between_goals = setup.constraints.joint_step();
    let between_trials = setup.spec.method.max_step_deg().map(f64::to_radians);
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

fn unbounded(
    setup: &Setup,
    space: &Space,
    targets: Targets,
    seed: u64,
) -> Result<Option<Box<dyn WholeRun>>, ProblemError> {
    let Targets { goals, tolerance } = targets;
    Ok(Some(match &setup.spec.method {
        MethodSpec::Auto(_)
        | MethodSpec::Sst(_)
        | MethodSpec::Pso(_)
        | MethodSpec::FiPso(_)
        | MethodSpec::AffgPso(_)
        | MethodSpec::CmaEs(_) => {
            if !setup.world.properties().resets() {
                let expected = "a surface that is put back between trials: take particle or search where it cannot be";
                return Err(ProblemError::Method { method: setup.spec.method.name(), expected });
            }
            return Ok(None);
        }
        MethodSpec::Broyden(spec) => Box::new(Broyden::new(spec.clone(), tolerance, space.clone(), goals)),
        MethodSpec::Model(spec) => {
            let most = setup.spec.max_evaluations_per_goal.and_then(|most| u32::try_from(most).ok());
            let spec = ModelSpec { max_tries: spec.max_tries.min(most.unwrap_or(u32::MAX)), ..spec.clone() };
            let run = ModelIet::new(spec.clone(), tolerance, space.clone(), goals, seed);
            let mut run = run.with_earlier(setup.earlier.clone());
            if spec.prior == Prior::Simulator {
                run = run.with_prior(Box::new(Simulated::new(setup)?));
            }
            Box::new(run)
        }
        MethodSpec::Search(spec) => {
            let Surface { columns, rows, resets, cells_seen } = surface(setup, "search")?;
            let grid = cells_seen.then_some(Grid { columns, rows });
            Box::new(SearchIet::new(spec.clone(), resets, grid, space, &goals, seed))
        }
        MethodSpec::Particle(spec) => {
            let resets = surface(setup, "particle")?.resets;
            let limit = CoverSpec { max_evaluations: spec.max_evaluations, poses: spec.poses, max_step_deg: None };
            let mut world = setup.world.clone();
            if let Some(surface) = world.surface_mut() {
                surface.observes = SurfaceView::Percent;
            }
            let simulator = Uncertain { chain: setup.chain.clone(), world, spec: spec.clone() };
            Box::new(ParticleIet::new(
                limit,
                resets,
                space.clone(),
                &goals,
                Box::new(simulator),
                spec.particles as usize,
                seed,
            ))
        }
    }))
}

fn surface(setup: &Setup, method: &'static str) -> Result<Surface, ProblemError> {
    let refused = |expected| ProblemError::Method { method, expected };
    let surface = setup.world.properties().surface.ok_or(refused("a coverage world; take model here"))?;
    if setup.select != [0] {
        return Err(refused("goals of the one feature \"painted\""));
    }
    Ok(surface)
}

fn space(setup: &Setup) -> Space {
    let space = Space::of(&setup.chain);
    if setup.constraints.is_empty() {
        return space;
    }
    let constraints = Arc::clone(&setup.constraints);
    space.only(Arc::new(move |pose| constraints.allows(pose)))
}

/// Diagonal of the box around the goals, features' unit; 1 where all goals are one.
fn extent(goals: &[Vec<f64>]) -> f64 {
    let side = |k: usize| {
        let column = || goals.iter().map(|g| g[k]);
        column().fold(f64::NEG_INFINITY, f64::max) - column().fold(f64::INFINITY, f64::min)
    };
    let diagonal = (0..goals[0].len()).map(|k| side(k).powi(2)).sum::<f64>().sqrt();
    if diagonal > 0.0 { diagonal } else { 1.0 }
}

/// The problem's own world as a prior.
struct Simulated {
    world: Box<dyn World>,
    select: Vec<usize>,
    scratch: Vec<f64>,
}

impl Simulated {
    fn new(setup: &Setup) -> Result<Self, ProblemError> {
        let world = world::build(&setup.world, &setup.chain)?;
        Ok(Self { world, select: setup.select.clone(), scratch: vec![0.0; setup.world_features] })
    }
}

impl FeatureMap for Simulated {
    fn predict(&mut self, joints: &[f64], features: &mut [f64]) {
        self.world.observe(joints, &mut self.scratch);
        for (value, &source) in features.iter_mut().zip(&self.select) {
            *value = self.scratch[source];
        }
    }
}

/// The problem's robot with uncertain link lengths and base, in its coverage world.
struct Uncertain {
    chain: Chain,
    world: WorldSpec,
    spec: ParticleSpec,
}

impl Simulator for Uncertain {
    fn spreads(&self) -> Vec<f64> {
        let links = vec![self.spec.link_share; self.chain.link_count()];
        [links, vec![self.spec.base_shift_m; 3]].concat()
    }

    fn cells(&self) -> usize {
        self.world.properties().surface.map_or(0, |surface| surface.cells())
    }

    fn covers(&self, parameters: &[f64], poses: &[Vec<f64>]) -> Vec<Vec<u64>> {
        let links = self.chain.link_count();
        let scales: Vec<f64> = parameters[..links].iter().map(|p| 1.0 + p).collect();
        let shift = [parameters[links], parameters[links + 1], parameters[links + 2]];
        let Ok(mut world) = world::build(&self.world, &self.chain.distorted(&scales, shift)) else {
            return vec![vec![0; self.cells().div_ceil(64)]; poses.len()];
        };
        let mut seen = vec![0.0; world.features().len()];
        let mut cover = |pose: &Vec<f64>| {
            world.reset();
            world.commit(pose, &mut seen);
            world.cells().unwrap_or_default().to_vec()
        };
        poses.iter().map(&mut cover).collect()
    }
}
