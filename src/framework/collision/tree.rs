//! A tree of poses whose edges are free of contact, for RRT-Connect.

use super::joint_space::JointSpace;

/// Length of an edge, rad.
const STEP: f64 = 0.4;

/// Growth of a tree by one edge; each holds the index of the new node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Growth {
    /// The edge would touch something.
    Trapped,
    /// One step nearer.
    Advanced(usize),
    /// At the pose wanted.
    Reached(usize),
}

#[derive(Debug, Clone)]
pub(super) struct Tree {
    poses: Vec<Vec<f64>>,
    /// Index of the node that each grew from; the root is its own.
    parents: Vec<usize>,
}

impl Tree {
    pub(super) fn new(root: &[f64]) -> Self {
        Self { poses: vec![root.to_vec()], parents: vec![0] }
    }

    pub(super) fn len(&self) -> usize {
        self.poses.len()
    }

    pub(super) fn pose(&self, node: usize) -> &[f64] {
        &self.poses[node]
    }

    /// One step from the nearest node, the first of several, towards `target`.
    pub(super) fn extend(
        &mut self,
        space: &JointSpace,
        target: &[f64],
        is_free: &mut dyn FnMut(&[f64], &[f64]) -> bool,
    ) -> Growth {
        let distances = self.poses.iter().map(|pose| space.distance(pose, target)).enumerate();
        let nearest = distances.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(index, _)| index);
        self.grow(space, nearest, target, is_free)
    }

    /// Steps towards `target` until it is reached; `None` if something is in the way or `most` steps are not enough.
    pub(super) fn connect(
        &mut self,
        space: &JointSpace,
        target: &[f64],
        most: usize,
        is_free: &mut dyn FnMut(&[f64], &[f64]) -> bool,
    ) -> Option<usize> {
        let mut growth = self.extend(space, target, is_free);
        for _ in 0..most {
            growth = match growth {
                Growth::Trapped => return None,
                Growth::Reached(node) => return Some(node),
                Growth::Advanced(node) => self.grow(space, node, target, is_free),
            };
        }
        None
    }

    fn grow(
        &mut self,
        space: &JointSpace,
        from: usize,
        target: &[f64],
        is_free: &mut dyn FnMut(&[f64], &[f64]) -> bool,
    ) -> Growth {
        let (pose, is_there) = space.towards(&self.poses[from], target, STEP);
        if !is_free(&self.poses[from], &pose) {
            return Growth::Trapped;
        }
        self.poses.push(pose);
        self.parents.push(from);
        let node = self.poses.len() - 1;
        if is_there { Growth::Reached(node) } else { Growth::Advanced(node) }
    }

    /// Poses from the root to `node`.
    pub(super) fn path(&self, node: usize) -> Vec<Vec<f64>> {
        let mut nodes = vec![node];
        let mut at = node;
        while self.parents[at] != at {
            at = self.parents[at];
            nodes.push(at);
        }
        nodes.iter().rev().map(|&index| self.poses[index].clone()).collect()
    }
}
