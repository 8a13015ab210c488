//! A problem: everything that an execution needs, self-contained and serialisable, so that a job can be rerun from it
//! alone.

use crate::constraint::{CollisionFreeSpec, ConstraintSpec, HandlingSpec, OnInfeasible};
use crate::generalization::Goals;
use crate::method::whole_run::Trial;
use crate::method::{Chosen, MethodSpec, choose, method_or_name};
use crate::recognition::Metric;
use crate::robot::RobotSpec;
use crate::world::{DisturbanceSpec, WorldSpec};
use serde::{Deserialize, Serialize};

/// Goals, robot, world and method of one execution. The seed is not part of it, because each repetition has its own.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Problem {
    /// X, the generalized action.
    pub goals: Goals,
    /// The robot's URDF, as text.
    pub urdf: String,
    /// The part of the robot that moves.
    pub robot: RobotSpec,
    /// The world in which the effects happen.
    pub world: WorldSpec,
    /// The method, its limits and the constraints.
    pub execution: ExecutionSpec,
    /// Trials of earlier runs on the same robot, features in the goals' order. Method `model` learns from them
    /// before its first trial.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub earlier: Vec<Trial>,
}

/// Settings of an execution: the search, and the end of a goal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct ExecutionSpec {
    /// The optimiser and its parameters; the name alone is the method with its defaults.
    #[serde(deserialize_with = "method_or_name")]
    #[cfg_attr(feature = "schema", schema(value_type = crate::method::MethodChoice))]
    pub method: MethodSpec,
    /// Reason for the method; absent unless `auto` chose it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub chosen: Option<Chosen>,
    /// Measure of a candidate's discrepancy.
    #[serde(default)]
    pub metric: Metric,
    /// Discrepancy of the partial observation at which a goal ends, or the whole run if the method plans it (features'
    /// unit).
    #[serde(default)]
    pub target_discrepancy: Option<f64>,
    /// Euclidean distance of an executed observation from the goal at which the goal ends (features' unit).
    #[serde(default)]
    pub tolerance: Option<f64>,
    /// Number of evaluations after which a goal ends; moves that identify an unknown robot are not counted.
    #[serde(default)]
    pub max_evaluations_per_goal: Option<u64>,
    /// Total width of the seeded uniform noise added to each discrepancy (features' unit); 0 is none. The published
    /// runs' simulator was not exactly repeatable: 1e-13 mm reproduces their stagnation counts.
    #[serde(default)]
    pub rounding_noise: f64,
    /// Deviation of the simulated reality from its description; if absent, there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reality: Option<DisturbanceSpec>,
    /// Constraints that every candidate must satisfy.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub constraints: Vec<ConstraintSpec>,
    /// Treatment of candidates that violate a constraint.
    #[serde(default, skip_serializing_if = "is_default")]
    pub handling: HandlingSpec,
    /// Treatment of goals for which no candidate satisfies the constraints.
    #[serde(default, skip_serializing_if = "is_default")]
    pub on_infeasible: OnInfeasible,
}

impl Problem {
    /// Replaces `auto` by the method that it stands for and records the reason; the record of an earlier choice is
    /// dropped once the problem has another method.
    pub fn choose(&mut self) {
        let chosen = self.execution.stands_for(&self.world);
        let execution = &mut self.execution;
        if let Some((method, reason)) = chosen {
            execution.chosen = Some(Chosen { method: method.name().to_owned(), reason: reason.to_owned() });
            execution.method = method;
        } else if execution.chosen.as_ref().is_some_and(|chosen| chosen.method != execution.method.name()) {
            execution.chosen = None;
        }
    }
}

fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

impl ExecutionSpec {
    /// Settings with `method` and defaults for the rest.
    #[must_use]
    pub fn new(method: MethodSpec) -> Self {
        Self {
            method,
            chosen: None,
            metric: Metric::default(),
            target_discrepancy: None,
            tolerance: None,
            max_evaluations_per_goal: None,
            rounding_noise: 0.0,
            reality: None,
            constraints: Vec::new(),
            handling: HandlingSpec::default(),
            on_infeasible: OnInfeasible::default(),
        }
    }

    /// Appends a `collision_free` constraint with its defaults, unless one is given.
    pub fn avoid_collisions(&mut self) {
        if !self.checks_collisions() {
            self.constraints.push(ConstraintSpec::CollisionFree(CollisionFreeSpec::default()));
        }
    }

    /// Whether a constraint keeps the robot's poses free of collisions.
    #[must_use]
    pub fn checks_collisions(&self) -> bool {
        self.collision_free().is_some()
    }

    /// The constraint that keeps the robot free of collisions; `None` if there is none.
    #[must_use]
    pub fn collision_free(&self) -> Option<&CollisionFreeSpec> {
        self.constraints.iter().find_map(|constraint| match constraint {
            ConstraintSpec::CollisionFree(spec) => Some(spec),
            _ => None,
        })
    }

    /// The method that `auto` stands for in `world`, and the reason; `None` if the method is given by its own name.
    pub(super) fn stands_for(&self, world: &WorldSpec) -> Option<(MethodSpec, &'static str)> {
        let wishes = self.method.wishes()?;
        Some(choose(wishes, self.needs_population(), &world.properties()))
    }

    /// Whether a method that plans the whole run would refuse the constraints or their handling.
    fn needs_population(&self) -> bool {
        let ancestors = |constraint: &ConstraintSpec| matches!(constraint, ConstraintSpec::PopulationVelocity(_));
        self.constraints.iter().any(ancestors) || !matches!(self.handling, HandlingSpec::Rejecting { .. })
    }
}
