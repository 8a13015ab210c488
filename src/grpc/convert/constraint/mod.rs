//! Constraints: conditions on every candidate.

mod collision;
mod handling;

pub use handling::handling;

use super::enumeration::{Enumeration as _, or_default};
use super::{finite, list, required, rows, triple};
use crate::app::model::AppError;
use crate::framework::constraint::{
    ChainJoint, ConstraintSpec, GeometrySpec, HalfSpace, JointStepSpec, PointSpec, PopulationVelocitySpec, RegionSpec,
};
use crate::grpc::proto;
use proto::constraint_spec::Kind;
use proto::geometry::Shape;
use proto::robot_point::At;

/// One constraint; `at` is its JSON pointer.
pub fn constraint(at: &str, message: proto::ConstraintSpec) -> Result<ConstraintSpec, AppError> {
    let proto::ConstraintSpec { kind } = message;
    match required(&format!("{at}/kind"), kind)? {
        Kind::CollisionFree(message) => collision::collision_free(at, message).map(ConstraintSpec::CollisionFree),
        Kind::Region(message) => region(at, message).map(ConstraintSpec::Region),
        Kind::PopulationVelocity(proto::PopulationVelocityConstraint { limit_rad }) => {
            let limit_rad = finite(&format!("{at}/limit_rad"), limit_rad)?;
            Ok(ConstraintSpec::PopulationVelocity(PopulationVelocitySpec { limit_rad }))
        }
        Kind::JointStep(proto::JointStepConstraint { limit_rad, start }) => {
            let limit_rad = finite(&format!("{at}/limit_rad"), limit_rad)?;
            for (index, value) in start.iter().enumerate() {
                finite(&format!("{at}/start/{index}"), *value)?;
            }
            Ok(ConstraintSpec::JointStep(JointStepSpec { limit_rad, start: list(start) }))
        }
    }
}

fn region(at: &str, message: proto::RegionConstraint) -> Result<RegionSpec, AppError> {
    let proto::RegionConstraint { geometry, side, point } = message;
    let shape = required(&format!("{at}/geometry"), geometry.and_then(|proto::Geometry { shape }| shape))?;
    Ok(RegionSpec {
        geometry: self::geometry(&format!("{at}/geometry"), shape)?,
        side: or_default(&format!("{at}/side"), side)?,
        point: match point {
            None => PointSpec::Tool,
            Some(proto::RobotPoint { at: part }) => self::point(&format!("{at}/point"), part)?,
        },
    })
}

fn geometry(at: &str, shape: Shape) -> Result<GeometrySpec, AppError> {
    let place = |field: &str| format!("{at}/{field}");
    match shape {
        Shape::Box(proto::BoxShape { lower_m, upper_m, dilatation_m }) => Ok(GeometrySpec::Box {
            lower_m: triple(&place("lower_m"), &lower_m)?,
            upper_m: triple(&place("upper_m"), &upper_m)?,
            dilatation_m: finite(&place("dilatation_m"), dilatation_m)?,
        }),
        Shape::Sphere(proto::SphereShape { center_m, radius_m }) => Ok(GeometrySpec::Sphere {
            center_m: triple(&place("center_m"), &center_m)?,
            radius_m: finite(&place("radius_m"), radius_m)?,
        }),
        Shape::Hull(proto::HullShape { points_m, dilatation_m }) => {
            let points = rows(&place("points_m"), points_m)?.into_iter().enumerate();
            Ok(GeometrySpec::Hull {
                points_m: points
                    .map(|(index, point)| triple(&place(&format!("points_m/{index}")), &point))
                    .collect::<Result<_, _>>()?,
                dilatation_m: finite(&place("dilatation_m"), dilatation_m)?,
            })
        }
        Shape::Polyhedron(proto::PolyhedronShape { half_spaces }) => {
            let half_space = |(index, proto::HalfSpace { normal, offset_m })| {
                Ok(HalfSpace {
                    normal: triple(&place(&format!("half_spaces/{index}/normal")), &normal)?,
                    offset_m: finite(&place(&format!("half_spaces/{index}/offset_m")), offset_m)?,
                })
            };
            let half_spaces = half_spaces.into_iter().enumerate().map(half_space).collect::<Result<_, AppError>>()?;
            Ok(GeometrySpec::Polyhedron { half_spaces })
        }
    }
}

