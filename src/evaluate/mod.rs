//! Evaluators: what carries out the candidates of an execution.

mod pace;
mod simulation;

pub use pace::Pace;
pub use simulation::Simulation;
