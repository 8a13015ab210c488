//! The chain a job moves, from base link to tool: free joints are genes, everything that cannot move is folded into
//! constant transforms.
//!
//! Invariants: each gene has finite limits `lower <= upper`; `steps` are ordered from base to tip, and each refers to a
//! gene.

use super::check::MAX_VALUE;
use super::error::ChainError;
use super::model::{JointKind, RobotModel};
use super::spec::RobotSpec;
use crate::range::{Range, above};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

/// One free joint, which the optimiser moves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Gene {
    /// Name of the joint.
    pub name: String,
    /// Revolute, continuous or prismatic.
    pub kind: JointKind,
    /// Lower position limit, rad or m; by default -pi for continuous joints.
    pub lower: f64,
    /// Upper position limit, rad or m; by default pi for continuous joints.
    pub upper: f64,
    /// Velocity limit, rad/s or m/s; `None` if the URDF has none.
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub velocity: Option<f64>,
    /// Acceleration limit, rad/s^2 or m/s^2; `None` if the robot's description has none.
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub acceleration: Option<f64>,
    /// Jerk limit, rad/s^3 or m/s^3; `None` if the robot's description has none.
    #[serde(default)]
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub jerk: Option<f64>,
}

/// Turns beyond its range, on either side, that a motion may take a joint that turns without end.
const SPARE_TURNS: f64 = 2.0;

impl Gene {
    /// Range within which a motion may hold the joint, rad or m: its limits. A continuous joint whose range is a whole turn
    /// turns without end: its range only bounds the search, and a motion may go two turns beyond it.
    #[must_use]
    pub fn motion_range(&self) -> [f64; 2] {
        let is_endless = self.kind == JointKind::Continuous && self.upper - self.lower >= TAU;
        let spare = if is_endless { SPARE_TURNS * TAU } else { 0.0 };
        [self.lower - spare, self.upper + spare]
    }
}

/// One moving joint between base and tip.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Step {
    /// Constant rotation from the previous moving frame to this joint's frame.
    pub rotation: nalgebra::Matrix3<f64>,
    /// Constant translation from the previous moving frame to this joint's frame, m.
    pub translation: Vector3<f64>,
    /// Whether `rotation` is exactly the identity.
    pub unrotated: bool,
    pub axis: Vector3<f64>,
    pub prismatic: bool,
    pub gene: usize,
    /// q_joint = multiplier * q_gene + offset (1 and 0 unless the joint mimics).
    pub multiplier: f64,
    pub offset: f64,
}

/// A robot's chain, ready for kinematics.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    base_link: String,
    tip_link: String,
    genes: Vec<Gene>,
    pub(super) steps: Vec<Step>,
    /// Pose X of the tool in the last moving frame.
    pub(super) tool: Isometry3<f64>,
    followers: Vec<(String, usize, f64, f64)>,
    fixed: Vec<(String, f64)>,
    home: Vec<f64>,
}

impl Chain {
    /// Builds the chain that `spec` selects from `model`.
    ///
    /// # Errors
    /// [`ChainError`] with the joint or link, the value and a remedy.
    pub fn new(model: &RobotModel, spec: &RobotSpec) -> Result<Self, ChainError> {
        let (base, tip) = ends(model, spec)?;
        let path = path(model, base, tip)?;
        let leader = |joint: usize| model.joints()[joint].mimic.map_or(joint, |m| m.source);
        let mut movable: Vec<usize> = Vec::new();
        for &joint in &path {
            if model.joints()[joint].kind.is_movable() && !movable.contains(&leader(joint)) {
                movable.push(leader(joint));
            }
        }
        check_names(model, spec, &movable)?;
        let free = free_joints(model, spec, &movable)?;
        if free.is_empty() {
            return Err(ChainError::NoFreeJoint { base: model.links()[base].clone(), tip: model.links()[tip].clone() });
        }
        let genes: Vec<Gene> =
            free.iter().map(|&joint| gene(model, spec, &path, joint)).collect::<Result<_, ChainError>>()?;
        let mut held: BTreeMap<usize, f64> = BTreeMap::new();
        for &joint in movable.iter().filter(|j| !free.contains(j)) {
            held.insert(joint, held_value(model, spec, joint)?);
        }
        Range::from(-MAX_VALUE..=MAX_VALUE).check_each("tool_offset_m", Some("m"), &spec.tool_offset_m)?;
        let home = home(spec, &genes)?;
        let mut chain = Self {
            base_link: model.links()[base].clone(),
            tip_link: model.links()[tip].clone(),
            genes,
            steps: Vec::new(),
            tool: Isometry3::identity(),
            followers: Vec::new(),
            fixed: Vec::new(),
            home,
        };
        chain.fold(model, &path, &free, &held);
        chain.tool *= Translation3::from(spec.tool_offset_m);
        Ok(chain)
    }