fn point(at: &str, part: Option<At>) -> Result<PointSpec, AppError> {
    match required(&format!("{at}/at"), part)? {
        At::Tool(proto::ToolPoint {}) => Ok(PointSpec::Tool),
        At::Link(proto::LinkPoint { link, offset_m }) => {
            let place = format!("{at}/offset_m");
            Ok(PointSpec::Link {
                link,
                offset_m: if offset_m.is_empty() { [0.0; 3] } else { triple(&place, &offset_m)? },
            })
        }
        At::Chain(proto::ChainPoint { joints, tip_m }) => {
            let joint = |(index, proto::ChainJoint { joint, offset_m, axis })| {
                let place = |field: &str| format!("{at}/joints/{index}/{field}");
                let offset_m = triple(&place("offset_m"), &offset_m)?;
                Ok(ChainJoint { joint, offset_m, axis: triple(&place("axis"), &axis)? })
            };
            Ok(PointSpec::Chain {
                joints: joints.into_iter().enumerate().map(joint).collect::<Result<_, AppError>>()?,
                tip_m: triple(&format!("{at}/tip_m"), &tip_m)?,
            })
        }
    }
}

impl From<ConstraintSpec> for proto::ConstraintSpec {
    fn from(spec: ConstraintSpec) -> Self {
        let kind = match spec {
            ConstraintSpec::Region(spec) => Kind::Region(spec.into()),
            ConstraintSpec::CollisionFree(spec) => Kind::CollisionFree(spec.into()),
            ConstraintSpec::PopulationVelocity(PopulationVelocitySpec { limit_rad }) => {
                Kind::PopulationVelocity(proto::PopulationVelocityConstraint { limit_rad })
            }
            ConstraintSpec::JointStep(JointStepSpec { limit_rad, start }) => {
                Kind::JointStep(proto::JointStepConstraint { limit_rad, start: start.unwrap_or_default() })
            }
        };
        Self { kind: Some(kind) }
    }
}

impl From<RegionSpec> for proto::RegionConstraint {
    fn from(spec: RegionSpec) -> Self {
        let RegionSpec { geometry, side, point } = spec;
        Self { geometry: Some(geometry.into()), side: side.number(), point: Some(point.into()) }
    }
}

impl From<GeometrySpec> for proto::Geometry {
    fn from(spec: GeometrySpec) -> Self {
        let shape = match spec {
            GeometrySpec::Box { lower_m, upper_m, dilatation_m } => {
                Shape::Box(proto::BoxShape { lower_m: lower_m.to_vec(), upper_m: upper_m.to_vec(), dilatation_m })
            }
            GeometrySpec::Sphere { center_m, radius_m } => {
                Shape::Sphere(proto::SphereShape { center_m: center_m.to_vec(), radius_m })
            }
            GeometrySpec::Hull { points_m, dilatation_m } => {
                let points_m = points_m.into_iter().map(|point| point.to_vec().into()).collect();
                Shape::Hull(proto::HullShape { points_m, dilatation_m })
            }
            GeometrySpec::Polyhedron { half_spaces } => {
                let half_spaces = half_spaces
                    .into_iter()
                    .map(|HalfSpace { normal, offset_m }| proto::HalfSpace { normal: normal.to_vec(), offset_m })
                    .collect();
                Shape::Polyhedron(proto::PolyhedronShape { half_spaces })
            }
        };
        Self { shape: Some(shape) }
    }
}

