//! IET, Incrementally Evolved Trajectories, as a state machine without I/O.

#[cfg(test)]
mod bounded_tests;
mod checks;
#[cfg(test)]
mod choice_tests;
mod discrepancy;
#[cfg(test)]
mod disturbed_tests;
mod error;
mod estimate;
mod goal_search;
mod iet;
#[cfg(test)]
mod model_tests;
mod observations;
mod path;
mod replay;
#[cfg(test)]
mod replay_tests;
mod result;
mod setup;
mod simulate;
mod spec;
mod state;
#[cfg(test)]
mod tests;
mod true_discrepancy;
#[cfg(test)]
mod unknown_tests;
mod verdict;
mod whole_run_driver;

pub use crate::method::Chosen;
pub use discrepancy::PartialDiscrepancy;
pub use error::ProblemError;
pub use estimate::{Preview, ROBOT_TRIAL_S, in_words};
pub use iet::Iet;
pub use observations::{Observations, Seen};
pub use path::PathPose;
pub use replay::{AlongMotion, Difference, Moves, Replay, Replayed, SAMPLES_PER_MOVE, replay};
pub use result::{GoalResult, Progress, RunResult, TracePoint};
pub use simulate::{run, run_while, simulate, simulated_world};
pub use spec::{ExecutionSpec, Problem};
pub use state::IetState;
pub use true_discrepancy::DiscrepancyEstimate;
pub use verdict::{Judgement, RunOutcome, RunVerdict, Verdict};
