//! The judge: applies constraints to any optimiser, between its proposals and their execution.
//!
//! The judge sees every candidate before it is executed, and every discrepancy before the optimiser does, so one
//! mechanism serves all optimisers. Guarantees per strategy:
//! - rejecting, repairing, operators, death penalty: no infeasible candidate is executed;
//! - other penalties: infeasible candidates are executed and get a strictly larger discrepancy;
//! - all: the goal's result is feasible, or the search stops with [`StopReason::Infeasible`].
//!
//! All attempts are bounded: if no feasible pose is found for a candidate in `max_attempts`, it is reported to the
//! optimiser as failed, and the optimiser's own stagnation ends the search.
//!
//! # Invariants
//! - The bits do not depend on how many candidates are asked for at once: proposals are judged one by one. If a
//!   judgement depends on earlier executions (repairing, operators), candidates are also handed out one by one.
//! - `state.waiting` lists the candidates handed out and not yet reported back, with their violations if infeasible.

use super::error::ConstraintError;
use super::penalty::{self, PenaltyState, penalised};
use super::set::{Constraints, Proposal};
use super::spec::{HandlingSpec, OnInfeasible, PenaltyKind};
use super::state::{ConstrainedState, STATE_VERSION, Waiting};
use crate::method::per_goal::{
    Batch, Best, Incumbent, Optimizer, OptimizerError, OptimizerState, Outcome, SearchSpace, StopReason, Tally,
};
use crate::random::RandomStream;
use std::sync::Arc;

/// Maximum number of halvings of a step before its origin is used, and of bisections of a repair.
const HALVINGS: u32 = 40;

/// Constraints of a goal and their handling.
#[derive(Debug, Clone)]
pub struct Rules {
    /// Conditions on every candidate.
    pub constraints: Arc<Constraints>,
    /// Treatment of infeasible candidates.
    pub handling: HandlingSpec,
    /// Treatment of goals without a feasible candidate.
    pub on_infeasible: OnInfeasible,
    /// Joints appended for the previous goal; `None` for the first goal.
    pub previous: Option<Vec<f64>>,
}

impl Rules {
    /// Checks the combination of handling and treatment of infeasible goals.
    ///
    /// # Errors
    /// [`ConstraintError::OutOfRange`] for a parameter of the handling, [`ConstraintError::NothingToAppend`] if goals
    /// without a feasible candidate cannot be handled as requested.
    pub fn check(handling: &HandlingSpec, on_infeasible: OnInfeasible) -> Result<(), ConstraintError> {
        let strategy = match handling {
            HandlingSpec::Penalty(_) => None,
            HandlingSpec::Rejecting { .. } => Some("rejecting"),
            HandlingSpec::Repairing { .. } => Some("repairing"),
            HandlingSpec::Operators { .. } => Some("operators"),
        };
        if let (Some(strategy), OnInfeasible::Append) = (strategy, on_infeasible) {
            return Err(ConstraintError::NothingToAppend { strategy });
        }
        match handling {
            HandlingSpec::Penalty(spec) => penalty::check(spec),
            HandlingSpec::Rejecting { max_attempts }
            | HandlingSpec::Repairing { max_attempts }
            | HandlingSpec::Operators { max_attempts } => {
                let value = f64::from(*max_attempts);
                if (1..=1_000_000).contains(max_attempts) {
                    return Ok(());
                }
                Err(ConstraintError::OutOfRange { field: "max_attempts", value, expected: "give 1 to 1000000" })
            }
        }
    }

    fn is_feasible(&self, joints: &[f64], origins: [Option<&[f64]>; 2]) -> bool {
        self.constraints.is_feasible(&Proposal { joints, origins, previous: self.previous.as_deref() })
    }
}

/// An optimiser under constraints.
pub struct Constrained {
    inner: Box<dyn Optimizer>,
    rules: Rules,
    space: SearchSpace,
    state: ConstrainedState,
    proposed: Batch,
}

/// Decision about a candidate.
enum Verdict {
    Execute,
    /// Executed at these joints instead.
    Amend(Vec<f64>),
    /// Executed as it is, with a worse discrepancy; holds the violations.
    Worsen(Vec<f64>),
    Tell(Outcome<'static>),
}

impl Constrained {
    /// Puts a fresh `inner` under `rules`; `stream` separates the goals of one seed.
    #[must_use]
    pub fn new(inner: Box<dyn Optimizer>, rules: Rules, space: SearchSpace, seed: u64, stream: u64) -> Self {
        let kind = if let HandlingSpec::Penalty(spec) = &rules.handling { spec.penalty } else { NO_PENALTY };
        let state = ConstrainedState {
            version: STATE_VERSION,
            inner: inner.state(),
            rng: RandomStream::new(seed, stream | 1 << 63),
            penalty: PenaltyState::new(&kind),
            generation: 0,
            attempts: 0,
            waiting: Vec::new(),
            known: None,
            nearest: None,
            tally: Tally::default(),
        };
        Self::with(inner, rules, space, state)
    }

