//! Kinds of limits, and how much of each a trajectory uses.

use serde::{Deserialize, Serialize};

/// A kind of limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum LimitKind {
    /// Position within lower and upper.
    Position,
    /// Magnitude of the velocity.
    Velocity,
    /// Magnitude of the acceleration.
    Acceleration,
    /// Magnitude of the jerk, the rate at which the acceleration changes.
    Jerk,
}

impl std::fmt::Display for LimitKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Position => "position",
            Self::Velocity => "velocity",
            Self::Acceleration => "acceleration",
            Self::Jerk => "jerk",
        })
    }
}

/// The point at which a kind of limit is used most.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Tightest {
    /// Kind of limit.
    pub kind: LimitKind,
    /// Joint name.
    pub joint: String,
    /// Time from the start, s.
    pub time_s: f64,
    /// Value at that time, in the limit's unit.
    pub value: f64,
    /// Limit at that time; for positions the closer of the two.
    pub limit: f64,
    /// Share of the limit used: 1 means at the limit. For positions, the distance from the middle of the range divided
    /// by half the range.
    pub ratio: f64,
}
