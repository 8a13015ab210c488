//! The constraint `collision_free`: no contact of the robot with itself, with obstacles or with the worked surface.
//!
//! It is hard: a pose in collision is never proposed and never executed, not even under a penalty.

use super::error::ConstraintError;
use crate::collision::{CollisionModel, CollisionOptions, HomeContacts, Obstacle, surface_obstacle};
use crate::robot::{Chain, RobotModel};
use crate::world::WorldSpec;
use serde::{Deserialize, Serialize};

/// Name of the worked surface in reports and excluded pairs.
pub const WORKED_SURFACE: &str = "worked surface";

/// The clearance that every pose keeps, and the surroundings.
///
/// Links have the boxes, spheres, cylinders and capsules of the URDF's `<collision>` elements, or else of its `<visual>`
/// elements; capsules to its joints stand for a link that has meshes only. Links next to each other are not checked.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields, default)]
pub struct CollisionFreeSpec {
    /// Obstacles at rest in the chain's base frame.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub obstacles: Vec<Obstacle>,
    /// Pairs of names that are not checked: links, obstacles, `tool centre point` or `worked surface`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub excluded: Vec<[String; 2]>,
    /// Distance that all others keep from each other, m (> 0, at most 1).
    pub margin_m: f64,
    /// Radius of the capsules that stand for links of unknown shape, m (> 0, at most 1).
    pub capsule_radius_m: f64,
    /// Radius of the tool from the last link's origin to the tool centre point, m (> 0, at most 1).
    pub tool_radius_m: f64,
    /// Whether the surface of a world that has one is a solid. The shape of the last link, the tool, may touch it; the
    /// tool centre point and all other links may not go through.
    pub surface: bool,
    /// Thickness of that solid, m (> 0); if absent, the radius of the tool's effect, so that no cell can be reached from
    /// behind.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surface_thickness_m: Option<f64>,
    /// Pairs of links that are in contact at the home pose.
    pub home_contacts: HomeContacts,
}

impl Default for CollisionFreeSpec {
    fn default() -> Self {
        let CollisionOptions { margin_m, capsule_radius_m, tool_radius_m, excluded, home_contacts, .. } =
            CollisionOptions::default();
        Self {
            obstacles: Vec::new(),
            excluded,
            margin_m,
            capsule_radius_m,
            tool_radius_m,
            surface: true,
            surface_thickness_m: None,
            home_contacts,
        }
    }
}

impl CollisionFreeSpec {
    /// The collision model of `chain`, which is a chain of `model`, in `world`.
    ///
    /// # Errors
    /// [`ConstraintError::Collision`] for a wrong obstacle, pair or length, [`ConstraintError::HomeCollides`] if the
    /// chain's home pose is in collision.
    pub fn model(
        &self,
        model: &RobotModel,
        chain: &Chain,
        world: &WorldSpec,
    ) -> Result<CollisionModel, ConstraintError> {
        let (mut obstacles, mut excluded) = (self.obstacles.clone(), self.excluded.clone());
        if let Some(surface) = world.surface().filter(|_| self.surface) {
            let thickness_m = self.surface_thickness_m.unwrap_or(surface.radius_m);
            obstacles.push(surface_obstacle(WORKED_SURFACE, surface, chain, thickness_m)?);
            excluded.push([chain.tip_link().to_owned(), WORKED_SURFACE.to_owned()]);
        }
        let options = CollisionOptions {
            margin_m: self.margin_m,
            capsule_radius_m: self.capsule_radius_m,
            tool_radius_m: self.tool_radius_m,
            excluded,
            home_contacts: self.home_contacts,
            ..CollisionOptions::default()
        };
        let built = CollisionModel::new(model, chain, &obstacles, &options)?;
        match built.check(chain.home(), &mut built.workspace()) {
            Some(home) if home.distance_m <= self.margin_m => Err(ConstraintError::HomeCollides {
                pair: home.pair.map(str::to_owned),
                distance_m: home.distance_m,
                margin_m: self.margin_m,
            }),
            _ => Ok(built),
        }
    }
}
