//! A trajectory that has passed all checks, and how close it comes to each limit.

use crate::range::OutOfRange;
use serde::{Deserialize, Serialize};

/// One sample of a trajectory.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Time from the start, s.
    pub time_s: f64,
    /// Joint positions in gene order, rad or m.
    pub positions: Vec<f64>,
    /// Joint velocities in gene order, rad/s or m/s.
    pub velocities: Vec<f64>,
    /// Joint accelerations in gene order, rad/s^2 or m/s^2.
    pub accelerations: Vec<f64>,
    /// Index of the waypoint reached here, from 0; `None` between waypoints.
    pub waypoint: Option<usize>,
}

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

/// Planning limits of one joint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct JointLimits {
    pub name: String,
    pub lower: f64,
    pub upper: f64,
    pub velocity: f64,
    pub acceleration: f64,
}

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
        /// `position`, `velocity` or `acceleration`.
        kind: &'static str,
        /// Name of the joint.
        joint: String,
        /// Time from the start, s.
        time_s: f64,
        /// Value found, in the unit of the limit.
        value: f64,
        /// Limit, in the same unit.
        limit: f64,
    },
    /// Time does not strictly increase.
    #[error("sample {index} at {time_s} s is not after {previous_s} s")]
    NonIncreasing {
        /// Sample index from 0.
        index: usize,
        /// Time of the sample, s.
        time_s: f64,
        /// Time of the previous sample, s.
        previous_s: f64,
    },
    /// A joint moves at the start or the end.
    #[error("joint {joint:?} moves at {velocity} at {time_s} s: a trajectory must start and end at rest")]
    NotAtRest {
        /// Name of the joint.
        joint: String,
        /// Time from the start, s.
        time_s: f64,
        /// Velocity at that time, rad/s or m/s.
        velocity: f64,
    },
    /// A planning parameter is out of range.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// A trajectory would be too long for its sample time.
    #[error("sample_s is {sample_s}: the trajectory would have more than a million samples; give a longer sample time")]
    TooManySamples {
        /// Sample time given, s.
        sample_s: f64,
    },
}

/// A trajectory within all limits. Only [`plan()`](super::plan()) creates one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CheckedTrajectory {
    joints: Vec<String>,
    fixed_joints: std::collections::BTreeMap<String, f64>,
    points: Vec<Point>,
    tightest: Vec<Tightest>,
    notes: Vec<String>,
}

/// Relative amount by which a computed value may exceed its limit, for rounding.
const SLACK: f64 = 1e-9;

impl CheckedTrajectory {
    pub(super) fn new(
        limits: &[JointLimits],
        fixed_joints: std::collections::BTreeMap<String, f64>,
        points: Vec<Point>,
        notes: Vec<String>,
    ) -> Result<Self, TrajectoryError> {
        check_time(&points)?;
        check_ends(limits, &points)?;
        let mut tightest: Vec<Tightest> = Vec::new();
        for point in &points {
            for (index, limit) in limits.iter().enumerate() {
                for used in usage(limit, point, index) {
                    if !used.value.is_finite() {
                        let (joint, time_s) = (limit.name.clone(), point.time_s);
                        return Err(TrajectoryError::NonFinite { joint, time_s, value: used.value });
                    }
                    if used.ratio > 1.0 + SLACK {
                        return Err(TrajectoryError::Limit {
                            kind: match used.kind {
                                LimitKind::Position => "position",
                                LimitKind::Velocity => "velocity",
                                LimitKind::Acceleration => "acceleration",
                            },
                            joint: used.joint,
                            time_s: used.time_s,
                            value: used.value,
                            limit: used.limit,
                        });
                    }
                    match tightest.iter_mut().find(|t| t.kind == used.kind) {
                        None => tightest.push(used),
                        Some(most) if used.ratio > most.ratio => *most = used,
                        Some(_) => {}
                    }
                }
            }
        }
        let joints = limits.iter().map(|l| l.name.clone()).collect();
        Ok(Self { joints, fixed_joints, points, tightest, notes })
    }

    /// Joint names, in the order of each point's values.
    #[must_use]
    pub fn joints(&self) -> &[String] {
        &self.joints
    }

    /// Joints of the chain held at a constant value throughout, rad or m.
    #[must_use]
    pub fn fixed_joints(&self) -> &std::collections::BTreeMap<String, f64> {
        &self.fixed_joints
    }

    /// The samples; time increases from 0.
    #[must_use]
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// Time from first to last sample, s.
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        self.points.last().map_or(0.0, |p| p.time_s)
    }

    /// The most used limit of each kind.
    #[must_use]
    pub fn tightest(&self) -> &[Tightest] {
        &self.tightest
    }

    /// Assumptions made in planning.
    #[must_use]
    pub fn notes(&self) -> &[String] {
        &self.notes
    }
}

fn usage(limit: &JointLimits, point: &Point, index: usize) -> [Tightest; 3] {
    let position = point.positions[index];
    let (middle, half) = (f64::midpoint(limit.lower, limit.upper), (limit.upper - limit.lower) / 2.0);
    let away = (position - middle).abs();
    // A joint without a range counts as at its limit while it stays there.
    let position_ratio = if half > 0.0 { away / half } else { 1.0 + away };
    let make = |kind, value: f64, bound, ratio| Tightest {
        kind,
        joint: limit.name.clone(),
        time_s: point.time_s,
        value,
        limit: bound,
        ratio,
    };
    let (velocity, acceleration) = (point.velocities[index], point.accelerations[index]);
    let nearer = if position >= middle { limit.upper } else { limit.lower };
    [
        make(LimitKind::Position, position, nearer, position_ratio),
        make(LimitKind::Velocity, velocity, limit.velocity, velocity.abs() / limit.velocity),
        make(LimitKind::Acceleration, acceleration, limit.acceleration, acceleration.abs() / limit.acceleration),
    ]
}

fn check_time(points: &[Point]) -> Result<(), TrajectoryError> {
    let mut previous_s = f64::NEG_INFINITY;
    for (index, point) in points.iter().enumerate() {
        if !point.time_s.is_finite() || point.time_s <= previous_s {
            return Err(TrajectoryError::NonIncreasing { index, time_s: point.time_s, previous_s });
        }
        previous_s = point.time_s;
    }
    Ok(())
}

fn check_ends(limits: &[JointLimits], points: &[Point]) -> Result<(), TrajectoryError> {
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return Err(TrajectoryError::Empty) };
    for point in [first, last] {
        if let Some((limit, &velocity)) = limits.iter().zip(&point.velocities).find(|(_, v)| **v != 0.0) {
            let (joint, time_s) = (limit.name.clone(), point.time_s);
            return Err(TrajectoryError::NotAtRest { joint, time_s, velocity });
        }
    }
    Ok(())
}
