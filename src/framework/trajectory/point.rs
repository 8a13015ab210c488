//! A sample of a trajectory.

use super::piece::State;

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