impl From<PointSpec> for proto::RobotPoint {
    fn from(spec: PointSpec) -> Self {
        let at = match spec {
            PointSpec::Tool => At::Tool(proto::ToolPoint {}),
            PointSpec::Link { link, offset_m } => At::Link(proto::LinkPoint { link, offset_m: offset_m.to_vec() }),
            PointSpec::Chain { joints, tip_m } => {
                let joint = |ChainJoint { joint, offset_m, axis }| proto::ChainJoint {
                    joint,
                    offset_m: offset_m.to_vec(),
                    axis: axis.to_vec(),
                };
                At::Chain(proto::ChainPoint { joints: joints.into_iter().map(joint).collect(), tip_m: tip_m.to_vec() })
            }
        };
        Self { at: Some(at) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};

    fn survives(spec: &Value) {
        let before: ConstraintSpec = serde_json::from_value(spec.clone()).unwrap();
        assert_eq!(constraint("", before.clone().into()).unwrap(), before, "{spec}");
    }

    #[test]
    fn every_constraint_survives_the_wire() {
        let (low, high) = ([0.0, -1.0, 0.5], [1.0, 1.0, 1.5]);
        for geometry in [
            json!({"shape": "box", "lower_m": low, "upper_m": high, "dilatation_m": -0.1}),
            json!({"shape": "sphere", "center_m": low, "radius_m": 0.4}),
            json!({"shape": "hull", "points_m": [low, high, [0.0, 0.0, 9.0], [1.0, 0.0, 0.0]], "dilatation_m": 0.1}),
            json!({"shape": "polyhedron", "half_spaces": [{"normal": low, "offset_m": 2.0}]}),
        ] {
            survives(&json!({"kind": "region", "geometry": geometry, "side": "outside"}));
        }
        let geometry = json!({"shape": "sphere", "center_m": low, "radius_m": 0.4});
        for point in [
            json!({"at": "tool"}),
            json!({"at": "link", "link": "elbow", "offset_m": high}),
            json!({"at": "chain", "joints": [{"joint": "a", "offset_m": low, "axis": high}], "tip_m": high}),
        ] {
            survives(&json!({"kind": "region", "geometry": geometry, "point": point}));
        }
        survives(&json!({"kind": "population_velocity", "limit_rad": 0.3}));
        survives(&json!({"kind": "joint_step", "limit_rad": 0.3, "start": [0.1, 0.2]}));
        survives(&json!({"kind": "joint_step", "limit_rad": 0.3}));
        survives(&json!({"kind": "collision_free"}));
        survives(&json!({"kind": "collision_free", "excluded": [["torso", "forearm"]], "margin_m": 0.01,
            "capsule_radius_m": 0.05, "tool_radius_m": 0.02, "surface": false, "surface_thickness_m": 0.3,
            "home_contacts": "check", "obstacles": [
                {"name": "a", "shape": {"kind": "box", "size_m": high, "center_m": low, "rpy_rad": [0.1, 0.2, 0.3]}},
                {"name": "b", "shape": {"kind": "sphere", "center_m": low, "radius_m": 0.4}},
                {"name": "c", "shape": {"kind": "hull", "points_m": [low, high, [0.0, 0.0, 9.0], [1.0, 0.0, 0.0]]}},
                {"name": "d", "shape": {"kind": "half_space", "point_m": low, "normal": high}}]}));
    }

    #[test]
    fn a_wrong_number_is_named_by_its_pointer() {
        let at = "/execution/constraints/0";
        let sphere = proto::SphereShape { center_m: vec![0.0, f64::NAN, 0.0], radius_m: 1.0 };
        let geometry = Some(proto::Geometry { shape: Some(Shape::Sphere(sphere)) });
        let region = proto::RegionConstraint { geometry, ..Default::default() };
        let wrong = proto::ConstraintSpec { kind: Some(Kind::Region(region)) };
        let pointer = |error: AppError| error.details[0].pointer.clone();
        assert_eq!(pointer(constraint(at, wrong).unwrap_err()), format!("{at}/geometry/center_m"));
        assert_eq!(pointer(constraint(at, proto::ConstraintSpec::default()).unwrap_err()), format!("{at}/kind"));
    }
}
