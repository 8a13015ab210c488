//! The judge of one goal: it stands between what an optimiser proposes and what is executed.
//!
//! The judge sees every candidate before it is executed, and every discrepancy before the optimiser does, so one
//! mechanism serves all optimisers. Guarantees per strategy:
//! - rejecting, repairing, operators, death penalty: no infeasible candidate is executed;
//! - other penalties: infeasible candidates are executed and get a strictly larger discrepancy, except those that a hard
//!   constraint forbids, which are treated as under the death penalty;
//! - all: the goal's result is feasible, or the search stops with [`StopReason::Infeasible`].
//!
//! All attempts are bounded: if no feasible pose is found for a candidate in `max_attempts`, it is reported to the
//! optimiser as failed, and the optimiser's own stagnation ends the search.
//!
//! # Invariants
//! - The judge is not an optimiser and holds none: each call is given the optimiser it judges, always the same one.
//! - The bits do not depend on how many candidates are asked for at once: proposals are judged one by one. If a
//!   judgement depends on earlier executions (repairing, operators), candidates are also handed out one by one.
//! - `state.waiting` lists the candidates handed out and not yet reported back, with their violations if infeasible.

use super::error::ConstraintError;
use super::penalty::{self, PenaltyState, penalised};
use super::set::{Constraints, Proposal};
use super::spec::{HandlingSpec, OnInfeasible, PenaltyKind};
use super::state::{JudgeState, Judged, STATE_VERSION};
use crate::method::per_goal::{
    Batch, Best, Incumbent, Optimizer, OptimizerError, Outcome, Provenance, SearchSpace, StopReason, Tally,
};
use crate::random::RandomStream;
use crate::range::Range;
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
                Ok(Range::from(1..=1_000_000).check("max_attempts", None, f64::from(*max_attempts))?)
            }
        }
    }

    fn is_feasible(&self, joints: &[f64], origins: [Option<&[f64]>; 2]) -> bool {
        self.constraints.is_feasible(&Proposal { joints, origins, previous: self.previous.as_deref() })
    }
}

/// The judge of one goal.
pub struct Judge {
    rules: Rules,
    space: SearchSpace,
    state: JudgeState,
    proposed: Batch,
}

/// Decision about a candidate.
enum Judgement {
    Execute,
    /// Executed at these joints instead.
    Amend(Vec<f64>),
    /// Executed as it is, with a worse discrepancy; holds the violations.
    Worsen(Vec<f64>),
    Tell(Outcome<'static>),
}

impl Judge {
    /// A judge by `rules` of a fresh search of `space`; `goal` separates the goals of one seed.
    #[must_use]
    pub fn new(rules: Rules, space: SearchSpace, seed: u64, goal: u64) -> Self {
        let kind = if let HandlingSpec::Penalty(spec) = &rules.handling { spec.penalty } else { NO_PENALTY };
        let state = JudgeState {
            version: STATE_VERSION,
            rng: RandomStream::new(seed, goal | 1 << 63),
            penalty: PenaltyState::new(&kind),
            generation: 0,
            attempts: 0,
            waiting: Vec::new(),
            known: None,
            nearest: None,
            tally: Tally::default(),
        };
        Self::with(rules, space, state)
    }

    /// Resumes from a saved state.
    ///
    /// # Errors
    /// [`OptimizerError`] if the state's version or shape does not fit.
    pub fn resume(rules: Rules, space: SearchSpace, mut state: JudgeState) -> Result<Self, OptimizerError> {
        state.check(&space)?;
        state.waiting.clear(); // they are asked again
        Ok(Self::with(rules, space, state))
    }

    fn with(rules: Rules, space: SearchSpace, state: JudgeState) -> Self {
        let proposed = Batch::new(space.lower.len(), 1);
        Self { rules, space, state, proposed }
    }

    fn sequential(&self) -> bool {
        matches!(self.rules.handling, HandlingSpec::Repairing { .. } | HandlingSpec::Operators { .. })
    }

