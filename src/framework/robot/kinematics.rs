//! Kinematics: free functions over an immutable [`Chain`] and a mutable [`Workspace`]; no allocation per call.

use super::chain::{Chain, Step};
use nalgebra::{Isometry3, Matrix3, Matrix6xX, Rotation3, Translation3, UnitQuaternion, Vector3};

/// Scratch space of one thread for one chain.
#[derive(Debug, Clone)]
pub struct Workspace {
    /// Per step: joint axis and joint origin, both in the base frame.
    frames: Vec<(Vector3<f64>, Vector3<f64>)>,
    jacobian: Matrix6xX<f64>,
}

impl Workspace {
    /// Allocates scratch space for `chain`.
    #[must_use]
    pub fn new(chain: &Chain) -> Self {
        Self {
            frames: vec![(Vector3::zeros(), Vector3::zeros()); chain.steps.len()],
            jacobian: Matrix6xX::zeros(chain.len()),
        }
    }
}

/// Rotates `v` by `angle` rad about unit vector `axis`, with a shortcut for coordinate axes.
#[inline]
fn rotate(axis: &Vector3<f64>, angle: f64, v: Vector3<f64>) -> Vector3<f64> {
    let (sin, cos) = angle.sin_cos();
    let [x, y, z] = [axis.x, axis.y, axis.z];
    if x == 0.0 && z == 0.0 {
        let s = y * sin;
        Vector3::new(cos * v.x + s * v.z, v.y, cos * v.z - s * v.x)
    } else if y == 0.0 && z == 0.0 {
        let s = x * sin;
        Vector3::new(v.x, cos * v.y - s * v.z, s * v.y + cos * v.z)
    } else if x == 0.0 && y == 0.0 {
        let s = z * sin;
        Vector3::new(cos * v.x - s * v.y, s * v.x + cos * v.y, v.z)
    } else {
        v * cos + axis.cross(&v) * sin + axis * (axis.dot(&v) * (1.0 - cos))
    }
}

#[inline]
fn joint_position(step: &Step, joints: &[f64]) -> f64 {
    step.multiplier * joints[step.gene] + step.offset
}

/// `p_BT`: the tool centre point in the base frame, metres.
///
/// `joints`: n free joints in gene order, rad or m. Walks from tip to base, so that only a point is transformed.
///
/// # Panics
/// If `joints` is shorter than the chain.
#[must_use]
pub fn tool_position(chain: &Chain, joints: &[f64]) -> Vector3<f64> {
    let mut p = chain.tool.translation.vector;
    for step in chain.steps.iter().rev() {
        let q = joint_position(step, joints);
        p = if step.prismatic { p + step.axis * q } else { rotate(&step.axis, q, p) };
        if !step.unrotated {
            p = step.rotation * p;
        }
        p += step.translation;
    }
    p
}

/// One joint's motion during a walk from base to tip, in the base frame.
struct Moved {
    axis: Vector3<f64>,
    /// Joint origin before the joint's own motion.
    pivot: Vector3<f64>,
    /// Rotation of the frame that the joint moves.
    rotation: Matrix3<f64>,
    /// Origin of the frame that the joint moves.
    origin: Vector3<f64>,
}

/// Walks from base to tip, hands each step's motion to `visit`, and returns the last frame's rotation and origin.
#[inline]
fn walk(chain: &Chain, joints: &[f64], mut visit: impl FnMut(usize, &Moved)) -> (Matrix3<f64>, Vector3<f64>) {
    let mut rotation = Matrix3::identity();
    let mut origin = Vector3::zeros();
    for (index, step) in chain.steps.iter().enumerate() {
        origin += rotation * step.translation;
        rotation *= step.rotation;
        let axis = rotation * step.axis;
        let pivot = origin;
        let q = joint_position(step, joints);
        if step.prismatic {
            origin += axis * q;
        } else {
            rotation *= Rotation3::from_axis_angle(&nalgebra::Unit::new_unchecked(step.axis), q).into_inner();
        }
        visit(index, &Moved { axis, pivot, rotation, origin });
    }
    (rotation, origin)
}

fn unit_quaternion(rotation: Matrix3<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rotation))
}

/// `X_BT`: the tool's pose in the base frame; leaves the joint frames of this pose in `workspace`.
///
/// # Panics
/// If `joints` is shorter than the chain or `workspace` belongs to another chain.
pub fn forward_kinematics(chain: &Chain, joints: &[f64], workspace: &mut Workspace) -> Isometry3<f64> {
    let frames = &mut workspace.frames;
    let (rotation, origin) = walk(chain, joints, |index, moved| frames[index] = (moved.axis, moved.pivot));
    let origin = origin + rotation * chain.tool.translation.vector;
    Isometry3::from_parts(Translation3::from(origin), unit_quaternion(rotation) * chain.tool.rotation)
}

/// `X_BF` of every frame F of a [`Placement`](super::Placement): `frames[0]` is the base itself, `frames[k]` the frame
/// that the chain's joint k moves.
///
/// # Panics
/// If `joints` is shorter than the chain or `frames` than [`Chain::frames`].
pub fn moving_frames(chain: &Chain, joints: &[f64], frames: &mut [Isometry3<f64>]) {
    frames[0] = Isometry3::identity();
    walk(chain, joints, |index, moved| {
        frames[index + 1] = Isometry3::from_parts(Translation3::from(moved.origin), unit_quaternion(moved.rotation));
    });
}

/// `J` (6 x n, geometric, base frame): rows 0-2 d`p_BT`/dq (m/rad or m/m), rows 3-5 angular velocity (rad/rad).
///
/// # Panics
/// As [`forward_kinematics`].
pub fn jacobian<'w>(chain: &Chain, joints: &[f64], workspace: &'w mut Workspace) -> &'w Matrix6xX<f64> {
    let tool = forward_kinematics(chain, joints, workspace).translation.vector;
    workspace.jacobian.fill(0.0);
    for (step, (axis, origin)) in chain.steps.iter().zip(&workspace.frames) {
        let axis = axis * step.multiplier;
        let mut column = workspace.jacobian.column_mut(step.gene);
        let mut linear = column.fixed_rows_mut::<3>(0);
        if step.prismatic {
            linear += axis;
            continue;
        }
        linear += axis.cross(&(tool - origin));
        let mut angular = column.fixed_rows_mut::<3>(3);
        angular += axis;
    }
    &workspace.jacobian
}
