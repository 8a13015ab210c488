//! The catalogue: one row per method, from which everything that knows methods by name follows.
//!
//! A row holds the method's sentence, the type of its parameters, its name, its label and how far it plans. Parsing,
//! checking, starting and resuming, the help of the command line and the ranges of the OpenAPI document follow from it.
//!
//! # Architecture Invariants
//! - Nothing outside this file matches on every method: ask the method instead.
//! - A method's name is written in its row alone; the method itself reads it as `Spec::NAME`.

use super::auto::AutoSpec;
use super::contract::{Knowledge, Method, Profile, Scope};
use super::kind::MethodKind;
use super::parameters::{Parameter, Parameters, sentence};
use super::per_goal::{AffgPsoSpec, CmaEsSpec, DeSpec, FiPsoSpec, PsoSpec, SstSpec};
use super::per_goal::{Optimizer, OptimizerError, OptimizerState, PerGoalMethod, SearchSpace};
use super::whole_run::{BroydenSpec, CoverSpec, ModelSpec, ParticleSpec};
use crate::range::OutOfRange;
use crate::tagged;
use crate::world::WorldProperties;
use serde::Serialize;

/// A method as the catalogue describes it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MethodEntry {
    /// Name, as written in presets, in requests and on the command line.
    pub name: &'static str,
    /// Name for people.
    pub label: &'static str,
    /// Purpose: how it works, and the problems it suits.
    pub purpose: String,
    /// Scope, needs and cost.
    #[serde(flatten)]
    pub profile: Profile,
    /// Its parameters, in the order of a form.
    pub parameters: Vec<Parameter>,
    /// Name of the parameters' schema in the OpenAPI document.
    #[serde(skip)]
    pub schema: &'static str,
}

/// The method of some parameters, by the last word of its row.
macro_rules! runs {
    (per_goal, $spec:ident) => {
        Some(MethodKind::PerGoal(Box::new($spec.clone())))
    };
    (whole_run, $spec:ident) => {
        Some(MethodKind::WholeRun(Box::new($spec.clone())))
    };
    (chosen, $spec:ident) => {{
        let _ = $spec;
        None
    }};
}

