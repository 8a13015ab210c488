//! Reasons why a run has no trajectory.

use crate::trajectory::TrajectoryError;

/// A run has no trajectory.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MotionError {
    /// The poses cannot be joined within the limits.
    #[error(transparent)]
    Trajectory(#[from] TrajectoryError),
    /// No way without a contact was found from one pose to the next.
    #[error(
        "no way without a collision was found from {from} to pose {to}{}: on the straight one {:?} meets {:?}; move what \
         is in the way, or run again with another seed",
        serving(*.goal), .pair[0], .pair[1]
    )]
    NoRoute {
        /// The pose it starts at, from 0, or home.
        from: String,
        /// The pose it leads to, from 0.
        to: usize,
        /// First goal which that pose serves; `None` if it serves none.
        goal: Option<usize>,
        /// Names of the two bodies that meet on the straight way.
        pair: [String; 2],
    },
    /// The motion does not have the effect that the run claims.
    #[error("the replay differs: {0}")]
    Replay(String),
}

fn serving(goal: Option<usize>) -> String {
    goal.map_or_else(String::new, |goal| format!(" (goal {goal})"))
}
