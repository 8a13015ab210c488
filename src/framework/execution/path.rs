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
pub(super) struct Executed<'a> {
    pub joints: &'a [f64],
    pub observation: Option<&'a [f64]>,
}

/// The path of a run in which pose `order[g]` of `executed` serves goal g; poses that serve no goal are part of it if
/// their effect stays (`stays`).
pub(super) fn path<'a>(executed: impl Fn(usize) -> Executed<'a>, order: &[usize], stays: &[usize]) -> Vec<PathPose> {
    let pose = |index: usize, goals: Vec<usize>| {
        let Executed { joints, observation } = executed(index);
        PathPose { joints: joints.to_vec(), goals, observation: observation.map(<[f64]>::to_vec) }
    };
    if stays.is_empty() {
        return order.iter().enumerate().map(|(goal, &index)| pose(index, vec![goal])).collect();
    }
    let mut indices: Vec<usize> = order.iter().chain(stays).copied().collect();
    indices.sort_unstable();
    indices.dedup();
    let served = |index: usize| (0..order.len()).filter(|&goal| order[goal] == index).collect();
    indices.into_iter().map(|index| pose(index, served(index))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const POSES: [[f64; 1]; 4] = [[0.0], [1.0], [2.0], [3.0]];

    fn served(order: &[usize], stays: &[usize]) -> Vec<(f64, Vec<usize>)> {
        let executed = |index: usize| Executed { joints: &POSES[index], observation: None };
        path(executed, order, stays).into_iter().map(|pose| (pose.joints[0], pose.goals)).collect()
    }

    #[test]
    fn every_pose_whose_effect_stays_is_part_of_the_path() {
        assert_eq!(served(&[0, 3], &[1, 2, 3]), [(0.0, vec![0]), (1.0, vec![]), (2.0, vec![]), (3.0, vec![1])]);
    }

    #[test]
    fn a_pose_may_serve_several_goals() {
        assert_eq!(served(&[1, 1, 2], &[1, 2]), [(1.0, vec![0, 1]), (2.0, vec![2])]);
    }

    #[test]
    fn without_effects_that_stay_the_path_follows_the_goals() {
        assert_eq!(served(&[2, 0, 2], &[]), [(2.0, vec![0]), (0.0, vec![1]), (2.0, vec![2])]);
    }
}