macro_rules! catalogue {
    ($($(#[doc = $sentence:literal])+ $variant:ident($spec:ident) = $name:literal, $label:literal, $runs:ident;)+) => {
        tagged! {
            /// A method with its parameters; `name` picks one.
            #[derive(Debug, Clone, PartialEq, Serialize)]
            #[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
            #[serde(tag = "name", rename_all = "snake_case")]
            pub enum MethodSpec {
                $(
                    $(#[doc = $sentence])+
                    $variant($spec),
                )+
            }
        }

        $(
            impl $spec {
                /// Name of the method in presets, in requests, on the command line and in saved states.
                pub const NAME: &'static str = $name;
            }
        )+

        impl MethodSpec {
            /// Names of all methods.
            pub const NAMES: [&'static str; [$($name),+].len()] = [$($spec::NAME),+];

            /// The method of that name with its defaults.
            #[must_use]
            pub fn by_name(name: &str) -> Option<Self> {
                match name {
                    $($spec::NAME => Some(Self::$variant($spec::default())),)+
                    _ => None,
                }
            }

            /// The method's name, as written in presets and on the command line.
            #[must_use]
            pub fn name(&self) -> &'static str {
                match self {
                    $(Self::$variant(_) => $spec::NAME,)+
                }
            }

            /// The method at work with these parameters; `None` for `auto`, which stands for another.
            #[must_use]
            pub fn kind(&self) -> Option<MethodKind> {
                match self {
                    $(Self::$variant(spec) => runs!($runs, spec),)+
                }
            }

            fn method(&self) -> &dyn Method {
                match self {
                    $(Self::$variant(spec) => spec,)+
                }
            }

            fn method_mut(&mut self) -> &mut dyn Method {
                match self {
                    $(Self::$variant(spec) => spec,)+
                }
            }
        }

        /// All methods, in the order of a menu.
        #[must_use]
        pub fn catalogue() -> Vec<MethodEntry> {
            vec![$(
                MethodEntry {
                    name: $spec::NAME,
                    label: $label,
                    purpose: sentence(&[$($sentence),+]),
                    profile: $spec::default().profile(),
                    parameters: $spec::parameters(),
                    schema: stringify!($spec),
                }
            ),+]
        }
    };
}

catalogue! {
    /// Chosen for the features, the world and the constraints when the job is submitted; the choice and its reason are
    /// recorded.
    Auto(AutoSpec) = "auto", "Automatic", chosen;
    /// The paper's steady-state tournament: thousands of evaluations, for simulation.
    Sst(SstSpec) = "sst", "SST", per_goal;
    /// Particle swarm: thousands of evaluations, for simulation.
    Pso(PsoSpec) = "pso", "PSO", per_goal;
    /// Particle swarm with fitness inheritance: fewer evaluations than PSO, farther from the goals.
    FiPso(FiPsoSpec) = "fi_pso", "FI-PSO", per_goal;
    /// Particle swarm with adaptive fuzzy fitness granulation: fewer evaluations than PSO, farther from the goals.
    AffgPso(AffgPsoSpec) = "affg_pso", "AFFG-PSO", per_goal;
    /// Covariance matrix adaptation, begun at the previous goal's result: hundreds of evaluations, for features that jump
    /// or a robot beyond modelling.
    CmaEs(CmaEsSpec) = "cma_es", "CMA-ES", per_goal;
    /// Differential evolution: tens of thousands of evaluations, for simulation; close to the goals, few parameters.
    De(DeSpec) = "de", "DE", per_goal;
    /// Gauss-Newton with Broyden's Jacobian, carried over from goal to goal, a classical yardstick: few evaluations where
    /// it converges, with some bad runs.
    Broyden(BroydenSpec) = "broyden", "Broyden", whole_run;
    /// One Gaussian process of the feature map plans the whole run: a dozen evaluations. Each trial is the pose expected
    /// nearest to a goal; a goal out of reach is reported with its best residual.
    Model(ModelSpec) = "model", "MODEL-IET", whole_run;
    /// A surface with the described robot as an uncertain simulator: about one evaluation per pose of the cover. Many slightly
    /// different robots vote for the next pose, and each trial reweighs them.
    Particle(ParticleSpec) = "particle", "PARTICLE-IET", whole_run;
    /// A surface with nothing known: each trial goes where past trials leave the best chance of a new cell. About four times
    /// the evaluations of PARTICLE-IET on a dozen cells, ten times on hundreds.
    Search(CoverSpec) = "search", "SEARCH-IET", whole_run;
}

impl MethodSpec {
    /// Scope, needs and cost of the method.
    #[must_use]
    pub fn profile(&self) -> Profile {
        self.method().profile()
    }

    /// Whether it plans the whole run instead of searching goal after goal.
    #[must_use]
    pub fn plans_whole_run(&self) -> bool {
        self.profile().scope == Scope::WholeRun
    }

    /// Whether every parameter is in its range, alone and together with the world.
    ///
    /// # Errors
    /// The first number that is not.
    pub fn check(&self, world: &WorldProperties) -> Result<(), OutOfRange> {
        self.method().check(world)
    }

    /// Whether the method can work in `world`.
    ///
    /// # Errors
    /// The property that the world lacks.
    pub fn fits(&self, world: &WorldProperties) -> Result<(), &'static str> {
        self.method().fits(world)
    }

    /// The wishes of `auto`; `None` for every method that can be run as it is.
    #[must_use]
    pub fn wishes(&self) -> Option<&AutoSpec> {
        if let Self::Auto(wishes) = self { Some(wishes) } else { None }
    }

    /// Adopts knowledge of robot and sensors that the method can use.
    pub fn assume(&mut self, known: &Knowledge) {
        self.method_mut().assume(known);
    }

    /// A fresh search for one goal; `goal` separates the goals of one seed.
    ///
    /// # Errors
    /// [`OptimizerError`] for a parameter out of its range or a method that does not search goal after goal.
    pub fn start(&self, space: SearchSpace, seed: u64, goal: u64) -> Result<Box<dyn Optimizer>, OptimizerError> {
        self.per_goal()?.start(space, seed, goal)
    }

    /// Goes on with a saved search for one goal.
    ///
    /// # Errors
    /// As [`MethodSpec::start`], and if the state does not fit the method and the space.
    pub fn resume(&self, space: SearchSpace, state: OptimizerState) -> Result<Box<dyn Optimizer>, OptimizerError> {
        self.per_goal()?.resume(space, state)
    }

    fn per_goal(&self) -> Result<Box<dyn PerGoalMethod>, OptimizerError> {
        match self.kind() {
            Some(MethodKind::PerGoal(method)) => Ok(method),
            _ => Err(OptimizerError::NotPerGoal { method: self.name() }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::parameters::Values;
    use serde_json::{Value, json};

    #[test]
    fn every_method_says_what_it_is_for_and_each_parameter_too() {
        for entry in catalogue() {
            assert!(entry.purpose.ends_with('.') && !entry.purpose.contains("  "), "{}: {}", entry.name, entry.purpose);
            for parameter in &entry.parameters {
                assert!(parameter.purpose.ends_with('.'), "{}.{}: {}", entry.name, parameter.name, parameter.purpose);
            }
        }
    }

    #[test]
    fn defaults_lie_in_their_ranges_and_are_what_a_name_alone_means() {
        for entry in catalogue() {
            let method = MethodSpec::by_name(entry.name).unwrap();
            assert_eq!(method.method().check_ranges(), Ok(()), "{}", entry.name);
            let written = serde_json::to_value(&method).unwrap();
            assert_eq!(written["name"], entry.name);
            for parameter in &entry.parameters {
                let default = written.get(parameter.name).cloned().unwrap_or(Value::Null);
                assert_eq!(default, parameter.default, "{}.{}", entry.name, parameter.name);
            }
        }
    }

    /// Each number just outside its range, written as a user would.
    #[test]
    fn a_number_outside_its_range_is_refused_by_name() {
        for entry in catalogue() {
            for parameter in &entry.parameters {
                let (Values::Number { range } | Values::Integer { range }) = &parameter.values else { continue };
                let least = range.minimum.map(|least| least - 1.0).or(range.exclusive_minimum);
                for value in [least, range.maximum.map(|most| most + 1.0)].into_iter().flatten() {
                    let whole = matches!(parameter.values, Values::Integer { .. });
                    #[expect(clippy::cast_possible_truncation, reason = "whole numbers of 32 bits")]
                    let written = if whole { json!(value as i64) } else { json!(value) };
                    let method = json!({"name": entry.name, parameter.name: written});
                    let Ok(method) = serde_json::from_value::<MethodSpec>(method) else { continue };
                    let refused = method.method().check_ranges().unwrap_err();
                    assert_eq!((refused.parameter, refused.value), (parameter.name, value), "{}", entry.name);
                }
            }
        }
    }

    #[test]
    fn an_entry_is_written_as_data() {
        let entries = serde_json::to_value(catalogue()).unwrap();
        let model = entries.as_array().unwrap().iter().find(|entry| entry["name"] == "model").unwrap();
        assert_eq!(model["scope"], "whole_run");
        assert_eq!(model["needs"], json!({"effects": "smooth", "reset": false, "simulator": "optional"}));
        let tries = model["parameters"].as_array().unwrap().iter().find(|p| p["name"] == "max_tries").unwrap();
        assert_eq!(tries["default"], 15);
        assert_eq!(tries["values"], json!({"type": "integer", "range": {"minimum": 1.0, "maximum": 10000.0}}));
    }
}
