//! The constraint `collision_free` and its obstacles.

use super::super::enumeration::{Enumeration as _, or_default};
use super::super::{all, finite, finite_or_none, required, rows, triple};
use crate::app::model::AppError;
use crate::framework::collision::{
    BoxObstacle, HalfSpaceObstacle, HullObstacle, Obstacle, ObstacleShape, SphereObstacle,
};
use crate::framework::constraint::CollisionFreeSpec;
use crate::grpc::proto;
use proto::obstacle_shape::Kind;

/// The constraint; `at` is its JSON pointer.
pub(super) fn collision_free(at: &str, message: proto::CollisionFreeConstraint) -> Result<CollisionFreeSpec, AppError> {
    let proto::CollisionFreeConstraint {
        obstacles,
        excluded,
        margin_m,
        capsule_radius_m,
        tool_radius_m,
        surface,
        surface_thickness_m,
        home_contacts,
    } = message;
    let unless_given = CollisionFreeSpec::default();
    let length = |field: &str, value, default: f64| {
        Ok::<_, AppError>(finite_or_none(&format!("{at}/{field}"), value)?.unwrap_or(default))
    };
    let obstacles = obstacles.into_iter().enumerate();
    Ok(CollisionFreeSpec {
        obstacles: obstacles
            .map(|(index, message)| obstacle(&format!("{at}/obstacles/{index}"), message))
            .collect::<Result<_, _>>()?,
        excluded: excluded.into_iter().map(|proto::NamePair { first, second }| [first, second]).collect(),
        margin_m: length("margin_m", margin_m, unless_given.margin_m)?,
        capsule_radius_m: length("capsule_radius_m", capsule_radius_m, unless_given.capsule_radius_m)?,
        tool_radius_m: length("tool_radius_m", tool_radius_m, unless_given.tool_radius_m)?,
        surface: surface.unwrap_or(unless_given.surface),
        surface_thickness_m: finite_or_none(&format!("{at}/surface_thickness_m"), surface_thickness_m)?,
        home_contacts: or_default(&format!("{at}/home_contacts"), home_contacts)?,
    })
}

fn obstacle(at: &str, message: proto::Obstacle) -> Result<Obstacle, AppError> {
    let proto::Obstacle { name, shape } = message;
    let place = |field: &str| format!("{at}/shape/{field}");
    let kind = shape.and_then(|proto::ObstacleShape { kind }| kind);
    let shape = match required(&format!("{at}/shape"), kind)? {
        Kind::Box(proto::BoxObstacle { size_m, center_m, rpy_rad }) => ObstacleShape::Box(BoxObstacle {
            size_m: triple(&place("size_m"), &size_m)?,
            center_m: triple(&place("center_m"), &center_m)?,
            rpy_rad: if rpy_rad.is_empty() { [0.0; 3] } else { triple(&place("rpy_rad"), &rpy_rad)? },
        }),
        Kind::Sphere(proto::SphereObstacle { center_m, radius_m }) => ObstacleShape::Sphere(SphereObstacle {
            center_m: triple(&place("center_m"), &center_m)?,
            radius_m: finite(&place("radius_m"), radius_m)?,
        }),
        Kind::Hull(proto::HullObstacle { points_m }) => {
            let points = rows(&place("points_m"), points_m)?.into_iter().enumerate();
            let point = |(index, point): (usize, Vec<f64>)| triple(&place(&format!("points_m/{index}")), &point);
            ObstacleShape::Hull(HullObstacle { points_m: points.map(point).collect::<Result<_, _>>()? })
        }
        Kind::HalfSpace(proto::HalfSpaceObstacle { point_m, normal }) => ObstacleShape::HalfSpace(HalfSpaceObstacle {
            point_m: triple(&place("point_m"), &point_m)?,
            normal: triple(&place("normal"), &normal)?,
        }),
    };
    Ok(Obstacle { name, shape })
}

impl From<CollisionFreeSpec> for proto::CollisionFreeConstraint {
    fn from(spec: CollisionFreeSpec) -> Self {
        let CollisionFreeSpec {
            obstacles,
            excluded,
            margin_m,
            capsule_radius_m,
            tool_radius_m,
            surface,
            surface_thickness_m,
            home_contacts,
        } = spec;
        Self {
            obstacles: all(obstacles),
            excluded: excluded.into_iter().map(|[first, second]| proto::NamePair { first, second }).collect(),
            margin_m: Some(margin_m),
            capsule_radius_m: Some(capsule_radius_m),
            tool_radius_m: Some(tool_radius_m),
            surface: Some(surface),
            surface_thickness_m,
            home_contacts: home_contacts.number(),
        }
    }
}

impl From<Obstacle> for proto::Obstacle {
    fn from(obstacle: Obstacle) -> Self {
        let Obstacle { name, shape } = obstacle;
        let kind = match shape {
            ObstacleShape::Box(BoxObstacle { size_m, center_m, rpy_rad }) => Kind::Box(proto::BoxObstacle {
                size_m: size_m.to_vec(),
                center_m: center_m.to_vec(),
                rpy_rad: rpy_rad.to_vec(),
            }),
            ObstacleShape::Sphere(SphereObstacle { center_m, radius_m }) => {
                Kind::Sphere(proto::SphereObstacle { center_m: center_m.to_vec(), radius_m })
            }
            ObstacleShape::Hull(HullObstacle { points_m }) => Kind::Hull(proto::HullObstacle {
                points_m: points_m.into_iter().map(|point| point.to_vec().into()).collect(),
            }),
            ObstacleShape::HalfSpace(HalfSpaceObstacle { point_m, normal }) => {
                Kind::HalfSpace(proto::HalfSpaceObstacle { point_m: point_m.to_vec(), normal: normal.to_vec() })
            }
        };
        Self { name, shape: Some(proto::ObstacleShape { kind: Some(kind) }) }
    }
}
