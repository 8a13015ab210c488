//! Detours: a sequence of straight joint motions from one pose to another without a contact.
//!
//! The straight motion is tried first, then one via point, then RRT-Connect (Kuffner and LaValle 2000,
//! doi:10.1109/ROBOT.2000.844730) with shortcuts. All are bounded, and a seed gives the same route bit for bit.

use super::joint_space::JointSpace;
use super::model::{CollisionModel, Workspace};
use super::tree::{Growth, Tree};
use crate::random::RandomStream;

/// Largest numbers of attempts of a search for a detour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RouteBudget {
    /// Via points that are tried.
    pub via_points: u32,
    /// Random poses towards which the two trees grow.
    pub samples: u32,
    /// Nodes of the two trees together.
    pub nodes: usize,
    /// Shortcuts that are tried on what the trees found.
    pub shortcuts: u32,
}

impl Default for RouteBudget {
    fn default() -> Self {
        Self { via_points: 48, samples: 1000, nodes: 2000, shortcuts: 60 }
    }
}

/// Via points from `from` to `to` (n values in gene order, rad or m), each straight part of the way free of contact;
/// empty if the straight motion is. `None` if an end is in collision or no route was found within `budget`.
///
/// # Panics
/// If a pose is shorter than the chain or not finite.
#[must_use]
pub fn route(
    model: &CollisionModel,
    from: &[f64],
    to: &[f64],
    seed: u64,
    budget: &RouteBudget,
) -> Option<Vec<Vec<f64>>> {
    let mut workspace = model.workspace();
    if [from, to].into_iter().any(|end| model.collides(end, &mut workspace)) {
        return None;
    }
    if model.check_motion(from, to, &mut workspace).is_none() {
        return Some(Vec::new());
    }
    let mut search = Search {
        model,
        space: JointSpace::of(model.chain()),
        random: RandomStream::new(seed, 0),
        workspace,
        ends: [from, to],
    };
    search.via_point(budget.via_points).map(|via| vec![via]).or_else(|| search.tree_route(budget))
}

struct Search<'a> {
    model: &'a CollisionModel,
    space: JointSpace,
    random: RandomStream,
    workspace: Workspace,
    ends: [&'a [f64]; 2],
}

impl Search<'_> {
    fn is_free(&mut self, from: &[f64], to: &[f64]) -> bool {
        self.model.check_motion(from, to, &mut self.workspace).is_none()
    }

    /// The via point with the shortest way among `count` around the middle of the straight motion, ever farther from it.
    fn via_point(&mut self, count: u32) -> Option<Vec<f64>> {
        let [from, to] = self.ends;
        let middle: Vec<f64> = from.iter().zip(to).map(|(a, b)| f64::midpoint(*a, *b)).collect();
        let mut best: Option<(f64, Vec<f64>)> = None;
        for attempt in 1..=count {
            let spread = f64::from(attempt) / f64::from(count);
            let via = self.space.around(&middle, spread, &mut self.random);
            let length = self.space.distance(from, &via) + self.space.distance(&via, to);
            if best.as_ref().is_some_and(|(least, _)| length >= *least) {
                continue;
            }
            if self.is_free(from, &via) && self.is_free(&via, to) {
                best = Some((length, via));
            }
        }
        best.map(|(_, via)| via)
    }

    fn tree_route(&mut self, budget: &RouteBudget) -> Option<Vec<Vec<f64>>> {
        let mut trees = self.ends.map(Tree::new);
        for sample in 0..budget.samples {
            if trees[0].len() + trees[1].len() >= budget.nodes {
                return None;
            }
            let [growing, other] = &mut trees;
            let target = self.space.uniform(&mut self.random);
            let (model, space, workspace) = (self.model, &self.space, &mut self.workspace);
            let mut free = |a: &[f64], b: &[f64]| model.check_motion(a, b, workspace).is_none();
            if let Growth::Advanced(node) | Growth::Reached(node) = growing.extend(space, &target, &mut free) {
                let pose = growing.pose(node).to_vec();
                let left = budget.nodes.saturating_sub(growing.len() + other.len());
                if let Some(met) = other.connect(space, &pose, left, &mut free) {
                    let mut path = growing.path(node);
                    path.extend(other.path(met).into_iter().rev().skip(1));
                    if sample % 2 == 1 {
                        path.reverse();
                    }
                    return Some(self.shortened(path, budget.shortcuts));
                }
            }
            trees.swap(0, 1);
        }
        None
    }

    /// The inner poses of `path` after nodes that are not needed have been left out.
    fn shortened(&mut self, mut path: Vec<Vec<f64>>, attempts: u32) -> Vec<Vec<f64>> {
        for _ in 0..attempts {
            if path.len() < 3 {
                break;
            }
            let first = self.random.below(path.len() - 2);
            let last = first + 2 + self.random.below(path.len() - first - 2);
            let (a, b) = (path[first].clone(), path[last].clone());
            if self.is_free(&a, &b) {
                path.drain(first + 1..last);
            }
        }
        path.pop();
        path.into_iter().skip(1).collect()
    }
}
