//! The trajectory that was checked, and how near it comes to each limit.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// One sample of a trajectory.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Point {
    /// Time from the start, s.
    pub time_s: f64,
    /// Joint positions in gene order, rad or m.
    pub positions: Vec<f64>,
    /// rad/s or m/s.
    pub velocities: Vec<f64>,
    /// rad/s^2 or m/s^2.
    pub accelerations: Vec<f64>,
    /// Index of the waypoint reached here, from 0; none on the way.
    pub waypoint: Option<usize>,
}

/// A kind of limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum LimitKind {
    /// Position within lower and upper.
    Position,
    /// Speed.
    Velocity,
    /// Acceleration.
    Acceleration,
}

/// Where a limit is used most.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Tightest {
    /// The limit.
    pub kind: LimitKind,
    /// Joint name.
    pub joint: String,
    /// Time, s.
    pub time_s: f64,
    /// The value there.
    pub value: f64,
    /// The limit there (for positions the nearer one).
    pub limit: f64,
    /// Share of the limit used: 1 is at the limit. For positions, distance from the middle over half the range.
    pub ratio: f64,
}

/// Limits of one joint as planned with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub(crate) struct JointLimits {
    pub name: String,
    pub lower: f64,
    pub upper: f64,
    pub velocity: f64,
    pub acceleration: f64,
}

/// Why waypoints do not make a trajectory.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TrajectoryError {
    /// No waypoint.
    #[error("a trajectory needs at least 1 waypoint")]
    Empty,
    /// A waypoint of another length.
    #[error("waypoint {waypoint} has {found} values for {expected} joints")]
    Ragged {
        /// Waypoint index from 0; none is the start pose.
        waypoint: String,
        /// Values found.
        found: usize,
        /// Values expected.
        expected: usize,
    },
    /// NaN or infinity.
    #[error("joint {joint:?} is {value} at {time_s} s, not a finite number")]
    NonFinite {
        /// The joint.
        joint: String,
        /// Time, s.
        time_s: f64,
        /// The value.
        value: f64,
    },
    /// A limit that is passed.
    #[error(
        "{kind} of joint {joint:?} is {value} at {time_s} s, its limit is {limit}: choose other limits or keep the search within them"
    )]
    Limit {
        /// `position`, `velocity` or `acceleration`.
        kind: &'static str,
        /// The joint.
        joint: String,
        /// Time, s.
        time_s: f64,
        /// The value.
        value: f64,
        /// The limit.
        limit: f64,
    },
    /// Time that does not increase.
    #[error("sample {index} at {time_s} s does not follow {previous_s} s")]
    NonIncreasing {
        /// Sample index from 0.
        index: usize,
        /// Its time.
        time_s: f64,
        /// The time before.
        previous_s: f64,
    },
    /// Moving at an end.
    #[error("joint {joint:?} moves at {velocity} at {time_s} s: a trajectory starts and ends at rest")]
    NotAtRest {
        /// The joint.
        joint: String,
        /// Time, s.
        time_s: f64,
        /// Its velocity.
        velocity: f64,
    },
    /// A planning parameter out of its range.
    #[error("{field} is {value}: {expected}")]
    Value {
        /// The field.
        field: &'static str,
        /// The value given.
        value: f64,
        /// What is expected.
        expected: &'static str,
    },
}

/// A trajectory that keeps all limits. Only [`plan()`](super::plan()) makes one.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct CheckedTrajectory {
    joints: Vec<String>,
    fixed_joints: std::collections::BTreeMap<String, f64>,
    points: Vec<Point>,
    tightest: Vec<Tightest>,
    notes: Vec<String>,
}

/// Share by which a computed value may pass its limit: rounding.
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

    /// Joints of the chain that hold one value throughout, rad or m.
    #[must_use]
    pub fn fixed_joints(&self) -> &std::collections::BTreeMap<String, f64> {
        &self.fixed_joints
    }

    /// The samples, time increasing from 0.
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

    /// What was assumed in planning.
    #[must_use]
    pub fn notes(&self) -> &[String] {
        &self.notes
    }
}

fn usage(limit: &JointLimits, point: &Point, index: usize) -> [Tightest; 3] {
    let position = point.positions[index];
    let (middle, half) = (f64::midpoint(limit.lower, limit.upper), (limit.upper - limit.lower) / 2.0);
    let away = (position - middle).abs();
    // a joint without range is at its limit when it stands there
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
