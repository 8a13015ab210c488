//! A trajectory that has passed all checks.

use super::check::{check_pieces, check_samples};
use super::error::TrajectoryError;
use super::limits::JointLimits;
use super::piece::{Piece, State, at_time};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// One sample of a trajectory.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Time from the start, s.
    pub time_s: f64,
    /// Joint positions in gene order, rad or m.
    pub positions: Vec<f64>,
    /// Joint velocities in gene order, rad/s or m/s.
    pub velocities: Vec<f64>,
    /// Joint accelerations in gene order, rad/s^2 or m/s^2.
    pub accelerations: Vec<f64>,
    /// Index, among the waypoints that ask for rest, of the (last) one reached here, from 0; `None` between them.
    pub waypoint: Option<usize>,
    /// Index of the (last) goal reached here, from 0; `None` between goals.
    pub goal: Option<usize>,
}

impl Point {
    pub(super) fn new(time_s: f64, state: State) -> Self {
        let State { positions, velocities, accelerations } = state;
        Self { time_s, positions, velocities, accelerations, waypoint: None, goal: None }
    }
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

/// A trajectory within all limits. Only [`plan()`](super::plan()) creates one.
#[derive(Debug, Clone, PartialEq)]
pub struct CheckedTrajectory {
    joints: Vec<String>,
    fixed_joints: BTreeMap<String, f64>,
    pieces: Vec<Piece>,
    points: Vec<Point>,
    waypoint_times_s: Vec<f64>,
    goals: Vec<Option<usize>>,
    tightest: Vec<Tightest>,
    notes: Vec<String>,
}

/// A planned motion before it is checked.
pub(super) struct Planned {
    pub fixed_joints: BTreeMap<String, f64>,
    pub pieces: Vec<Piece>,
    pub points: Vec<Point>,
    pub waypoint_times_s: Vec<f64>,
    pub goals: Vec<Option<usize>>,
    pub notes: Vec<String>,
}

impl CheckedTrajectory {
    pub(super) fn new(limits: &[JointLimits], planned: Planned) -> Result<Self, TrajectoryError> {
        let Planned { fixed_joints, pieces, points, waypoint_times_s, goals, notes } = planned;
        check_samples(limits, &points)?;
        let tightest = check_pieces(limits, &pieces)?;
        let joints = limits.iter().map(|l| l.name.clone()).collect();
        Ok(Self { joints, fixed_joints, pieces, points, waypoint_times_s, goals, tightest, notes })
    }

    /// Joint names, in the order of each point's values.
    #[must_use]
    pub fn joints(&self) -> &[String] {
        &self.joints
    }

    /// Joints of the chain held at a constant value throughout, rad or m.
    #[must_use]
    pub fn fixed_joints(&self) -> &BTreeMap<String, f64> {
        &self.fixed_joints
    }

    /// The motion itself: consecutive polynomials, at least one.
    #[must_use]
    pub fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// The samples; time increases from 0.
    #[must_use]
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// Joint positions on the curve at a time from the start in s, rad or m; before the start the first, after the end
    /// the last.
    #[must_use]
    pub fn positions_at(&self, time_s: f64) -> Vec<f64> {
        at_time(&self.pieces, time_s).state(time_s).positions
    }

    /// Time at which each waypoint is reached, s, in the order given.
    #[must_use]
    pub fn waypoint_times_s(&self) -> &[f64] {
        &self.waypoint_times_s
    }

    /// Time at which each waypoint of a goal is reached, s, in order.
    #[must_use]
    pub fn goal_times_s(&self) -> Vec<f64> {
        let marked = self.waypoint_times_s.iter().zip(&self.goals);
        marked.filter_map(|(time_s, goal)| goal.map(|_| *time_s)).collect()
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
