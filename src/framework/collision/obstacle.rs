//! Obstacles as users describe them; `kind` selects the variant. All are solid and at rest in the chain's base frame.

use super::error::CollisionError;
use super::solid::{Solid, Surround};
use crate::range::{OutOfRange, Range, above};
use crate::tagged;
use nalgebra::{Isometry3, Matrix3, Translation3, UnitQuaternion, Vector3};
use parry3d_f64::math::Vector;
use parry3d_f64::shape::SharedShape;
use serde::{Deserialize, Serialize};

/// Largest coordinate or length of an obstacle, metres.
const MAX_LENGTH_M: f64 = 1e4;
/// Largest number of points of a hull.
const MAX_POINTS: usize = 4096;
/// Smallest standard deviation of a hull's points in any direction, metres.
const MIN_SPREAD_M: f64 = 1e-6;

/// A named obstacle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct Obstacle {
    /// Name in reports, unlike those of the links and of other obstacles.
    pub name: String,
    /// Shape and place.
    pub shape: ObstacleShape,
}

tagged! {
    /// Shape and place of an obstacle.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    #[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
    #[serde(tag = "kind", rename_all = "snake_case")]
    pub enum ObstacleShape {
        /// Cuboid, which may be turned.
        Box(BoxObstacle),
        /// Ball.
        Sphere(SphereObstacle),
        /// The convex hull of points.
        Hull(HullObstacle),
        /// Everything behind a plane.
        HalfSpace(HalfSpaceObstacle),
    }
}

/// Cuboid, which may be turned.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct BoxObstacle {
    /// Full lengths of the sides, metres (> 0).
    pub size_m: [f64; 3],
    /// Centre, base frame, metres.
    pub center_m: [f64; 3],
    /// Roll, pitch and yaw as in a URDF, rad.
    #[serde(default)]
    pub rpy_rad: [f64; 3],
}

/// Ball.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct SphereObstacle {
    /// Centre, base frame, metres.
    pub center_m: [f64; 3],
    /// Radius, metres (> 0).
    pub radius_m: f64,
}

/// The convex hull of points.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct HullObstacle {
    /// 4 to 4096 points that are not in a plane, base frame, metres.
    pub points_m: Vec<[f64; 3]>,
}

/// Everything behind a plane.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct HalfSpaceObstacle {
    /// A point of the plane, base frame, metres.
    pub point_m: [f64; 3],
    /// Normal of any length, towards the free side.
    pub normal: [f64; 3],
}

impl Obstacle {
    /// The solid that stands for this obstacle.
    ///
    /// # Errors
    /// [`CollisionError`] for numbers out of range, a hull without volume and a normal of length 0.
    pub(super) fn solid(&self, owner: usize) -> Result<Solid, CollisionError> {
        let wrong =
            |number: OutOfRange| CollisionError::OutOfRange { item: format!("obstacle {:?}", self.name), number };
        let place = |field, values: &[f64]| {
            Range::from(-MAX_LENGTH_M..=MAX_LENGTH_M).check_each(field, Some("m"), values).map_err(wrong)
        };
        let lengths =
            |field, values: &[f64]| above(0.0).up_to(MAX_LENGTH_M).check_each(field, Some("m"), values).map_err(wrong);
        let at = |centre: [f64; 3]| Isometry3::from_parts(Translation3::from(centre), UnitQuaternion::identity());
        let around = |x_f| Surround { owner, frame: 0, x_f };
        match &self.shape {
            ObstacleShape::Box(spec) => {
                lengths("size_m", &spec.size_m)?;
                place("center_m", &spec.center_m)?;
                Range::from(-1e3..=1e3).check_each("rpy_rad", Some("rad"), &spec.rpy_rad).map_err(wrong)?;
                let [roll, pitch, yaw] = spec.rpy_rad;
                let turned = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
                let x_f = Isometry3::from_parts(Translation3::from(spec.center_m), turned);
                Ok(Solid::cuboid(around(x_f), spec.size_m))
            }
            ObstacleShape::Sphere(spec) => {
                lengths("radius_m", &[spec.radius_m])?;
                place("center_m", &spec.center_m)?;
                Ok(Solid::sphere(around(at(spec.center_m)), spec.radius_m))
            }
            ObstacleShape::Hull(spec) => {
                place("points_m", spec.points_m.as_flattened())?;
                let (centre, shape) = hull(&spec.points_m).ok_or_else(|| CollisionError::FlatHull {
                    obstacle: self.name.clone(),
                    points: spec.points_m.len(),
                })?;
                let farthest = |far: f64, point: &[f64; 3]| far.max((Vector3::from(*point) - centre).norm());
                let radius = spec.points_m.iter().fold(0.0, farthest);
                Ok(Solid::convex(around(at(centre.into())), shape, radius))
            }
            ObstacleShape::HalfSpace(spec) => {
                place("point_m", &spec.point_m)?;
                place("normal", &spec.normal)?;
                let normal = Vector3::from(spec.normal).try_normalize(1e-12);
                let normal = normal.ok_or_else(|| CollisionError::NoDirection { obstacle: self.name.clone() })?;
                let shape = SharedShape::halfspace(Vector::new(normal.x, normal.y, normal.z));
                Ok(Solid::convex(around(at(spec.point_m)), shape, f64::INFINITY))
            }
        }
    }
}

/// Mean of the points and their hull around it; `None` if they are too few, too many or in a plane.
fn hull(points_m: &[[f64; 3]]) -> Option<(Vector3<f64>, SharedShape)> {
    if !(4..=MAX_POINTS).contains(&points_m.len()) {
        return None;
    }
    let count = points_m.len() as f64;
    let centre = points_m.iter().map(|point| Vector3::from(*point)).sum::<Vector3<f64>>() / count;
    let around = || points_m.iter().map(|point| Vector3::from(*point) - centre);
    let scatter: Matrix3<f64> = around().map(|p| p * p.transpose()).sum::<Matrix3<f64>>() / count;
    if scatter.symmetric_eigenvalues().min() < MIN_SPREAD_M * MIN_SPREAD_M {
        return None;
    }
    let points: Vec<Vector> = around().map(|p| Vector::new(p.x, p.y, p.z)).collect();
    Some((centre, SharedShape::convex_hull(&points)?))
}
