//! Reasons why waypoints or samples do not form a trajectory.

use super::spec::PlanError;
use super::tightest::LimitKind;

/// Reasons why waypoints do not form a trajectory.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TrajectoryError {
    /// There are no waypoints.
    #[error("a trajectory needs at least 1 waypoint")]
    Empty,
    /// A waypoint has the wrong number of values.
    #[error("waypoint {waypoint} has {found} values for {expected} joints")]
    Ragged {
        /// Index of the waypoint, from 0, or the start pose.
        waypoint: String,
        /// Number of values found.
        found: usize,
        /// Number of joints.
        expected: usize,
    },
    /// A sample has the wrong number of values.
    #[error("sample {index} has {found} values for {expected} joints")]
    RaggedSample {
        /// Sample index from 0.
        index: usize,
        /// Number of values found.
        found: usize,
        /// Number of joints.
        expected: usize,
    },
    /// A value is NaN or infinite.
    #[error("joint {joint:?} is {value} at {time_s} s, not a finite number")]
    NonFinite {
        /// Name of the joint.
        joint: String,
        /// Time from the start, s.
        time_s: f64,
        /// Value found, in the unit of the limit.
        value: f64,
    },
    /// A limit is exceeded.
    #[error(
        "{kind} of joint {joint:?} is {value} at {time_s} s, beyond its limit {limit}: change the limit or keep the search within it"
    )]
    Limit {
        /// Kind of limit.
        kind: LimitKind,
        /// Name of the joint.
        joint: String,
        /// Time from the start, s.
        time_s: f64,
        /// Value found, in the unit of the limit.
        value: f64,
        /// Limit, in the same unit.
        limit: f64,
    },
    /// Position, velocity or acceleration jumps between two pieces.
    #[error("{kind} of joint {joint:?} jumps by {by} at {time_s} s")]
    Jump {
        /// Kind of value.
        kind: LimitKind,
        /// Name of the joint.
        joint: String,
        /// Time from the start, s.
        time_s: f64,
        /// Size of the jump.
        by: f64,
    },
    /// Time does not strictly increase by at least a nanosecond, the resolution of exports.
    #[error("sample {index} at {time_s} s is not a nanosecond after {previous_s} s")]
    NonIncreasing {
        /// Sample index from 0.
        index: usize,
        /// Time of the sample, s.
        time_s: f64,
        /// Time of the previous sample, s.
        previous_s: f64,
    },
    /// A joint moves at the start or the end.
    #[error(
        "joint {joint:?} moves at {time_s} s (velocity {velocity}, acceleration {acceleration}): a trajectory must start and end at rest"
    )]
    NotAtRest {
        /// Name of the joint.
        joint: String,
        /// Time from the start, s.
        time_s: f64,
        /// Velocity at that time, rad/s or m/s.
        velocity: f64,
        /// Acceleration at that time, rad/s^2 or m/s^2.
        acceleration: f64,
    },
    /// A choice of the user is not allowed.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// A trajectory would be too long for its sample time.
    #[error("sample_s is {sample_s}: the trajectory would have more than a million samples; give a longer sample time")]
    TooManySamples {
        /// Sample time given, s.
        sample_s: f64,
    },
}
