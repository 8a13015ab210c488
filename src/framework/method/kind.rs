//! A method that can be run, by how far it plans.

use super::per_goal::PerGoalMethod;
use super::whole_run::WholeRunMethod;

/// A method that can be run, by how far it plans.
pub enum MethodKind {
    /// One search per goal, goal after goal.
    PerGoal(Box<dyn PerGoalMethod>),
    /// All goals at once.
    WholeRun(Box<dyn WholeRunMethod>),
}
