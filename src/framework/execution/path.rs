//! The path of a run: the poses that leave its effect, in the order in which they are executed.
//!
//! # Invariants
//! - Each goal is served by exactly one pose, and goals are served in order.
//! - On a surface every trial whose effect stays is in the path, whether or not it serves a goal: without it, the path
//!   would cover less than the run claims.

use serde::{Deserialize, Serialize};

/// One pose of a path.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PathPose {
    /// Free joints in gene order, rad or m.
    pub joints: Vec<f64>,
    /// Indices of the goals it serves, from 0; empty for a trial that left an effect but serves no goal.
    pub goals: Vec<usize>,
    /// Observed features, in the goals' order; `None` if the pose was never observed.
    pub observation: Option<Vec<f64>>,
}

/// Joints and, if observed, the features of one pose that is executed.
#[derive(Clone, Copy)]
pub(super) struct Executed<'a> {
    pub joints: &'a [f64],
    pub observation: Option<&'a [f64]>,
}

impl Executed<'_> {
    fn serving(self, goals: Vec<usize>) -> PathPose {
        let Self { joints, observation } = self;
        PathPose { joints: joints.to_vec(), goals, observation: observation.map(<[f64]>::to_vec) }
    }
}

/// The path of a run whose effects do not accumulate: the pose of each goal, in order.
pub(super) fn along_goals<'a>(poses: impl Iterator<Item = Executed<'a>>) -> Vec<PathPose> {
    poses.enumerate().map(|(goal, pose)| pose.serving(vec![goal])).collect()
}

/// The path of a run whose effects accumulate: the poses `stays` (ascending indices for `executed`), whose effects stay.
/// Goal g is served by pose `order[g]`, which is one of them, or by the `start`, which is then the first pose.
pub(super) fn along_effects<'a>(
    executed: impl Fn(usize) -> Executed<'a>,
    start: Executed<'_>,
    order: &[Option<usize>],
    stays: &[usize],
) -> Vec<PathPose> {
    let served = |by: Option<usize>| (0..order.len()).filter(|&goal| order[goal] == by).collect::<Vec<usize>>();
    let first = Some(served(None)).filter(|goals| !goals.is_empty()).map(|goals| start.serving(goals));
    first.into_iter().chain(stays.iter().map(|&index| executed(index).serving(served(Some(index))))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const POSES: [[f64; 1]; 4] = [[0.0], [1.0], [2.0], [3.0]];

    fn served(order: &[Option<usize>], stays: &[usize]) -> Vec<(f64, Vec<usize>)> {
        let executed = |index: usize| Executed { joints: &POSES[index], observation: None };
        let start = Executed { joints: &[9.0], observation: Some(&[0.0]) };
        along_effects(executed, start, order, stays).into_iter().map(|pose| (pose.joints[0], pose.goals)).collect()
    }

    #[test]
    fn every_pose_whose_effect_stays_is_part_of_the_path() {
        assert_eq!(served(&[Some(1), Some(3)], &[1, 2, 3]), [(1.0, vec![0]), (2.0, vec![]), (3.0, vec![1])]);
    }

    #[test]
    fn a_pose_may_serve_several_goals_and_the_start_serves_those_that_hold_before() {
        assert_eq!(
            served(&[None, Some(1), Some(1), Some(2)], &[1, 2]),
            [(9.0, vec![0]), (1.0, vec![1, 2]), (2.0, vec![3])]
        );
        assert_eq!(served(&[None, None], &[]), [(9.0, vec![0, 1])]);
    }

    #[test]
    fn without_effects_that_stay_the_path_follows_the_goals() {
        let poses = [2, 0, 2].map(|index: usize| Executed { joints: &POSES[index], observation: None });
        let path: Vec<f64> = along_goals(poses.into_iter()).into_iter().map(|pose| pose.joints[0]).collect();
        assert_eq!(path, [2.0, 0.0, 2.0]);
    }
}
