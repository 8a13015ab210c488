//! Reasons why constraints are invalid; every error carries the numbers and a remedy.

use crate::range::{OutOfRange, plain};

/// A constraint is invalid.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ConstraintError {
    /// A number is not finite or out of range.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// An annealing penalty that does not cool down, or at once.
    #[error("cooling is {}: give more than 0 and less than 1", plain(*value))]
    Cooling {
        /// Value given.
        value: f64,
    },
    /// An adaptive penalty would undo each change by the opposite one.
    #[error("relax and tighten are both {}: give two different factors", plain(*value))]
    EqualFactors {
        /// Value of both.
        value: f64,
    },
    /// The sides of a box cross.
    #[error("the box is empty: {axis} goes from {} m to {} m after dilatation", plain(*lower), plain(*upper))]
    EmptyBox {
        /// `x`, `y` or `z`.
        axis: &'static str,
        /// Lower side after dilatation, m.
        lower: f64,
        /// Upper side after dilatation, m.
        upper: f64,
    },
    /// A half-space has no normal.
    #[error("normal {normal:?} has no direction: give a non-zero vector that points outwards")]
    NoDirection {
        /// Normal vector given.
        normal: [f64; 3],
    },
    /// A polyhedron has no faces.
    #[error("a polyhedron needs at least one half-space")]
    NoHalfSpace,
    /// A hull has too few or too many points.
    #[error("a hull of {found} points: give 4 to {limit}")]
    HullPoints {
        /// Number of points given.
        found: usize,
        /// Maximum number of points.
        limit: usize,
    },
    /// All points of a hull lie in one plane.
    #[error("the hull of these {points} points has no volume: add a point outside their plane")]
    FlatHull {
        /// Number of points given.
        points: usize,
    },
    /// A constraint names a joint that the chain does not move.
    #[error("a constraint names joint {joint:?}, which is not free here: the free joints are {free:?}")]
    UnknownJoint {
        /// Name given.
        joint: String,
        /// Names of the free joints.
        free: Vec<String>,
    },
    /// A pose has the wrong number of joints.
    #[error("{field} has {found} joint values, but the chain has {expected}")]
    PoseLength {
        /// Field of the description.
        field: &'static str,
        /// Number of values given.
        found: usize,
        /// Number of free joints of the chain.
        expected: usize,
    },
    /// The constrained link is not part of the robot.
    #[error("the constrained point cannot be reached: {0}")]
    Point(#[from] crate::robot::ChainError),
    /// The collision model cannot be built.
    #[error("collision_free: {0}")]
    Collision(#[from] crate::collision::CollisionError),
    /// The robot starts in collision.
    #[error(
        "collision_free: at the home pose {:?} and {:?} are {distance_m:.4} m apart, less than the margin of {margin_m} \
         m: give another home pose, or exclude the pair if the two belong together", pair[0], pair[1]
    )]
    HomeCollides {
        /// Names of the two links, or of a link and an obstacle.
        pair: [String; 2],
        /// Their distance, m; 0 if they overlap.
        distance_m: f64,
        /// Distance required, m.
        margin_m: f64,
    },
    /// Collisions are described more than once.
    #[error("collision_free is given more than once: put all obstacles and excluded pairs into one")]
    SecondCollisionFree,
    /// Appending is impossible, because the strategy gives infeasible candidates no discrepancy.
    #[error(
        "on_infeasible \"append\" needs handling \"penalty\": {strategy} gives an infeasible candidate no discrepancy, so \
         that none is the least bad; take a penalty, or on_infeasible \"stop\""
    )]
    NothingToAppend {
        /// Name of the strategy.
        strategy: &'static str,
    },
    /// Winners that were never executed could violate a constraint.
    #[error("unexecuted_may_win cannot be combined with constraints: a winner that was never judged would be executed")]
    UnexecutedWinner,
}
