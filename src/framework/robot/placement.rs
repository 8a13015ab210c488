//! Places of all of a robot's links in the frames that a chain moves, and a bound of how far a motion carries them.
//!
//! Links outside of the chain move with the link that carries them; their own joints rest at the chain's home position,
//! or else at 0 clamped to the joint's limits.

use super::chain::{Chain, motion};
use super::model::{JointKind, RobotModel};
use nalgebra::Isometry3;

/// A constant pose in one of a chain's moving frames.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// Frame F: 0 is the chain's base, k the frame that its joint k moves (as of
    /// [`moving_frames`](super::moving_frames)).
    pub frame: usize,
    /// Pose in F.
    pub x_f: Isometry3<f64>,
}

impl Chain {
    /// Number of frames: the base and one per moving joint.
    #[must_use]
    pub fn frames(&self) -> usize {
        self.steps.len() + 1
    }

    /// Place of the tool centre point.
    #[must_use]
    pub fn tool_placement(&self) -> Placement {
        Placement { frame: self.steps.len(), x_f: self.tool }
    }

    /// Place of every link of `model`, in the order of [`RobotModel::links`].
    ///
    /// Links of a model other than the chain's own are placed as far as their names agree.
    #[must_use]
    pub fn placements(&self, model: &RobotModel) -> Vec<Placement> {
        let base = model.link_index(self.base_link()).unwrap_or(model.root());
        let tip = model.link_index(self.tip_link()).unwrap_or(base);
        let path = model.path(base, tip).unwrap_or_default();
        let at_base = Placement { frame: 0, x_f: Isometry3::identity() };
        let mut placed: Vec<Option<Placement>> = vec![None; model.links().len()];
        placed[base] = Some(at_base);
        let mut open = vec![base];
        while let Some(link) = open.pop() {
            let from = placed[link].unwrap_or(at_base);
            for (index, joint) in model.joints().iter().enumerate() {
                let (next, place) = if joint.parent == link {
                    (joint.child, self.below(model, path.contains(&index), index, from))
                } else if joint.child == link {
                    let back = (joint.x_pc * self.at_rest(model, index)).inverse();
                    (joint.parent, Placement { frame: from.frame, x_f: from.x_f * back })
                } else {
                    continue;
                };
                if placed[next].is_none() {
                    placed[next] = Some(place);
                    open.push(next);
                }
            }
        }
        placed.into_iter().map(|place| place.unwrap_or(at_base)).collect()
    }

    /// Place of the child of `joint`, whose parent is at `from`.
    fn below(&self, model: &RobotModel, is_on_path: bool, joint: usize, from: Placement) -> Placement {
        let leader = model.joints()[joint].mimic.map_or(joint, |mimic| mimic.source);
        let is_free = self.genes().iter().any(|gene| gene.name == model.joints()[leader].name);
        if is_on_path && is_free {
            return Placement { frame: from.frame + 1, x_f: Isometry3::identity() };
        }
        Placement { frame: from.frame, x_f: from.x_f * model.joints()[joint].x_pc * self.at_rest(model, joint) }
    }

    /// Motion of a joint at the value where it rests.
    fn at_rest(&self, model: &RobotModel, index: usize) -> Isometry3<f64> {
        let joint = &model.joints()[index];
        if !joint.kind.is_movable() {
            return Isometry3::identity();
        }
        if let Some((_, value)) = self.fixed_joints().iter().find(|(name, _)| *name == joint.name) {
            return motion(joint.kind, &joint.axis, *value);
        }
        let (leader, multiplier, offset) =
            joint.mimic.map_or((index, 1.0, 0.0), |m| (m.source, m.multiplier, m.offset));
        let leader = &model.joints()[leader];
        let home = self.genes().iter().zip(self.home()).find(|(gene, _)| gene.name == leader.name).map(|(_, q)| *q);
        let held = self.fixed_joints().iter().find(|(name, _)| *name == leader.name).map(|(_, q)| *q);
        let limits = leader.limits.filter(|[lower, upper]| leader.kind != JointKind::Continuous && lower <= upper);
        let zero = limits.map_or(0.0, |[lower, upper]| 0.0_f64.clamp(lower, upper));
        motion(joint.kind, &joint.axis, multiplier * home.or(held).unwrap_or(zero) + offset)
    }
}

/// Upper bound, m, of the path of any point of a body during the straight joint motion from `from` to `to`, seen from
/// frame `lower`. The body is fixed to frame `upper`, and no point of it is farther than `radius_m` from that frame's
/// origin.
///
/// Let joints lower+1 to upper turn or shift by `d_i`, be `t_i` the constant translation in front of joint i, and `s_i`
/// the largest shift of joint i if it is prismatic, or else 0. No point of the body is farther from the origin of joint
/// i than
///
/// `r_i = radius + s_i + sum over j = i+1 ..= upper of (|t_j| + s_j)`,
///
/// so the path is not longer than the sum of `|d_i|` over prismatic joints and of `|d_i| r_i` over the others. The bound
/// holds for every part of the motion in proportion, because all joints move at constant speed.
///
/// # Panics
/// If a pose is shorter than the chain, or `upper` is not below [`Chain::frames`].
#[must_use]
pub fn travel_bound(chain: &Chain, from: &[f64], to: &[f64], [lower, upper]: [usize; 2], radius_m: f64) -> f64 {
    let (mut reach, mut travel) = (radius_m, 0.0);
    for step in chain.steps[lower..upper].iter().rev() {
        let by = (step.multiplier * (to[step.gene] - from[step.gene])).abs();
        if step.prismatic {
            let shift = |joints: &[f64]| (step.multiplier * joints[step.gene] + step.offset).abs();
            travel += by;
            reach += shift(from).max(shift(to));
        } else {
            travel += by * reach;
        }
        reach += step.translation.norm();
    }
    travel
}