    /// Walks from base to tip and multiplies constant transforms together.
    fn fold(&mut self, model: &RobotModel, path: &[usize], free: &[usize], held: &BTreeMap<usize, f64>) {
        let mut constant = Isometry3::identity();
        for &index in path {
            let joint = &model.joints()[index];
            constant *= joint.x_pc;
            if !joint.kind.is_movable() {
                continue;
            }
            let (source, multiplier, offset) =
                joint.mimic.map_or((index, 1.0, 0.0), |m| (m.source, m.multiplier, m.offset));
            if let Some(gene) = free.iter().position(|&f| f == source) {
                let rotation = constant.rotation.to_rotation_matrix().into_inner();
                self.steps.push(Step {
                    rotation,
                    translation: constant.translation.vector,
                    unrotated: rotation == nalgebra::Matrix3::identity(),
                    axis: joint.axis.into_inner(),
                    prismatic: joint.kind == JointKind::Prismatic,
                    gene,
                    multiplier,
                    offset,
                });
                if index != source {
                    self.followers.push((joint.name.clone(), gene, multiplier, offset));
                }
                constant = Isometry3::identity();
            } else {
                let value = multiplier * held.get(&source).copied().unwrap_or(0.0) + offset;
                constant *= motion(joint.kind, &joint.axis, value);
                self.fixed.push((joint.name.clone(), value));
            }
        }
        self.tool = constant;
    }

    /// Name of the base link; positions are expressed in its frame.
    #[must_use]
    pub fn base_link(&self) -> &str {
        &self.base_link
    }

    /// Name of the tip link.
    #[must_use]
    pub fn tip_link(&self) -> &str {
        &self.tip_link
    }

    /// The n free joints, in gene order.
    #[must_use]
    pub fn genes(&self) -> &[Gene] {
        &self.genes
    }

    /// Number of free joints n (at least 1).
    #[must_use]
    pub fn len(&self) -> usize {
        self.genes.len()
    }

    /// Never true: a chain has at least one free joint.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.genes.is_empty()
    }

    /// Joints of the chain held at a constant value (rad or m), base first.
    #[must_use]
    pub fn fixed_joints(&self) -> &[(String, f64)] {
        &self.fixed
    }

    /// Positions of every movable joint of the chain at `joints` (free, mimicking and held ones), for viewers.
    #[must_use]
    pub fn all_positions(&self, joints: &[f64]) -> BTreeMap<String, f64> {
        let free = self.genes.iter().zip(joints).map(|(g, &q)| (g.name.clone(), q));
        let follow = self.followers.iter().map(|(name, gene, m, o)| (name.clone(), m * joints[*gene] + o));
        free.chain(follow).chain(self.fixed.iter().cloned()).collect()
    }

    /// Whether the tool is where it was after a whole turn of free joint `gene`.
    #[must_use]
    pub fn repeats(&self, gene: usize) -> bool {
        let driven = self.steps.iter().filter(|step| step.gene == gene);
        driven.clone().count() > 0 && driven.clone().all(|step| !step.prismatic && step.multiplier.fract() == 0.0)
    }

    /// Home pose (n values, rad or m): as described, or else 0 clamped to the limits.
    #[must_use]
    pub fn home(&self) -> &[f64] {
        &self.home
    }
}

