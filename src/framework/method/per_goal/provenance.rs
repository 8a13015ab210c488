//! Origin of fitness values, and the reasons why goals end.

use serde::{Deserialize, Serialize};

/// Origin of a fitness value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Provenance {
    /// Executed in a simulated world.
    Simulated,
    /// Executed on a robot.
    Real,
    /// Taken from relatives without executing.
    Inherited,
    /// Taken from a similar individual without executing.
    Granule,
    /// A penalty, without executing.
    Penalised,
}

impl Provenance {
    /// Whether the candidate was executed: only such a value is an evaluation.
    #[must_use]
    pub fn is_executed(self) -> bool {
        matches!(self, Self::Simulated | Self::Real)
    }
}

/// Reason why a goal ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum StopReason {
    /// Too many generations without strict improvement.
    Stagnation,
    /// The target discrepancy was reached.
    Target,
    /// An observation came within the tolerance of the goal.
    Tolerance,
    /// The goal's evaluations are used up.
    MaxEvaluations,
    /// The search ended without a candidate that satisfies the constraints.
    Infeasible,
    /// No pose is expected to come nearer, and a restart from another region of the joint space agreed: the result is the
    /// best residual.
    OutOfReach,
    /// No pose is expected to come nearer, but no restart has confirmed it.
    NoImprovement,
}

/// Counts of fitness values by origin, and of the ways infeasible candidates were handled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Tally {
    /// Executed in simulation.
    pub simulated: u64,
    /// Executed on a robot.
    pub real: u64,
    /// Fitness inherited.
    pub inherited: u64,
    /// Fitness taken from a granule.
    pub granule: u64,
    /// Fitness that is a penalty, not executed.
    pub penalised: u64,
    /// Executed candidates whose fitness was made worse because they are infeasible.
    pub worsened: u64,
    /// Candidates rejected; another took the place of each.
    pub rejected: u64,
    /// Candidates moved to a feasible place before they were executed.
    pub repaired: u64,
}

impl std::iter::Sum for Tally {
    fn sum<I: Iterator<Item = Self>>(tallies: I) -> Self {
        tallies.fold(Self::default(), |a, b| Self {
            simulated: a.simulated + b.simulated,
            real: a.real + b.real,
            inherited: a.inherited + b.inherited,
            granule: a.granule + b.granule,
            penalised: a.penalised + b.penalised,
            worsened: a.worsened + b.worsened,
            rejected: a.rejected + b.rejected,
            repaired: a.repaired + b.repaired,
        })
    }
}
