//! Convex solids in the frames of a chain, and the distance between two of them.
//!
//! A solid is a core with a skin: a sphere is a point with its radius, a capsule a segment with its radius, all others
//! have no skin. Distances of cores are found by parry and its Gilbert-Johnson-Keerthi search (Gilbert, Johnson and
//! Keerthi 1988, doi:10.1109/56.2083), in closed form where there is one.

use nalgebra::{Isometry3, UnitQuaternion, Vector3};
use parry3d_f64::math::{Pose, Rotation, Vector};
use parry3d_f64::query::details::distance_support_map_support_map;
use parry3d_f64::query::{DefaultQueryDispatcher, QueryDispatcher};
use parry3d_f64::shape::SharedShape;
use std::f64::consts::FRAC_PI_2;

/// Place and owner of a solid.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surround {
    /// Index of the name of the link or obstacle.
    pub owner: usize,
    /// Frame of the chain, as of [`Placement`](crate::robot::Placement).
    pub frame: usize,
    /// Pose in that frame.
    pub x_f: Isometry3<f64>,
}

/// A convex solid.
#[derive(Debug, Clone)]
pub(super) struct Solid {
    core: SharedShape,
    skin_m: f64,
    /// Index of the name of the link or obstacle.
    pub owner: usize,
    /// Frame of the chain.
    pub frame: usize,
    /// Pose in that frame.
    pub local: Pose,
    /// Radius of the smallest known sphere around the solid's own origin; infinite for half-spaces.
    pub bound_m: f64,
}

impl Solid {
    fn new(around: Surround, core: SharedShape, skin_m: f64, bound_m: f64) -> Self {
        Self { core, skin_m, owner: around.owner, frame: around.frame, local: pose(&around.x_f), bound_m }
    }

    pub(super) fn sphere(around: Surround, radius_m: f64) -> Self {
        Self::new(around, SharedShape::ball(radius_m), 0.0, radius_m)
    }

    pub(super) fn cuboid(around: Surround, size_m: [f64; 3]) -> Self {
        let [x, y, z] = size_m.map(|side| side / 2.0);
        Self::new(around, SharedShape::cuboid(x, y, z), 0.0, Vector3::new(x, y, z).norm())
    }

    /// Cylinder along z of the solid's frame.
    pub(super) fn cylinder(around: Surround, radius_m: f64, length_m: f64) -> Self {
        // parry's cylinders lie along y
        let upright = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), FRAC_PI_2);
        let around = Surround { x_f: around.x_f * upright, ..around };
        let half = length_m / 2.0;
        Self::new(around, SharedShape::cylinder(half, radius_m), 0.0, half.hypot(radius_m))
    }

    /// Capsule from `a` to `b`, both in the solid's frame.
    pub(super) fn capsule(around: Surround, [a, b]: [Vector3<f64>; 2], radius_m: f64) -> Self {
        let (middle, half) = ((a + b) / 2.0, (b - a) / 2.0);
        let mut x_f = around.x_f;
        x_f.translation.vector = (around.x_f * nalgebra::Point3::from(middle)).coords;
        let around = Surround { x_f, ..around };
        if half.norm() == 0.0 {
            return Self::sphere(around, radius_m);
        }
        let end = vector(&half);
        Self::new(around, SharedShape::segment(-end, end), radius_m, half.norm() + radius_m)
    }

    /// Convex shape within `bound_m` of its origin.
    pub(super) fn convex(around: Surround, shape: SharedShape, bound_m: f64) -> Self {
        Self::new(around, shape, 0.0, bound_m)
    }

    /// Distance of the solid's farthest point from the origin of its frame, or more.
    pub(super) fn reach_m(&self) -> f64 {
        self.local.translation.length() + self.bound_m
    }
}

/// Lower bound of the distance of two solids at the given poses; minus infinity for half-spaces.
pub(super) fn separation([a, b]: [&Solid; 2], [x_a, x_b]: [&Pose; 2]) -> f64 {
    (x_a.translation - x_b.translation).length() - a.bound_m - b.bound_m
}

/// Distance of two solids at the given poses, m; 0 if they overlap.
pub(super) fn distance([a, b]: [&Solid; 2], [x_a, x_b]: [&Pose; 2]) -> f64 {
    let x_ab = x_a.inv_mul(x_b);
    let cores = match (a.core.as_cuboid(), b.core.as_cuboid()) {
        // parry's own answer for two boxes is only an upper bound if two corners are closest
        (Some(first), Some(second)) => distance_support_map_support_map(&x_ab, first, second),
        _ => DefaultQueryDispatcher.distance(&x_ab, &*a.core, &*b.core).map_or(0.0, |found| found.distance),
    };
    (cores - a.skin_m - b.skin_m).max(0.0)
}

/// Distance of two solids at the given poses, m; minus the depth of the penetration if they overlap, or 0 where the
/// search for that depth (expanding polytopes, van den Bergen 2001) does not converge.
pub(super) fn signed_distance([a, b]: [&Solid; 2], [x_a, x_b]: [&Pose; 2]) -> f64 {
    let apart = distance([a, b], [x_a, x_b]);
    if apart > 0.0 {
        return apart;
    }
    let x_ab = x_a.inv_mul(x_b);
    let found = DefaultQueryDispatcher.contact(&x_ab, &*a.core, &*b.core, a.skin_m + b.skin_m);
    let cores = found.ok().flatten().map_or(0.0, |contact| contact.dist);
    (cores - a.skin_m - b.skin_m).min(0.0)
}

/// parry's form of a pose.
pub(super) fn pose(x: &Isometry3<f64>) -> Pose {
    let q = x.rotation.coords;
    Pose::from_parts(vector(&x.translation.vector), Rotation::from_xyzw(q.x, q.y, q.z, q.w))
}

fn vector(v: &Vector3<f64>) -> Vector {
    Vector::new(v.x, v.y, v.z)
}
