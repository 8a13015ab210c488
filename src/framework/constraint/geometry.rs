//! Convex regions: an axis-aligned box with dilatation, a sphere, a polyhedron given by half-spaces, the hull of
//! points.
//!
//! A region is open: a point on its boundary is not inside, as in the published runs, and not safely outside either.
//! Box, hull and polyhedron are stored as half-spaces `n . p < d` with unit n. `max_k(n_k . p - d_k)` is the distance
//! to the farthest violated plane in metres: a lower bound of the distance to the region, equal to it across a face.
//! Inside, it is negative: the distance to the nearest face.
//!
//! Frame: the chain's base frame, metres.

use super::error::ConstraintError;
use super::hull;
use super::plane::Plane;
use super::spec::{GeometrySpec, Side};
use crate::range::{Range, above};
use nalgebra::Vector3;

/// Smallest violation reported, m (or rad); a point on the boundary violates by this much.
pub(super) const LEAST_VIOLATION: f64 = 1e-12;

/// A convex open region.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Region {
    Sphere { center_m: Vector3<f64>, radius_m: f64 },
    Planes(Vec<Plane>),
}

impl Region {
    /// Builds the region.
    ///
    /// # Errors
    /// [`ConstraintError`] for non-finite numbers, regions without an interior and hulls without volume.
    pub fn new(spec: &GeometrySpec) -> Result<Self, ConstraintError> {
        match spec {
            GeometrySpec::Box { lower_m, upper_m, dilatation_m } => {
                finite("lower_m", lower_m)?;
                finite("upper_m", upper_m)?;
                finite("dilatation_m", &[*dilatation_m])?;
                boxed(lower_m, upper_m, *dilatation_m)
            }
            GeometrySpec::Sphere { center_m, radius_m } => {
                finite("center_m", center_m)?;
                positive("radius_m", *radius_m)?;
                Ok(Self::Sphere { center_m: Vector3::from(*center_m), radius_m: *radius_m })
            }
            GeometrySpec::Hull { points_m, dilatation_m } => {
                points_m.iter().try_for_each(|point| finite("points_m", point))?;
                finite("dilatation_m", &[*dilatation_m])?;
                let points: Vec<_> = points_m.iter().copied().map(Vector3::from).collect();
                let mut planes = hull::planes(&points)?;
                for plane in &mut planes {
                    plane.offset_m += dilatation_m;
                }
                Ok(Self::Planes(planes))
            }
            GeometrySpec::Polyhedron { half_spaces } => {
                let planes = half_spaces.iter().map(|h| plane(h.normal, h.offset_m)).collect::<Result<Vec<_>, _>>()?;
                if planes.is_empty() {
                    return Err(ConstraintError::NoHalfSpace);
                }
                Ok(Self::Planes(planes))
            }
        }
    }

    /// Distance of `point` (m) from the required `side`: 0 if it is strictly there, else at least [`LEAST_VIOLATION`].
    #[inline]
    pub fn violation(&self, side: Side, point: &Vector3<f64>) -> f64 {
        let beyond = match self {
            Self::Sphere { center_m, radius_m } => (point - center_m).norm() - radius_m,
            Self::Planes(planes) => {
                planes.iter().map(|p| p.normal.dot(point) - p.offset_m).fold(f64::NEG_INFINITY, f64::max)
            }
        };
        let wrong = match side {
            Side::Inside => beyond,
            Side::Outside => -beyond,
        };
        if wrong < 0.0 { 0.0 } else { wrong.max(LEAST_VIOLATION) }
    }
}

fn boxed(lower: &[f64; 3], upper: &[f64; 3], dilatation: f64) -> Result<Region, ConstraintError> {
    let mut planes = Vec::with_capacity(6);
    for axis in 0..3 {
        let (low, high) = (lower[axis] - dilatation, upper[axis] + dilatation);
        if low >= high {
            return Err(ConstraintError::EmptyBox { axis: ["x", "y", "z"][axis], lower: low, upper: high });
        }
        let mut normal = Vector3::zeros();
        normal[axis] = 1.0;
        planes.push(Plane { normal, offset_m: high });
        planes.push(Plane { normal: -normal, offset_m: -low });
    }
    Ok(Region::Planes(planes))
}

fn plane(normal: [f64; 3], offset_m: f64) -> Result<Plane, ConstraintError> {
    finite("normal", &normal)?;
    finite("offset_m", &[offset_m])?;
    let length = Vector3::from(normal).norm();
    if length <= f64::MIN_POSITIVE {
        return Err(ConstraintError::NoDirection { normal });
    }
    Ok(Plane { normal: Vector3::from(normal) / length, offset_m: offset_m / length })
}

pub(super) fn finite(field: &'static str, values: &[f64]) -> Result<(), ConstraintError> {
    Ok(Range::default().check_each(field, None, values)?)
}

pub(super) fn positive(field: &'static str, value: f64) -> Result<(), ConstraintError> {
    Ok(above(0.0).check(field, None, value)?)
}

#[cfg(test)]
mod tests {
    use super::super::spec::HalfSpace;
    use super::*;
    use proptest::prelude::*;
    use rstest::rstest;

