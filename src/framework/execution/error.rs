//! Reasons why a problem cannot be executed.

use crate::constraint::ConstraintError;
use crate::method::per_goal::OptimizerError;
use crate::range::OutOfRange;
use crate::robot::{ChainError, ModelError};
use crate::world::WorldError;

/// A problem cannot be started or resumed.
#[derive(Debug, thiserror::Error)]
pub enum ProblemError {
    /// The URDF is invalid.
    #[error("robot: {0}")]
    Model(#[from] ModelError),
    /// The robot description is invalid.
    #[error("robot: {0}")]
    Chain(#[from] ChainError),
    /// The world is invalid.
    #[error("world: {0}")]
    World(#[from] WorldError),
    /// The method is invalid.
    #[error("method: {0}")]
    Optimizer(#[from] OptimizerError),
    /// The constraints are invalid.
    #[error("constraints: {0}")]
    Constraint(#[from] ConstraintError),
    /// The world does not have a feature of the goals.
    #[error("the goals need feature {feature:?}, which the world does not have; it has {shown:?}")]
    UnknownFeature {
        /// Name of the missing feature.
        feature: String,
        /// Names of the world's features.
        shown: Vec<String>,
    },
    /// Goals and world use different units.
    #[error("feature {feature:?} is in {goal_unit:?} in the goals and in {world_unit:?} in the world: use one unit")]
    Unit {
        /// Name of the feature.
        feature: String,
        /// Unit of the goals.
        goal_unit: String,
        /// Unit of the world.
        world_unit: String,
    },
    /// The method does not suit the world.
    #[error("method {method} needs {expected}")]
    Method {
        /// Method name.
        method: &'static str,
        /// Requirement of the method.
        expected: &'static str,
    },
    /// A goal, a limit or a threshold is out of range.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// The saved run has another version.
    #[error("the saved run has version {found}, but this program reads {expected}: run the job again")]
    Version {
        /// Version of the saved state.
        found: u32,
        /// Version that this program reads.
        expected: u32,
    },
    /// The saved run belongs to another problem.
    #[error("the saved run has {found} {what}, but the problem has {expected}: it belongs to another job")]
    Shape {
        /// Property that does not match.
        what: &'static str,
        /// Number in the saved state.
        found: usize,
        /// Number required by the problem.
        expected: usize,
    },
    /// An earlier trial belongs to another robot or has other features.
    #[error(
        "earlier trial {trial} has {found} {what}, the problem has {expected}: give trials of the same robot and \
         features, or none"
    )]
    Earlier {
        /// Index of the trial, from 0.
        trial: usize,
        /// Property that does not match.
        what: &'static str,
        /// Number in the trial.
        found: usize,
        /// Number required by the problem.
        expected: usize,
    },
    /// No trial of a goal was executed and observed.
    #[error(
        "goal {goal}: none of {trials} trials was executed and observed: check the robot, its limits and its sensors"
    )]
    NothingExecuted {
        /// Goal index from 0.
        goal: usize,
        /// Number of trials made.
        trials: u64,
    },
    /// No candidate of a goal satisfied the constraints.
    #[error(
        "goal {goal}: no candidate satisfied the constraints within the search's limits; the nearest violated them by \
         {nearest:?} (m or rad, one per constraint): widen them, raise max_attempts or the population, or set \
         on_infeasible = \"append\" with a penalty"
    )]
    Infeasible {
        /// Goal index from 0.
        goal: usize,
        /// The smallest violations found, one per constraint, m or rad.
        nearest: Vec<f64>,
        /// Number of evaluations of the run so far.
        evaluations: u64,
    },
    /// The result was requested before the end of the run.
    #[error("the run is at goal {goal} of {goals}: it has no result yet")]
    Unfinished {
        /// Index of the current goal, from 0.
        goal: usize,
        /// Number of goals.
        goals: usize,
    },
}
