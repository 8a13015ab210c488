//! Why constraints cannot be used: every error carries the numbers and says what would do.

/// A constraint that cannot be built.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ConstraintError {
    /// NaN or infinity in a description.
    #[error("{field} holds {value}: every number of a constraint must be finite")]
    NotFinite {
        /// Field of the description.
        field: &'static str,
        /// The value given.
        value: f64,
    },
    /// A size or limit that is not above 0.
    #[error("{field} is {value}, it must be above 0")]
    NotPositive {
        /// Field of the description.
        field: &'static str,
        /// The value given.
        value: f64,
    },
    /// A number outside the range its method allows.
    #[error("{field} is {value}: {expected}")]
    OutOfRange {
        /// Field of the description.
        field: &'static str,
        /// The value given.
        value: f64,
        /// The range.
        expected: &'static str,
    },
    /// A box whose sides crossed.
    #[error("the box has no inside: {axis} goes from {lower} m to {upper} m after dilatation")]
    EmptyBox {
        /// `x`, `y` or `z`.
        axis: &'static str,
        /// Lower side after dilatation, m.
        lower: f64,
        /// Upper side after dilatation, m.
        upper: f64,
    },
    /// A half-space without normal.
    #[error("normal {normal:?} has no direction: give a non-zero vector that points outwards")]
    NoDirection {
        /// The normal given.
        normal: [f64; 3],
    },
    /// A polyhedron without faces.
    #[error("a polyhedron needs at least one half-space")]
    NoHalfSpace,
    /// Too few or too many points.
    #[error("a hull of {found} points: 4 to {limit} are allowed")]
    HullPoints {
        /// Points given.
        found: usize,
        /// Most points allowed.
        limit: usize,
    },
    /// Points in one plane.
    #[error("the hull of these {points} points has no volume: add a point outside their plane")]
    FlatHull {
        /// Points given.
        points: usize,
    },
    /// A joint that the chain does not move.
    #[error("constraint names joint {joint:?}, which is not free here: the free joints are {free:?}")]
    UnknownJoint {
        /// The name given.
        joint: String,
        /// The free joints.
        free: Vec<String>,
    },
    /// A pose of another chain.
    #[error("{field} holds {found} joint values, the chain has {expected}")]
    PoseLength {
        /// Field of the description.
        field: &'static str,
        /// Values given.
        found: usize,
        /// Free joints of the chain.
        expected: usize,
    },
    /// The constrained link is not on the robot.
    #[error("the constrained point cannot be reached: {0}")]
    Point(#[from] crate::robot::ChainError),
    /// Nothing could be appended: the strategy gives an infeasible candidate no discrepancy.
    #[error(
        "on_infeasible \"append\" needs handling \"penalty\": {strategy} gives an infeasible candidate no discrepancy, so \
         that none is the least bad; take a penalty, or on_infeasible \"stop\""
    )]
    NothingToAppend {
        /// The strategy.
        strategy: &'static str,
    },
    /// Unexecuted winners could violate a constraint when their goal ends.
    #[error("unexecuted_may_win cannot be combined with constraints: a winner that was never judged would be executed")]
    UnexecutedWinner,
}
