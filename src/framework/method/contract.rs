//! The contract between a method and the framework: its scope, its needs and the check of its parameters.

use super::parameters::Parameters;
use crate::range::OutOfRange;
use crate::world::WorldProperties;
use serde::Serialize;

/// How far a method plans.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Scope {
    /// One search per goal, goal after goal.
    PerGoal,
    /// All goals at once: every trial counts for each goal it is near.
    WholeRun,
    /// Stands for the method that suits the problem.
    Chosen,
}

/// Relation between the robot's motion and the features that a method relies on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Effects {
    /// Any relation.
    Any,
    /// Features follow the pose without jumps.
    Smooth,
    /// Features accumulate over a surface.
    Accumulating,
}

/// Use of the description of robot and world as a simulator.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum SimulatorUse {
    /// Not at all: joints in, features out.
    Never,
    /// As a first guess, if a parameter says so.
    Optional,
    /// As a first guess, which may be wrong; the method cannot work without one.
    Required,
}

/// Needs of a method: the properties a problem must have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Needs {
    /// Relation between motion and features.
    pub effects: Effects,
    /// Whether the world must be put back between trials.
    pub reset: bool,
    /// Use of the description of robot and world.
    pub simulator: SimulatorUse,
}

/// Properties of a method that hold for all its parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Profile {
    /// How far it plans.
    pub scope: Scope,
    /// Whether it is made for a real robot, where every evaluation takes time.
    pub few_evaluations: bool,
    /// Whether it starts from the trials of earlier runs on the same robot.
    pub learns_from_earlier_runs: bool,
    /// Needs of the method.
    pub needs: Needs,
}

/// Knowledge of robot and sensors before the first trial; `None` leaves the method's parameter as it is.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Knowledge {
    /// Whether the description of robot and world may be used as a simulator.
    pub simulator: Option<bool>,
    /// Standard deviation of one observed feature, features' unit.
    pub noise: Option<f64>,
}

/// The parameters of a method; implemented beside its algorithm.
pub trait Method: Parameters {
    /// Scope, needs and cost of the method.
    fn profile(&self) -> Profile;

    /// Whether every parameter is in its range, alone and together with the world.
    ///
    /// # Errors
    /// The first number that is not.
    fn check(&self, world: &WorldProperties) -> Result<(), OutOfRange> {
        let _ = world;
        self.check_ranges()
    }

    /// Whether the method can work in `world`.
    ///
    /// # Errors
    /// The property that the world lacks.
    fn fits(&self, world: &WorldProperties) -> Result<(), &'static str> {
        self.profile().needs.met_by(world)
    }

    /// Adopts knowledge of robot and sensors that the method can use.
    fn assume(&mut self, known: &Knowledge) {
        let _ = known;
    }
}

impl Needs {
    /// # Errors
    /// The property that the world lacks.
    fn met_by(self, world: &WorldProperties) -> Result<(), &'static str> {
        match self.effects {
            Effects::Smooth if !world.smooth => {
                Err("features that follow the pose without jumps; for a surface take particle or search")
            }
            Effects::Accumulating if world.surface.is_none() => Err("a coverage world; take model here"),
            _ if self.reset && !world.resets() => {
                Err("a surface that is put back between trials: take particle or search if it cannot be")
            }
            _ => Ok(()),
        }
    }
}

impl Profile {
    /// A search per goal, in any world that can be put back.
    pub(super) const PER_GOAL: Self = Self {
        scope: Scope::PerGoal,
        few_evaluations: false,
        learns_from_earlier_runs: false,
        needs: Needs { effects: Effects::Any, reset: true, simulator: SimulatorUse::Never },
    };

    /// A plan for all goals, of few evaluations.
    pub(super) const fn whole_run(effects: Effects, simulator: SimulatorUse) -> Self {
        let needs = Needs { effects, reset: false, simulator };
        Self { scope: Scope::WholeRun, few_evaluations: true, learns_from_earlier_runs: false, needs }
    }
}
