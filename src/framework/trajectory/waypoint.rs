//! A pose that a trajectory passes.

/// A pose on the way.
#[derive(Debug, Clone, PartialEq)]
pub struct Waypoint {
    /// Joint positions in gene order, rad or m.
    pub joints: Vec<f64>,
    /// Index of the goal reached here, from 0; `None` if the pose belongs to no goal.
    pub goal: Option<usize>,
    /// Whether the arm rests here for the dwell. A pose that only leads around an obstacle needs no rest: the arm stops
    /// there for no time, or passes it if it blends.
    pub rest: bool,
}

impl Waypoint {
    /// Rests at the pose of goal `index`.
    #[must_use]
    pub fn goal(index: usize, joints: Vec<f64>) -> Self {
        Self { joints, goal: Some(index), rest: true }
    }

    /// The poses of goals 0, 1, 2, ...
    #[must_use]
    pub fn goals(poses: &[Vec<f64>]) -> Vec<Self> {
        poses.iter().enumerate().map(|(index, pose)| Self::goal(index, pose.clone())).collect()
    }
}