    fn unit_box(dilatation_m: f64) -> GeometrySpec {
        GeometrySpec::Box { lower_m: [0.0; 3], upper_m: [1.0; 3], dilatation_m }
    }

    fn corners() -> Vec<[f64; 3]> {
        (0..8).map(|c| [0, 1, 2].map(|axis| f64::from(c >> axis & 1))).collect()
    }

    fn as_half_spaces() -> GeometrySpec {
        let side = |axis: usize, sign: f64| {
            let mut normal = [0.0; 3];
            normal[axis] = 2.0 * sign;
            HalfSpace { normal, offset_m: if sign > 0.0 { 2.0 } else { 0.0 } }
        };
        GeometrySpec::Polyhedron { half_spaces: (0..3).flat_map(|axis| [side(axis, 1.0), side(axis, -1.0)]).collect() }
    }

    #[rstest]
    #[case([0.5, 0.5, 0.5], 0.0)]
    #[case([1.25, 0.5, 0.5], 0.25)]
    #[case([-0.5, 0.5, 1.25], 0.5)]
    #[case([1.0, 0.5, 0.5], LEAST_VIOLATION)]
    fn a_cube_is_the_same_in_three_descriptions(#[case] point: [f64; 3], #[case] violation: f64) {
        let hull = GeometrySpec::Hull { points_m: corners(), dilatation_m: 0.0 };
        for spec in [unit_box(0.0), as_half_spaces(), hull] {
            let found = Region::new(&spec).unwrap().violation(Side::Inside, &Vector3::from(point));
            assert!((found - violation).abs() < 1e-12, "{spec:?}: {found}");
            assert_eq!(found > 0.0, violation > 0.0, "{spec:?}");
        }
    }

    #[test]
    fn dilatation_moves_every_face() {
        let region = Region::new(&unit_box(0.1)).unwrap();
        assert_eq!(region.violation(Side::Inside, &Vector3::new(1.05, -0.05, 0.5)), 0.0);
        assert!((region.violation(Side::Inside, &Vector3::new(1.3, 0.5, 0.5)) - 0.2).abs() < 1e-12);
        assert!(Region::new(&unit_box(-0.5)).is_err(), "a box shrunk to nothing has no inside");
    }

    #[test]
    fn outside_is_measured_from_the_nearest_face() {
        let region = Region::new(&unit_box(0.0)).unwrap();
        let depth = |x: f64| region.violation(Side::Outside, &Vector3::new(x, 0.5, 0.5));
        assert_eq!((depth(1.1), depth(1.0)), (0.0, LEAST_VIOLATION));
        assert!((depth(0.9) - 0.1).abs() < 1e-12 && (depth(0.5) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn a_sphere_is_open() {
        let spec = GeometrySpec::Sphere { center_m: [1.0, 2.0, 3.0], radius_m: 2.0 };
        let region = Region::new(&spec).unwrap();
        assert_eq!(region.violation(Side::Inside, &Vector3::new(1.0, 2.0, 4.999)), 0.0);
        assert_eq!(region.violation(Side::Inside, &Vector3::new(1.0, 2.0, 5.0)), LEAST_VIOLATION);
        assert!((region.violation(Side::Inside, &Vector3::new(4.0, 2.0, 3.0)) - 1.0).abs() < 1e-12);
    }

    #[rstest]
    #[case(GeometrySpec::Sphere { center_m: [0.0; 3], radius_m: 0.0 }, "radius_m")]
    #[case(GeometrySpec::Sphere { center_m: [f64::NAN; 3], radius_m: 1.0 }, "center_m")]
    #[case(GeometrySpec::Polyhedron { half_spaces: vec![] }, "half-space")]
    #[case(GeometrySpec::Polyhedron { half_spaces: vec![HalfSpace { normal: [0.0; 3], offset_m: 1.0 }] }, "direction")]
    #[case(GeometrySpec::Box { lower_m: [0.0; 3], upper_m: [1.0, 0.0, 1.0], dilatation_m: 0.0 }, "y")]
    #[case(GeometrySpec::Hull { points_m: vec![[0.0; 3]; 5], dilatation_m: 0.0 }, "volume")]
    fn regions_without_inside_are_refused(#[case] spec: GeometrySpec, #[case] named: &str) {
        let message = Region::new(&spec).unwrap_err().to_string();
        assert!(message.contains(named), "{message}");
    }

    proptest! {
        #[test]
        fn convex(a in prop::array::uniform3(-3.0..3.0), b in prop::array::uniform3(-3.0..3.0), t in 0.0..1.0_f64) {
            for spec in [unit_box(0.3), GeometrySpec::Sphere { center_m: [0.5; 3], radius_m: 1.5 }] {
                let region = Region::new(&spec).unwrap();
                let (a, b) = (Vector3::from(a), Vector3::from(b));
                let between = region.violation(Side::Inside, &(a * t + b * (1.0 - t)));
                prop_assert!(between <= region.violation(Side::Inside, &a).max(region.violation(Side::Inside, &b)) + 1e-9);
            }
        }
    }
}