    /// Applies the strategy to a candidate.
    fn judge(&mut self, optimizer: &dyn Optimizer, id: u64, joints: &[f64]) -> Judgement {
        let proposal = Proposal { joints, origins: optimizer.origins(id), previous: self.rules.previous.as_deref() };
        if self.rules.constraints.is_feasible(&proposal) {
            self.state.attempts = 0;
            return Judgement::Execute;
        }
        let violations: Vec<f64> = self.rules.constraints.violations(&proposal).collect();
        self.note(&violations);
        match &self.rules.handling {
            HandlingSpec::Rejecting { max_attempts } => {
                if self.state.attempts < *max_attempts {
                    self.state.attempts += 1;
                    self.state.tally.rejected += 1;
                    return Judgement::Tell(Outcome::Rejected);
                }
                self.state.attempts = 0;
                Judgement::Tell(Outcome::Failed)
            }
            HandlingSpec::Penalty(spec) => match spec.penalty {
                PenaltyKind::Death { value } => {
                    Judgement::Tell(Outcome::Penalised { fitness: beyond_target(&self.space, value) })
                }
                _ if self.rules.constraints.forbids(joints) => {
                    let fitness = beyond_target(&self.space, PenaltyKind::DEATH_VALUE);
                    Judgement::Tell(Outcome::Penalised { fitness })
                }
                _ => Judgement::Worsen(violations),
            },
            HandlingSpec::Repairing { max_attempts } => self.moved(optimizer.origins(id), joints, *max_attempts, true),
            HandlingSpec::Operators { max_attempts } => self.moved(optimizer.origins(id), joints, *max_attempts, false),
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
    fn moved(&mut self, origins: [Option<&[f64]>; 2], joints: &[f64], max_attempts: u32, repair: bool) -> Judgement {
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
        place.map_or(Judgement::Tell(Outcome::Failed), Judgement::Amend)
    }

    fn generation_may_have_ended(&mut self, optimizer: &dyn Optimizer) {
        let generation = optimizer.generation();
        if generation == self.state.generation {
            return;
        }
        self.state.generation = generation;
        let HandlingSpec::Penalty(spec) = &self.rules.handling else { return };
        let previous = self.rules.previous.as_deref();
        let best = optimizer.best();
        // The best is judged as an individual, because its parents are gone.
        let feasible = best.is_some_and(|best| {
            let proposal = Proposal { joints: best.joints, origins: [None; 2], previous };
            best.provenance.is_executed() && self.rules.constraints.is_feasible(&proposal)
        });
        self.state.penalty.generation_ended(&spec.penalty, feasible);
    }

    /// Fills `batch` with the candidates of `optimizer` that may be executed.
    pub fn ask(&mut self, optimizer: &mut dyn Optimizer, batch: &mut Batch) {
        while !batch.is_full() && (self.state.waiting.is_empty() || !self.sequential()) {
            self.proposed.clear(1);
            optimizer.ask(&mut self.proposed);
            let Some((id, joints)) = self.proposed.iter().next().map(|(id, joints)| (id, joints.to_vec())) else {
                return;
            };
            let (joints, violations) = match self.judge(&*optimizer, id, &joints) {
                Judgement::Execute => (joints, Vec::new()),
                Judgement::Worsen(violations) => (joints, violations),
                Judgement::Amend(place) => {
                    optimizer.amend(id, &place);
                    self.state.tally.repaired += 1;
                    (place, Vec::new())
                }
                Judgement::Tell(outcome) => {
                    self.state.tally.penalised += u64::from(matches!(outcome, Outcome::Penalised { .. }));
                    optimizer.tell(id, outcome);
                    self.generation_may_have_ended(&*optimizer);
                    continue;
                }
            };
            batch.push(id, &joints);
            self.state.waiting.push(Judged { id, joints, violations });
        }
    }

    /// Tells `optimizer` what became of a candidate.
    pub fn tell(&mut self, optimizer: &mut dyn Optimizer, id: u64, outcome: Outcome<'_>) {
        let Some(at) = self.state.waiting.iter().position(|w| w.id == id) else { return };
        let Judged { joints, violations, .. } = self.state.waiting.remove(at);
        match (outcome, &self.rules.handling) {
            (Outcome::Observed { fitness, observation, provenance }, HandlingSpec::Penalty(spec))
                if !violations.is_empty() =>
            {
                let generation = self.state.generation;
                let worse = penalised(spec, &self.state.penalty, generation, fitness, violations.into_iter());
                let fitness = beyond_target(&self.space, worse);
                self.state.tally.worsened += 1;
                optimizer.tell(id, Outcome::Observed { fitness, observation, provenance });
            }
            (Outcome::Observed { fitness, observation, provenance }, _) => {
                if self.state.known.as_ref().is_none_or(|known| fitness < known.fitness) {
                    self.state.known =
                        Some(Incumbent { joints, observation: observation.to_vec(), fitness, provenance });
                }
                optimizer.tell(id, outcome);
            }
            _ => optimizer.tell(id, outcome),
        }
        self.generation_may_have_ended(&*optimizer);
    }

    /// The best candidate so far that may be the goal's result. Unless the goal may end infeasibly, it satisfies the
    /// constraints: if the optimiser's best was neither executed nor satisfies them, the best executed one does.
    #[must_use]
    pub fn best<'a>(&'a self, optimizer: &'a dyn Optimizer) -> Option<Best<'a>> {
        let known = self.state.known.as_ref().map(Incumbent::as_best);
        let worsens = match &self.rules.handling {
            HandlingSpec::Penalty(spec) => !matches!(spec.penalty, PenaltyKind::Death { .. }),
            _ => false,
        };
        if worsens && known.is_some() {
            return known;
        }
        if self.rules.on_infeasible != OnInfeasible::Stop {
            return optimizer.best().filter(|best| !self.rules.constraints.forbids(best.joints));
        }
        let known = known?;
        let may_win = |best: &Best<'_>| {
            best.provenance.is_executed()
                || best.provenance != Provenance::Penalised && self.rules.is_feasible(best.joints, [None; 2])
        };
        Some(optimizer.best().filter(may_win).unwrap_or(known))
    }

    /// Reason why the search ended by its own rules; `None` while it goes on.
    #[must_use]
    pub fn stop(&self, optimizer: &dyn Optimizer) -> Option<StopReason> {
        let reason = optimizer.stop()?;
        let none = self.state.known.is_none() && self.rules.on_infeasible == OnInfeasible::Stop;
        Some(if none { StopReason::Infeasible } else { reason })
    }

    /// Everything needed to go on with the same bits.
    #[must_use]
    pub fn state(&self) -> &JudgeState {
        &self.state
    }

    /// Whether candidate `id` (asked and not told) may be the result of its goal.
    #[must_use]
    pub fn is_feasible(&self, id: u64) -> bool {
        self.state.waiting.iter().any(|w| w.id == id && w.violations.is_empty())
    }

    /// Sources of fitness values other than evaluations, those of `optimizer` included.
    #[must_use]
    pub fn tally(&self, optimizer: &dyn Optimizer) -> Tally {
        let Tally { inherited, granule, .. } = optimizer.tally();
        Tally { inherited, granule, ..self.state.tally }
    }

    /// The smallest violations of an infeasible candidate so far, one per constraint (m or rad).
    #[must_use]
    pub fn nearest_violations(&self) -> Option<&[f64]> {
        self.state.nearest.as_deref()
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
