//! Why a problem cannot be executed.

use crate::constraint::ConstraintError;
use crate::method::per_goal::OptimizerError;
use crate::robot::{ChainError, ModelError};
use crate::world::WorldError;

/// A problem that cannot be run or gone on with.
#[derive(Debug, thiserror::Error)]
pub enum ProblemError {
    /// The URDF.
    #[error("robot: {0}")]
    Model(#[from] ModelError),
    /// The chain.
    #[error("robot: {0}")]
    Chain(#[from] ChainError),
    /// The world.
    #[error("world: {0}")]
    World(#[from] WorldError),
    /// The method.
    #[error("method: {0}")]
    Optimizer(#[from] OptimizerError),
    /// The constraints.
    #[error("constraints: {0}")]
    Constraint(#[from] ConstraintError),
    /// A goal feature the world does not show.
    #[error("the goals need feature {feature:?}, which the world does not show; it shows {shown:?}")]
    UnknownFeature {
        /// The feature of the goals.
        feature: String,
        /// The world's features.
        shown: Vec<String>,
    },
    /// Goals and world measure in different units.
    #[error("feature {feature:?} is in {goal_unit:?} in the goals and in {world_unit:?} in the world: use one unit")]
    Unit {
        /// The feature.
        feature: String,
        /// Unit of the goals.
        goal_unit: String,
        /// Unit of the world.
        world_unit: String,
    },
    /// A method that does not fit the world.
    #[error("method {method} needs {expected}")]
    Method {
        /// Method name.
        method: &'static str,
        /// What it needs.
        expected: &'static str,
    },
    /// A limit or threshold out of its range.
    #[error("{field} is {value}: {expected}")]
    Value {
        /// The field.
        field: &'static str,
        /// The value given.
        value: f64,
        /// What is expected.
        expected: &'static str,
    },
    /// A saved run of another version.
    #[error("the saved run has version {found}, this program reads {expected}: run the job again")]
    Version {
        /// Version of the state.
        found: u32,
        /// Version understood.
        expected: u32,
    },
    /// A saved run of another problem.
    #[error("the saved run has {found} {what}, the problem has {expected}: it belongs to another job")]
    Shape {
        /// What does not fit.
        what: &'static str,
        /// Number found.
        found: usize,
        /// Number needed.
        expected: usize,
    },
    /// A trial of another robot, or of other features, among the earlier ones.
    #[error(
        "earlier trial {trial} has {found} {what}, the problem has {expected}: give trials of the same robot and \
         features, or none"
    )]
    Earlier {
        /// Its index from 0.
        trial: usize,
        /// What does not fit.
        what: &'static str,
        /// Number found.
        found: usize,
        /// Number needed.
        expected: usize,
    },
    /// Every trial of a goal failed or was not seen.
    #[error("goal {goal}: none of {trials} trials was executed and seen; check the robot, its limits and its sensors")]
    NothingExecuted {
        /// Goal index from 0.
        goal: usize,
        /// Trials made.
        trials: u64,
    },
    /// No candidate of a goal satisfied the constraints.
    #[error(
        "goal {goal}: no candidate satisfied the constraints within the search's limits; the nearest violated them by \
         {nearest:?} (m or rad, one a constraint): widen them, raise max_attempts or the population, or set \
         on_infeasible = \"append\" with a penalty"
    )]
    Infeasible {
        /// Goal index from 0.
        goal: usize,
        /// The smallest violations met, one a constraint, m or rad.
        nearest: Vec<f64>,
        /// Evaluations of the run until then.
        evaluations: u64,
    },
    /// Asked for a result too early.
    #[error("the run is at goal {goal} of {goals}: it has no result yet")]
    Unfinished {
        /// Goal being searched.
        goal: usize,
        /// Number of goals.
        goals: usize,
    },
}
