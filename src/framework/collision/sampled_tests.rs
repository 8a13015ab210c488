//! Properties against brute force: distances against samples of both surfaces, and the motion bound against samples of
//! the motion.

use super::solid::{Solid, Surround, distance, separation};
use crate::robot::{Chain, Placement, RobotModel, RobotSpec, moving_frames, travel_bound};
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
use proptest::prelude::*;

const TEO_ARM: &str = include_str!("../../../examples/robots/teo_right_arm.urdf");

/// Half sides, or radius and half length, m.
const A: f64 = 0.1;
const B: f64 = 0.2;
const C: f64 = 0.3;

#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    Sphere,
    Box,
    Cylinder,
    Capsule,
}

fn solid(kind: Kind, x_f: Isometry3<f64>) -> Solid {
    let around = Surround { owner: 0, frame: 0, x_f };
    match kind {
        Kind::Sphere => Solid::sphere(around, B),
        Kind::Box => Solid::cuboid(around, [2.0 * A, 2.0 * B, 2.0 * C]),
        Kind::Cylinder => Solid::cylinder(around, A, 2.0 * C),
        Kind::Capsule => Solid::capsule(around, [-Vector3::z() * C, Vector3::z() * C], A),
    }
}

/// The point of the shape, in its own frame, that is nearest to `p`; in closed form.
fn nearest(kind: Kind, p: &Vector3<f64>) -> Vector3<f64> {
    let shorten = |v: Vector3<f64>, length: f64| if v.norm() > length { v * (length / v.norm()) } else { v };
    match kind {
        Kind::Sphere => shorten(*p, B),
        Kind::Box => Vector3::new(p.x.clamp(-A, A), p.y.clamp(-B, B), p.z.clamp(-C, C)),
        Kind::Cylinder => shorten(Vector3::new(p.x, p.y, 0.0), A) + Vector3::z() * p.z.clamp(-C, C),
        Kind::Capsule => {
            let axis = Vector3::z() * p.z.clamp(-C, C);
            axis + shorten(p - axis, A)
        }
    }
}

/// Alternating projections onto two convex sets converge to a closest pair (Cheney and Goldstein 1959,
/// doi:10.1090/S0002-9939-1959-0105008-8).
fn projected(kinds: [Kind; 2], poses: [Isometry3<f64>; 2]) -> f64 {
    let project = |i: usize, p: &Vector3<f64>| {
        let local = poses[i].inverse_transform_point(&Point3::from(*p)).coords;
        poses[i].transform_point(&Point3::from(nearest(kinds[i], &local))).coords
    };
    let mut p = poses[0].translation.vector;
    let mut gap = f64::INFINITY;
    for _ in 0..4000 {
        let q = project(1, &p);
        p = project(0, &q);
        gap = (p - q).norm();
    }
    gap
}

fn kinds() -> impl Strategy<Value = Kind> {
    prop::sample::select(vec![Kind::Sphere, Kind::Box, Kind::Cylinder, Kind::Capsule])
}

fn poses() -> impl Strategy<Value = Isometry3<f64>> {
    (prop::array::uniform3(-0.6..0.6_f64), prop::array::uniform3(-3.0..3.0_f64)).prop_map(|(at, [r, p, y])| {
        Isometry3::from_parts(Translation3::from(at), UnitQuaternion::from_euler_angles(r, p, y))
    })
}

fn arm() -> (RobotModel, Chain) {
    let model = RobotModel::from_urdf(TEO_ARM).unwrap();
    let chain = Chain::new(&model, &RobotSpec::default()).unwrap();
    (model, chain)
}

fn at(place: &Placement, frames: &[Isometry3<f64>]) -> Vector3<f64> {
    (frames[place.frame] * place.x_f).translation.vector
}

proptest! {
    #[test]
    fn distances_equal_alternating_projections(a in kinds(), b in kinds(), x in poses(), y in poses()) {
        let [first, second] = [solid(a, x), solid(b, y)];
        let found = distance([&first, &second], [&first.local, &second.local]);
        let known = projected([a, b], [x, y]);
        prop_assert!(found <= known + 1e-5, "{found} is more than {known}");
        prop_assert!(found >= known - 1e-4, "{found} is less than {known}");
        prop_assert!(separation([&first, &second], [&first.local, &second.local]) <= found + 1e-12);
        let swapped = distance([&second, &first], [&second.local, &first.local]);
        prop_assert!((swapped - found).abs() < 1e-5);
    }

    #[test]
    fn the_motion_bound_is_not_exceeded(
        from in prop::array::uniform6(-1.5..1.5_f64),
        to in prop::array::uniform6(-1.5..1.5_f64),
        lower in 0..6_usize,
    ) {
        let (_, chain) = arm();
        let tool = chain.tool_placement();
        let bound = travel_bound(&chain, &from, &to, [lower, tool.frame], tool.x_f.translation.vector.norm());
        let mut frames = vec![Isometry3::identity(); chain.frames()];
        let mut seen = |s: f64| {
            let joints: Vec<f64> = from.iter().zip(&to).map(|(a, b)| a + s * (b - a)).collect();
            moving_frames(&chain, &joints, &mut frames);
            frames[lower].inverse_transform_point(&Point3::from(at(&tool, &frames))).coords
        };
        let points: Vec<Vector3<f64>> = (0..=200).map(|i| seen(f64::from(i) / 200.0)).collect();
        let path: f64 = points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
        prop_assert!(path <= bound + 1e-9, "{path} m is more than the bound {bound} m");
    }
}

#[test]
fn placements_agree_with_the_kinematics_of_the_chain() {
    let (model, chain) = arm();
    let joints = [0.3, -0.1, 0.2, 0.9, -0.4, 0.6];
    let mut frames = vec![Isometry3::identity(); chain.frames()];
    moving_frames(&chain, &joints, &mut frames);
    let places = chain.placements(&model);
    for (link, place) in model.links().iter().zip(&places).filter(|(link, _)| *link != "base" && *link != "torso") {
        let spec = RobotSpec { tip_link: Some(link.clone()), ..RobotSpec::default() };
        let part = Chain::new(&model, &spec).unwrap();
        let known = crate::robot::tool_position(&part, &joints[..part.len()]);
        assert!((at(place, &frames) - known).norm() < 1e-12, "{link}");
    }
}
