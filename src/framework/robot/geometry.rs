//! Shapes of a robot's links as its URDF gives them, unchecked: sizes may be zero, negative or not finite.

use nalgebra::{Isometry3, Translation3, UnitQuaternion};

/// Shape of a `<collision>` or `<visual>` element, centred on its own frame; metres.
#[derive(Debug, Clone, PartialEq)]
pub enum LinkShape {
    /// Box with its sides along the axes.
    Box {
        /// Full lengths of the sides.
        size_m: [f64; 3],
    },
    /// Ball around the origin.
    Sphere {
        /// Radius.
        radius_m: f64,
    },
    /// Cylinder along z.
    Cylinder {
        /// Radius.
        radius_m: f64,
        /// Full length.
        length_m: f64,
    },
    /// Capsule along z.
    Capsule {
        /// Radius.
        radius_m: f64,
        /// Length between the centres of its two half-spheres.
        length_m: f64,
    },
    /// Mesh in a file, which is not read.
    Mesh,
}

/// A shape S in its link L.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedShape {
    /// `X_LS`: pose of the shape in its link.
    pub x_ls: Isometry3<f64>,
    /// Form and size.
    pub shape: LinkShape,
}

/// Shapes of one link, in the URDF's order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LinkGeometry {
    /// Shapes for collision checks.
    pub collision: Vec<PlacedShape>,
    /// Shapes for viewers.
    pub visual: Vec<PlacedShape>,
}

impl LinkGeometry {
    pub(super) fn read(link: &urdf_rs::Link) -> Self {
        let placed = |origin, geometry| PlacedShape { x_ls: pose(origin), shape: shape(geometry) };
        Self {
            collision: link.collision.iter().map(|c| placed(&c.origin, &c.geometry)).collect(),
            visual: link.visual.iter().map(|v| placed(&v.origin, &v.geometry)).collect(),
        }
    }
}

fn shape(geometry: &urdf_rs::Geometry) -> LinkShape {
    match *geometry {
        urdf_rs::Geometry::Box { size } => LinkShape::Box { size_m: size.0 },
        urdf_rs::Geometry::Sphere { radius } => LinkShape::Sphere { radius_m: radius },
        urdf_rs::Geometry::Cylinder { radius, length } => LinkShape::Cylinder { radius_m: radius, length_m: length },
        urdf_rs::Geometry::Capsule { radius, length } => LinkShape::Capsule { radius_m: radius, length_m: length },
        urdf_rs::Geometry::Mesh { .. } => LinkShape::Mesh,
    }
}

/// Pose of a URDF's `<origin>`.
pub(super) fn pose(origin: &urdf_rs::Pose) -> Isometry3<f64> {
    let [roll, pitch, yaw] = origin.rpy.0;
    Isometry3::from_parts(Translation3::from(origin.xyz.0), UnitQuaternion::from_euler_angles(roll, pitch, yaw))
}