pub(super) fn motion(kind: JointKind, axis: &nalgebra::Unit<Vector3<f64>>, value: f64) -> Isometry3<f64> {
    if kind == JointKind::Prismatic {
        Isometry3::from_parts(Translation3::from(axis.into_inner() * value), UnitQuaternion::identity())
    } else {
        Isometry3::from_parts(Translation3::identity(), UnitQuaternion::from_axis_angle(axis, value))
    }
}

fn ends(model: &RobotModel, spec: &RobotSpec) -> Result<(usize, usize), ChainError> {
    let find = |role, name: &str| {
        model.link_index(name).ok_or_else(|| ChainError::UnknownLink {
            role,
            link: name.to_owned(),
            robot: model.name().to_owned(),
            links: model.links().to_vec(),
        })
    };
    let base = spec.base_link.as_deref().map_or(Ok(model.root()), |name| find("base_link", name))?;
    let tip = if let Some(name) = &spec.tip_link {
        find("tip_link", name)?
    } else {
        let leaves = model.leaves();
        if leaves.len() != 1 {
            let leaves = leaves.into_iter().map(|l| model.links()[l].clone()).collect();
            return Err(ChainError::AmbiguousTip { robot: model.name().to_owned(), leaves });
        }
        leaves[0]
    };
    Ok((base, tip))
}

fn path(model: &RobotModel, base: usize, tip: usize) -> Result<Vec<usize>, ChainError> {
    let Some(path) = model.path(base, tip) else {
        let above = model.path(model.root(), tip).unwrap_or_default();
        return Err(ChainError::NotAncestor {
            base: model.links()[base].clone(),
            tip: model.links()[tip].clone(),
            ancestors: above.iter().map(|&j| model.links()[model.joints()[j].parent].clone()).collect(),
        });
    };
    for &index in &path {
        let joint = &model.joints()[index];
        if !joint.kind.is_movable() && joint.kind != JointKind::Fixed {
            return Err(ChainError::Unsupported {
                joint: joint.name.clone(),
                kind: joint.kind.name(),
                below: model.links()[joint.child].clone(),
            });
        }
    }
    Ok(path)
}

fn check_names(model: &RobotModel, spec: &RobotSpec, movable: &[usize]) -> Result<(), ChainError> {
    let names = || movable.iter().map(|&j| model.joints()[j].name.clone());
    let listed = spec.free_joints.iter().flatten().map(|n| ("free_joints", n));
    let fixed = spec.fixed.keys().map(|n| ("fixed", n));
    let limits = spec.limits.keys().map(|n| ("limits", n));
    let acceleration = spec.acceleration.keys().map(|n| ("acceleration", n));
    let jerk = spec.jerk.keys().map(|n| ("jerk", n));
    for (role, name) in listed.chain(fixed).chain(limits).chain(acceleration).chain(jerk) {
        if !names().any(|n| n == *name) {
            return Err(ChainError::UnknownJoint { role, joint: name.clone(), movable: names().collect() });
        }
    }
    Ok(())
}

fn free_joints(model: &RobotModel, spec: &RobotSpec, movable: &[usize]) -> Result<Vec<usize>, ChainError> {
    let Some(names) = &spec.free_joints else {
        let is_free = |j: &&usize| !spec.fixed.contains_key(&model.joints()[**j].name);
        return Ok(movable.iter().filter(is_free).copied().collect());
    };
    let mut free = Vec::with_capacity(names.len());
    for name in names {
        let joint = movable.iter().copied().find(|&j| model.joints()[j].name == *name);
        let Some(joint) = joint.filter(|j| !free.contains(j) && !spec.fixed.contains_key(name)) else {
            return Err(ChainError::NamedTwice { joint: name.clone() });
        };
        free.push(joint);
    }
    Ok(free)
}

