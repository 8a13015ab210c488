//! A trajectory that has passed all checks.

use super::check::{check_pieces, check_samples};
use super::error::TrajectoryError;
use super::limits::JointLimits;
use super::piece::{Piece, at_time};
use super::point::Point;
use super::tightest::Tightest;
use std::collections::BTreeMap;

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

    /// The same trajectory with further notes.
    #[must_use]
    pub(crate) fn noting(mut self, notes: Vec<String>) -> Self {
        self.notes.extend(notes);
        self
    }

    /// Assumptions made in planning.
    #[must_use]
    pub fn notes(&self) -> &[String] {
        &self.notes
    }
}
