//! The largest step of a motion.

use crate::execution::PathPose;
use crate::robot::Chain;
use serde::{Deserialize, Serialize};
use std::iter;

/// Move of one joint from one pose to the next.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct JointStep {
    /// Name of the joint.
    pub joint: String,
    /// Index of the goal it leads to, or of the last goal if none follows, from 0; goal 0 is reached from the home pose.
    pub goal_index: u32,
    /// Absolute change of position, rad or m, depending on the joint's kind.
    pub size: f64,
}

/// Largest move of one joint of `chain` between successive poses of a motion along `path`, the first from its home pose;
/// of equal ones the first. 1 rad counts as much as 1 m. `None` if there are no poses.
pub(super) fn largest_step(chain: &Chain, path: &[PathPose], poses: &[Vec<f64>]) -> Option<JointStep> {
    let from = iter::once(chain.home()).chain(poses.iter().map(Vec::as_slice));
    let steps = from.zip(poses).enumerate().flat_map(|(pose, (from, to))| {
        let sizes = from.iter().zip(to).map(|(from, to)| (to - from).abs());
        sizes.zip(chain.genes()).map(move |(size, gene)| (size, &gene.name, pose))
    });
    let (size, joint, pose) = steps.reduce(|largest, step| if step.0 > largest.0 { step } else { largest })?;
    let served = || path.iter().flat_map(|pose| &pose.goals);
    let next = path[pose..].iter().flat_map(|pose| &pose.goals).next().or_else(|| served().last());
    let goal_index = next.map_or(0, |&goal| u32::try_from(goal).unwrap_or(u32::MAX));
    Some(JointStep { joint: joint.clone(), goal_index, size })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::preset::shipped;
    use crate::robot::RobotModel;

    #[test]
    fn the_largest_step_begins_at_home_and_names_its_joint() {
        let problem = shipped("paper-wax").unwrap().problem;
        let chain = Chain::new(&RobotModel::from_urdf(&problem.urdf).unwrap(), &problem.robot).unwrap();
        let moved = |joints: [f64; 3]| joints.iter().zip(chain.home()).map(|(q, home)| home + q).collect::<Vec<f64>>();
        let path = [vec![0], vec![], vec![1]].map(|goals| PathPose { joints: vec![0.0; 3], goals, observation: None });
        let mut poses = [[0.3, 0.0, 0.0], [0.3, -0.4, 0.4], [0.3, -0.4, 0.0]].map(moved);
        let step = largest_step(&chain, &path, &poses).unwrap();
        assert_eq!((step.joint.as_str(), step.goal_index), (chain.genes()[1].name.as_str(), 1));
        assert!((step.size - 0.4).abs() < 1e-12, "{step:?}");
        poses[0] = moved([0.3, 0.0, -0.7]);
        let first = largest_step(&chain, &path, &poses).unwrap();
        assert_eq!((first.joint.as_str(), first.goal_index), (chain.genes()[2].name.as_str(), 1));
        let first = largest_step(&chain, &path, &poses[..1]).unwrap();
        assert_eq!((first.joint.as_str(), first.goal_index), (chain.genes()[2].name.as_str(), 0));
        assert_eq!(largest_step(&chain, &[], &[]), None);
    }
}
