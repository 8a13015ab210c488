//! A problem: all an execution needs, self-contained and serialisable, so that a job can be rerun from it alone.

use crate::constraint::{ConstraintSpec, HandlingSpec, OnInfeasible};
use crate::generalization::Goals;
use crate::method::whole_run::Trial;
use crate::method::{Chosen, MethodChoice, MethodSpec, choose, method_or_name};
use crate::recognition::Metric;
use crate::robot::RobotSpec;
use crate::world::{DisturbanceSpec, WorldSpec};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Goals, robot, world and method of one execution; the seed is given beside it, once for each repetition.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Problem {
    /// X, the generalized action.
    pub goals: Goals,
    /// The robot's URDF, as text.
    pub urdf: String,
    /// Which part of the robot moves.
    pub robot: RobotSpec,
    /// Where the effects happen.
    pub world: WorldSpec,
    /// How to search.
    pub execution: ExecutionSpec,
    /// Trials of earlier runs on the same robot, features in the goals' order: a model begins with what they taught.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub earlier: Vec<Trial>,
}

/// How an execution searches and when a goal ends.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct ExecutionSpec {
    /// The optimiser and its parameters; the name alone is the method with its defaults.
    #[serde(deserialize_with = "method_or_name")]
    #[schema(value_type = MethodChoice)]
    pub method: MethodSpec,
    /// Why this method, where `auto` stood for it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub chosen: Option<Chosen>,
    /// How a candidate's discrepancy is measured.
    #[serde(default)]
    pub metric: Metric,
    /// A goal, or the run of a method that owns it, ends at this discrepancy of all observed so far (features' unit).
    #[serde(default)]
    pub target_discrepancy: Option<f64>,
    /// A goal ends when an executed observation is at most this far (Euclidean, features' unit) from the goal.
    #[serde(default)]
    pub tolerance: Option<f64>,
    /// A goal ends after this many evaluations; moves that identify an unknown robot are not counted.
    #[serde(default)]
    pub max_evaluations_per_goal: Option<u64>,
    /// Total width of the seeded uniform noise added to each discrepancy (features' unit); 0 is none. The published
    /// runs' simulator was not exactly repeatable: 1e-13 mm reproduces their stagnation counts.
    #[serde(default)]
    pub rounding_noise: f64,
    /// How far the simulated real world is from its description; as described when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reality: Option<DisturbanceSpec>,
    /// What every candidate must satisfy.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub constraints: Vec<ConstraintSpec>,
    /// What is done about candidates that do not.
    #[serde(default, skip_serializing_if = "is_default")]
    pub handling: HandlingSpec,
    /// What is done about goals for which no candidate does.
    #[serde(default, skip_serializing_if = "is_default")]
    pub on_infeasible: OnInfeasible,
}

impl Problem {
    /// Puts the method that `auto` stands for in its place and records why; an earlier choice is kept only while it is
    /// still the method.
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
    /// `method` with everything else as it is by default.
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

    /// The method that `auto` stands for in `world`, and why; `None` if the method is given by its own name.
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