    /// Resumes from a saved state; `inner` was resumed from [`ConstrainedState::inner`].
    ///
    /// # Errors
    /// [`OptimizerError`] if the state's version or shape does not match.
    pub fn resume(
        inner: Box<dyn Optimizer>,
        rules: Rules,
        space: SearchSpace,
        mut state: ConstrainedState,
    ) -> Result<Self, OptimizerError> {
        state.check(&space)?;
        state.waiting.clear(); // they are asked again
        Ok(Self::with(inner, rules, space, state))
    }

    fn with(inner: Box<dyn Optimizer>, rules: Rules, space: SearchSpace, state: ConstrainedState) -> Self {
        let proposed = Batch::new(space.lower.len(), 1);
        Self { inner, rules, space, state, proposed }
    }

    fn sequential(&self) -> bool {
        matches!(self.rules.handling, HandlingSpec::Repairing { .. } | HandlingSpec::Operators { .. })
    }

    /// Applies the strategy to a candidate.
    fn judge(&mut self, id: u64, joints: &[f64]) -> Verdict {
        let proposal = Proposal { joints, origins: self.inner.origins(id), previous: self.rules.previous.as_deref() };
        if self.rules.constraints.is_feasible(&proposal) {
            self.state.attempts = 0;
            return Verdict::Execute;
        }
        let violations: Vec<f64> = self.rules.constraints.violations(&proposal).collect();
        self.note(&violations);
        match &self.rules.handling {
            HandlingSpec::Rejecting { max_attempts } => {
                if self.state.attempts < *max_attempts {
                    self.state.attempts += 1;
                    self.state.tally.rejected += 1;
                    return Verdict::Tell(Outcome::Rejected);
                }
                self.state.attempts = 0;
                Verdict::Tell(Outcome::Failed)
            }
            HandlingSpec::Penalty(spec) => match spec.penalty {
                PenaltyKind::Death { value } => {
                    Verdict::Tell(Outcome::Penalised { fitness: beyond_target(&self.space, value) })
                }
                _ => Verdict::Worsen(violations),
            },
            HandlingSpec::Repairing { max_attempts } => self.moved(id, joints, *max_attempts, true),
            HandlingSpec::Operators { max_attempts } => self.moved(id, joints, *max_attempts, false),
        }
    }

    /// Records the smallest total violation, which tells the user how far from feasible the search was.
    fn note(&mut self, violations: &[f64]) {
        let total = |v: &[f64]| v.iter().sum::<f64>();
        if self.state.nearest.as_ref().is_none_or(|nearest| total(violations) < total(nearest)) {
            self.state.nearest = Some(violations.to_vec());
        }
    }

    /// Moves the candidate to a feasible pose: towards the best known one up to the boundary (repairing), or back to
    /// its origin in halved steps (operators). If neither is known, a random feasible pose is drawn.
    fn moved(&mut self, id: u64, joints: &[f64], max_attempts: u32, repair: bool) -> Verdict {
        let origins = self.inner.origins(id);
        let feasible = |place: &[f64]| self.rules.is_feasible(place, origins);
        let origin = origins[0].filter(|_| !repair);
        let known = self.state.known.as_ref().map(|known| known.joints.as_slice());
        let anchor = [origin, known, origins[0], origins[1]].into_iter().flatten().find(|place| feasible(place));
        let place = match anchor {
            Some(anchor) if repair => Some(bisected(anchor, joints, feasible)),
            Some(anchor) => Some(halved(anchor, joints, feasible)),
            None => {
                let rules = &self.rules;
                sampled(&self.space, &mut self.state.rng, max_attempts, |p| rules.is_feasible(p, origins))
            }
        };
        place.map_or(Verdict::Tell(Outcome::Failed), Verdict::Amend)
    }

    fn generation_may_have_ended(&mut self) {
        let generation = self.inner.generation();
        if generation == self.state.generation {
            return;
        }
        self.state.generation = generation;
        let HandlingSpec::Penalty(spec) = &self.rules.handling else { return };
        let previous = self.rules.previous.as_deref();
        let best = self.inner.best();
        // The best is judged as an individual, because its parents are gone.
        let feasible = best.is_some_and(|best| {
            let proposal = Proposal { joints: best.joints, origins: [None; 2], previous };
            best.provenance.is_executed() && self.rules.constraints.is_feasible(&proposal)
        });
        self.state.penalty.generation_ended(&spec.penalty, feasible);
    }
}

/// Ensures that an infeasible candidate never reaches the target.
fn beyond_target(space: &SearchSpace, fitness: f64) -> f64 {
    space.target.map_or(fitness, |target| fitness.max(target.next_up()))
}

/// Placeholder if no penalty is used; never read.
const NO_PENALTY: PenaltyKind = PenaltyKind::Death { value: 1.0 };

/// The last feasible pose on the way from a feasible `anchor` to an infeasible `joints`, by bisection.
fn bisected(anchor: &[f64], joints: &[f64], feasible: impl Fn(&[f64]) -> bool) -> Vec<f64> {
    let at = |t: f64| -> Vec<f64> { anchor.iter().zip(joints).map(|(a, b)| a + t * (b - a)).collect() };
    let (mut low, mut high, mut best) = (0.0, 1.0, anchor.to_vec());
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        let place = at(middle);
        if feasible(&place) {
            (low, best) = (middle, place);
        } else {
            high = middle;
        }
    }
    best
}

