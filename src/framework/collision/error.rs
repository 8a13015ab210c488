//! Reasons why a collision model cannot be built.

use crate::range::OutOfRange;

/// A collision model cannot be built; each variant names the item and a remedy.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CollisionError {
    /// A length, a coordinate or an angle is not finite or out of range.
    #[error("{item}: {number}")]
    OutOfRange {
        /// Link, obstacle or options.
        item: String,
        /// The number and its range.
        number: OutOfRange,
    },
    /// Two things have the same name.
    #[error("obstacle {name:?} has the name of a link or of another obstacle: give it a name of its own")]
    DuplicateName {
        /// Name given.
        name: String,
    },
    /// An excluded pair names nothing.
    #[error("excluded pairs name {name:?}, which is neither a link nor an obstacle: use one of {}", known.join(", "))]
    UnknownName {
        /// Name given.
        name: String,
        /// Names of links and obstacles.
        known: Vec<String>,
    },
    /// The points of a hull do not span a volume.
    #[error(
        "the hull of {obstacle:?} has {points} points but no volume: give at least 4 points that are not in a plane"
    )]
    FlatHull {
        /// Name of the obstacle.
        obstacle: String,
        /// Number of points.
        points: usize,
    },
    /// A half-space has no normal.
    #[error("the normal of {obstacle:?} has no direction: give a non-zero vector that points to the free side")]
    NoDirection {
        /// Name of the obstacle.
        obstacle: String,
    },
    /// The cells of a surface do not span a plane.
    #[error("the cells of {obstacle:?} span no plane: give column and row steps that are neither zero nor parallel")]
    NoPlane {
        /// Name of the obstacle.
        obstacle: String,
    },
    /// The tool's home position does not tell the two sides of a surface apart.
    #[error("the tool at home is in the plane of {obstacle:?}: give a home pose in front of it")]
    NoSide {
        /// Name of the obstacle.
        obstacle: String,
    },
}