/// Position limits of `joint`: from the description, or else the URDF; one turn for continuous joints.
fn position_limits(model: &RobotModel, spec: &RobotSpec, joint: usize) -> Result<Option<[f64; 2]>, ChainError> {
    let joint = &model.joints()[joint];
    if let Some(&[lower, upper]) = spec.limits.get(&joint.name) {
        let wrong = |number| ChainError::Joint { joint: joint.name.clone(), number };
        Range::from(-MAX_VALUE..=MAX_VALUE).check_each("limit", Some("rad or m"), &[lower, upper]).map_err(wrong)?;
        if lower > upper {
            return Err(ChainError::LimitOrder { joint: joint.name.clone(), lower, upper });
        }
        return Ok(Some([lower, upper]));
    }
    let turn = (joint.kind == JointKind::Continuous).then_some([-PI, PI]);
    Ok(if joint.kind == JointKind::Continuous { turn } else { joint.limits })
}

fn held_value(model: &RobotModel, spec: &RobotSpec, joint: usize) -> Result<f64, ChainError> {
    let limits = position_limits(model, spec, joint)?;
    let name = &model.joints()[joint].name;
    let Some(&value) = spec.fixed.get(name) else {
        return Ok(limits.map_or(0.0, |[lower, upper]| 0.0_f64.clamp(lower, upper)));
    };
    let wrong = |number| ChainError::Joint { joint: name.clone(), number };
    Range::from(-MAX_VALUE..=MAX_VALUE).check("fixed", Some("rad or m"), value).map_err(wrong)?;
    match limits {
        Some([lower, upper]) if value < lower || value > upper => {
            Err(ChainError::FixedOutside { joint: name.clone(), value, lower, upper })
        }
        _ => Ok(value),
    }
}

fn home(spec: &RobotSpec, genes: &[Gene]) -> Result<Vec<f64>, ChainError> {
    if let Some(joint) = spec.home.keys().find(|name| genes.iter().all(|g| g.name != **name)) {
        let movable = genes.iter().map(|g| g.name.clone()).collect();
        return Err(ChainError::UnknownJoint { role: "home", joint: joint.clone(), movable });
    }
    let of = |gene: &Gene| {
        let Some(&value) = spec.home.get(&gene.name) else { return Ok(0.0_f64.clamp(gene.lower, gene.upper)) };
        if (gene.lower..=gene.upper).contains(&value) {
            return Ok(value);
        }
        let (joint, lower, upper) = (gene.name.clone(), gene.lower, gene.upper);
        Err(ChainError::HomeOutside { joint, value, lower, upper })
    };
    genes.iter().map(of).collect()
}

fn gene(model: &RobotModel, spec: &RobotSpec, path: &[usize], index: usize) -> Result<Gene, ChainError> {
    let joint = &model.joints()[index];
    let [mut lower, mut upper] =
        position_limits(model, spec, index)?.ok_or_else(|| ChainError::NoLimits { joint: joint.name.clone() })?;
    let mut velocity = joint.velocity;
    for follower in path.iter().map(|&j| &model.joints()[j]) {
        let Some(mimic) = follower.mimic.filter(|m| m.source == index && m.multiplier != 0.0) else { continue };
        if let (Some([low, high]), false) = (follower.limits, follower.kind == JointKind::Continuous) {
            let (a, b) = ((low - mimic.offset) / mimic.multiplier, (high - mimic.offset) / mimic.multiplier);
            lower = lower.max(a.min(b));
            upper = upper.min(a.max(b));
        }
        if let Some(limit) = follower.velocity {
            let mapped = limit / mimic.multiplier.abs();
            velocity = Some(velocity.map_or(mapped, |v| v.min(mapped)));
        }
    }
    if lower > upper {
        return Err(ChainError::LimitOrder { joint: joint.name.clone(), lower, upper });
    }
    let stated = |parameter, unit, by_joint: &BTreeMap<String, f64>| {
        let Some(&value) = by_joint.get(&joint.name) else { return Ok(None) };
        let wrong = |number| ChainError::Joint { joint: joint.name.clone(), number };
        above(0.0).check(parameter, Some(unit), value).map_err(wrong).map(|()| Some(value))
    };
    let acceleration = stated("acceleration", "rad/s^2 or m/s^2", &spec.acceleration)?;
    let jerk = stated("jerk", "rad/s^3 or m/s^3", &spec.jerk)?;
    Ok(Gene { name: joint.name.clone(), kind: joint.kind, lower, upper, velocity, acceleration, jerk })
}