/// The step from a feasible `anchor` to `joints`, halved until it is feasible.
fn halved(anchor: &[f64], joints: &[f64], feasible: impl Fn(&[f64]) -> bool) -> Vec<f64> {
    let mut share = 0.5;
    for _ in 0..HALVINGS {
        let place: Vec<f64> = anchor.iter().zip(joints).map(|(a, b)| a + share * (b - a)).collect();
        if feasible(&place) {
            return place;
        }
        share /= 2.0;
    }
    anchor.to_vec()
}

/// A random feasible pose within the limits; `None` if none is found.
fn sampled(
    space: &SearchSpace,
    rng: &mut RandomStream,
    max_attempts: u32,
    feasible: impl Fn(&[f64]) -> bool,
) -> Option<Vec<f64>> {
    (0..max_attempts).find_map(|_| {
        let limits = space.lower.iter().zip(&space.upper);
        let place: Vec<f64> = limits.map(|(&low, &high)| rng.between(low, high)).collect();
        feasible(&place).then_some(place)
    })
}

impl Optimizer for Constrained {
    fn ask(&mut self, batch: &mut Batch) {
        while !batch.is_full() && (self.state.waiting.is_empty() || !self.sequential()) {
            self.proposed.clear(1);
            self.inner.ask(&mut self.proposed);
            let Some((id, joints)) = self.proposed.iter().next().map(|(id, joints)| (id, joints.to_vec())) else {
                return;
            };
            let (joints, violations) = match self.judge(id, &joints) {
                Verdict::Execute => (joints, Vec::new()),
                Verdict::Worsen(violations) => (joints, violations),
                Verdict::Amend(place) => {
                    self.inner.amend(id, &place);
                    self.state.tally.repaired += 1;
                    (place, Vec::new())
                }
                Verdict::Tell(outcome) => {
                    self.state.tally.penalised += u64::from(matches!(outcome, Outcome::Penalised { .. }));
                    self.inner.tell(id, outcome);
                    self.generation_may_have_ended();
                    continue;
                }
            };
            batch.push(id, &joints);
            self.state.waiting.push(Waiting { id, joints, violations });
        }
    }

    fn tell(&mut self, id: u64, outcome: Outcome<'_>) {
        let Some(at) = self.state.waiting.iter().position(|w| w.id == id) else { return };
        let Waiting { joints, violations, .. } = self.state.waiting.remove(at);
        match (outcome, &self.rules.handling) {
            (Outcome::Observed { fitness, observation, provenance }, HandlingSpec::Penalty(spec))
                if !violations.is_empty() =>
            {
                let generation = self.state.generation;
                let worse = penalised(spec, &self.state.penalty, generation, fitness, violations.into_iter());
                let fitness = beyond_target(&self.space, worse);
                self.state.tally.worsened += 1;
                self.inner.tell(id, Outcome::Observed { fitness, observation, provenance });
            }
            (Outcome::Observed { fitness, observation, provenance }, _) => {
                if self.state.known.as_ref().is_none_or(|known| fitness < known.fitness) {
                    self.state.known =
                        Some(Incumbent { joints, observation: observation.to_vec(), fitness, provenance });
                }
                self.inner.tell(id, outcome);
            }
            _ => self.inner.tell(id, outcome),
        }
        self.generation_may_have_ended();
    }

    fn best(&self) -> Option<Best<'_>> {
        let known = self.state.known.as_ref().map(Incumbent::as_best);
        match (&self.rules.handling, self.rules.on_infeasible) {
            (HandlingSpec::Penalty(spec), _)
                if !matches!(spec.penalty, PenaltyKind::Death { .. }) && known.is_some() =>
            {
                known
            }
            (_, OnInfeasible::Stop) if known.is_none() => None,
            _ => self.inner.best(),
        }
    }

    fn stop(&self) -> Option<StopReason> {
        let reason = self.inner.stop()?;
        let none = self.state.known.is_none() && self.rules.on_infeasible == OnInfeasible::Stop;
        Some(if none { StopReason::Infeasible } else { reason })
    }

    fn state(&self) -> OptimizerState {
        OptimizerState::Constrained(Box::new(ConstrainedState { inner: self.inner.state(), ..self.state.clone() }))
    }

    fn generation(&self) -> u64 {
        self.inner.generation()
    }

    fn origins(&self, id: u64) -> [Option<&[f64]>; 2] {
        self.inner.origins(id)
    }

    fn amend(&mut self, id: u64, joints: &[f64]) {
        self.inner.amend(id, joints);
    }

    fn is_feasible(&self, id: u64) -> bool {
        self.state.waiting.iter().any(|w| w.id == id && w.violations.is_empty())
    }

    fn tally(&self) -> Tally {
        let Tally { inherited, granule, .. } = self.inner.tally();
        Tally { inherited, granule, ..self.state.tally }
    }

    fn nearest_violations(&self) -> Option<&[f64]> {
        self.state.nearest.as_deref()
    }
}
