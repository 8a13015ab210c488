//! Solids of a robot's links: the URDF's collision shapes, or else stand-ins, each with a note.
//!
//! 1. Boxes, spheres, cylinders and capsules of `<collision>` are used as they are; meshes are not read.
//! 2. A link without a usable collision shape takes the boxes, spheres, cylinders and capsules of its `<visual>`.
//! 3. A link that has meshes only is a capsule from its origin to each joint it carries, or a sphere if there is none.
//! 4. If no link of the robot has any shape, each link is a capsule to each joint it carries.
//! 5. Other links without a shape are frames only.

use super::capsules::to_joints;
use super::error::CollisionError;
use super::options::CollisionOptions;
use super::solid::{Solid, Surround};
use crate::range::{OutOfRange, Range, above};
use crate::robot::{LinkShape, PlacedShape, Placement, RobotModel};
use nalgebra::Vector3;
use serde::Serialize;

/// Largest length of a link's shape, metres.
const MAX_LENGTH_M: f64 = 1e3;

/// An assumption about the shape of a link.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ShapeNote {
    /// Name of the link.
    pub link: String,
    /// Stable code: `visual_shapes`, `capsules` or `mesh_not_read`.
    pub code: &'static str,
    /// Explanation and remedy.
    pub message: String,
}

/// Solids of all links of `model`, placed at `placements`, and the assumptions made.
///
/// # Errors
/// [`CollisionError::OutOfRange`] with the link for a size or place that is not finite or out of range.
pub(super) fn solids(
    model: &RobotModel,
    placements: &[Placement],
    options: &CollisionOptions,
) -> Result<(Vec<Solid>, Vec<ShapeNote>), CollisionError> {
    let (mut solids, mut notes) = (Vec::new(), Vec::new());
    let is_bare = model.geometry().iter().all(|link| link.collision.is_empty() && link.visual.is_empty());
    for (owner, (geometry, place)) in model.geometry().iter().zip(placements).enumerate() {
        let link = &model.links()[owner];
        let around = Surround { owner, frame: place.frame, x_f: place.x_f };
        let mut note = |code, message| notes.push(ShapeNote { link: link.clone(), code, message });
        let collision = primitives(link, &geometry.collision, around)?;
        let has_mesh = |shapes: &[PlacedShape]| shapes.iter().any(|placed| placed.shape == LinkShape::Mesh);
        if !collision.is_empty() {
            if has_mesh(&geometry.collision) {
                note(
                    "mesh_not_read",
                    format!("link {link:?} has collision meshes beside its shapes: they are not read"),
                );
            }
            solids.extend(collision);
            continue;
        }
        let visual = primitives(link, &geometry.visual, around)?;
        if !visual.is_empty() {
            note("visual_shapes", format!("link {link:?} has no usable collision shape: its visual shapes are used"));
            solids.extend(visual);
            continue;
        }
        if !is_bare && !has_mesh(&geometry.collision) && !has_mesh(&geometry.visual) {
            continue;
        }
        let radius = options.capsule_radius_m;
        let mut capsules = to_joints(model, owner, around, radius);
        if capsules.is_empty() && !is_bare {
            capsules.push(Solid::sphere(around, radius));
        }
        if !capsules.is_empty() {
            note(
                "capsules",
                format!(
                    "the shape of link {link:?} is unknown: capsules of radius {radius} m to its joints stand for it; \
                     add a <collision> of boxes, spheres or cylinders"
                ),
            );
        }
        solids.extend(capsules);
    }
    Ok((solids, notes))
}

/// The shapes that need no file.
fn primitives(link: &str, shapes: &[PlacedShape], around: Surround) -> Result<Vec<Solid>, CollisionError> {
    let wrong = |number: OutOfRange| CollisionError::OutOfRange { item: format!("shape of link {link:?}"), number };
    let length = |field, value| above(0.0).up_to(MAX_LENGTH_M).check(field, Some("m"), value).map_err(wrong);
    let mut solids = Vec::new();
    for placed in shapes {
        let x = &placed.x_ls;
        Range::from(-MAX_LENGTH_M..=MAX_LENGTH_M)
            .check_each("origin", Some("m"), x.translation.vector.as_slice())
            .map_err(wrong)?;
        Range::from(-1.0..=1.0 + 1e-9).check_each("orientation", None, x.rotation.coords.as_slice()).map_err(wrong)?;
        let around = Surround { x_f: around.x_f * x, ..around };
        solids.push(match placed.shape {
            LinkShape::Mesh => continue,
            LinkShape::Box { size_m } => {
                size_m.iter().try_for_each(|&side| length("size", side))?;
                Solid::cuboid(around, size_m)
            }
            LinkShape::Sphere { radius_m } => {
                length("radius", radius_m)?;
                Solid::sphere(around, radius_m)
            }
            LinkShape::Cylinder { radius_m, length_m } => {
                length("radius", radius_m)?;
                length("length", length_m)?;
                Solid::cylinder(around, radius_m, length_m)
            }
            LinkShape::Capsule { radius_m, length_m } => {
                length("radius", radius_m)?;
                length("length", length_m)?;
                let end = Vector3::z() * (length_m / 2.0);
                Solid::capsule(around, [-end, end], radius_m)
            }
        });
    }
    Ok(solids)
}
