//! Pairs that can collide: neither at rest to each other nor next to each other in the robot's tree, nor excluded by the
//! user.

use super::error::CollisionError;
use super::solid::Solid;
use crate::robot::{Chain, RobotModel};
use serde::Serialize;
use std::collections::BTreeSet;

/// Name of the capsule from the tip link's origin to the tool centre point.
pub const TOOL: &str = "tool centre point";

/// Reason why a pair that moves is not checked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Exclusion {
    /// A joint connects the two links, directly or through links without a shape.
    Adjacent,
    /// The options exclude the pair.
    Given,
    /// The two links are in contact at the home pose.
    ContactAtHome,
}

/// A pair that is not checked.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ExcludedPair {
    /// Names of links or obstacles.
    pub names: [String; 2],
    /// Reason why it is not checked.
    pub reason: Exclusion,
}

/// Two solids of which the first is not after the second in the chain; indices.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Pair {
    pub first: usize,
    pub second: usize,
}

/// Pairs of owners, smaller index first.
pub(super) type Owners = BTreeSet<[usize; 2]>;

pub(super) fn ordered(a: usize, b: usize) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

/// Pairs of solids in different frames whose owners are not in any of `left_out`, in the order of the solids.
pub(super) fn moving(solids: &[Solid], left_out: &[&Owners]) -> Vec<Pair> {
    let mut pairs = Vec::new();
    for (i, a) in solids.iter().enumerate() {
        for (j, b) in solids.iter().enumerate().skip(i + 1) {
            let owners = ordered(a.owner, b.owner);
            if a.frame == b.frame || left_out.iter().any(|set| set.contains(&owners)) {
                continue;
            }
            pairs.push(if a.frame <= b.frame { Pair { first: i, second: j } } else { Pair { first: j, second: i } });
        }
    }
    pairs
}

/// Pairs of links with a shape that are connected by joints through links without one. The tool has the neighbours of
/// the tip link.
pub(super) fn adjacent(model: &RobotModel, chain: &Chain, solids: &[Solid]) -> Owners {
    let has_shape: BTreeSet<usize> = solids.iter().map(|solid| solid.owner).collect();
    let tool = model.links().len();
    let mut pairs = Owners::new();
    for link in 0..model.links().len() {
        let is_tip = model.links()[link] == chain.tip_link();
        let mut seen = BTreeSet::from([link]);
        let mut open = vec![link];
        while let Some(at) = open.pop() {
            for joint in model.joints() {
                let next = match at {
                    _ if at == joint.parent => joint.child,
                    _ if at == joint.child => joint.parent,
                    _ => continue,
                };
                if !seen.insert(next) {
                    continue;
                }
                if !has_shape.contains(&next) {
                    open.push(next);
                    continue;
                }
                pairs.insert(ordered(link, next));
                if is_tip {
                    pairs.insert(ordered(tool, next));
                }
            }
        }
    }
    pairs
}

/// Pairs that the user excludes.
///
/// # Errors
/// [`CollisionError::UnknownName`] for a name that is not one of `names`.
pub(super) fn given(excluded: &[[String; 2]], names: &[String]) -> Result<Owners, CollisionError> {
    let index = |name: &String| {
        let found = names.iter().position(|known| known == name);
        found.ok_or_else(|| CollisionError::UnknownName { name: name.clone(), known: names.to_vec() })
    };
    excluded.iter().map(|[a, b]| Ok(ordered(index(a)?, index(b)?))).collect()
}
