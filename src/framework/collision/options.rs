//! Options of collision checks, with their defaults.

use super::error::CollisionError;
use crate::range::{Range, above};
use serde::{Deserialize, Serialize};

/// Treatment of pairs of links that are in contact at the chain's home pose.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum HomeContacts {
    /// Pairs that are in contact at most other poses too are excluded and reported: their shapes overlap by design. The
    /// rest is checked.
    #[default]
    Exclude,
    /// They are checked as all others.
    Check,
}

/// Options of a [`CollisionModel`](super::CollisionModel).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CollisionOptions {
    /// Clearance that every pair keeps at every check, metres (> 0).
    pub margin_m: f64,
    /// Longest path of any point of a link between two checks of a motion, metres (> 0).
    pub step_m: f64,
    /// Radius of the capsules that stand for links whose shape is unknown, metres (> 0).
    pub capsule_radius_m: f64,
    /// Radius of the capsule from the tip link's origin to the tool centre point, metres (> 0).
    pub tool_radius_m: f64,
    /// Pairs of names that are not checked: links, obstacles or [`TOOL`](super::TOOL).
    pub excluded: Vec<[String; 2]>,
    /// Pairs of links that are in contact at the home pose.
    pub home_contacts: HomeContacts,
}

impl Default for CollisionOptions {
    fn default() -> Self {
        Self {
            margin_m: 0.001,
            step_m: 0.005,
            capsule_radius_m: 0.03,
            tool_radius_m: 0.001,
            excluded: Vec::new(),
            home_contacts: HomeContacts::Exclude,
        }
    }
}

impl CollisionOptions {
    /// Checks the lengths.
    ///
    /// # Errors
    /// [`CollisionError::OutOfRange`] with the first that is not positive or above 1 m.
    pub(super) fn check(&self) -> Result<(), CollisionError> {
        let length: Range = above(0.0).up_to(1.0);
        for (name, value) in [
            ("margin_m", self.margin_m),
            ("step_m", self.step_m),
            ("capsule_radius_m", self.capsule_radius_m),
            ("tool_radius_m", self.tool_radius_m),
        ] {
            let wrong = |number| CollisionError::OutOfRange { item: "collision options".to_owned(), number };
            length.check(name, Some("m"), value).map_err(wrong)?;
        }
        Ok(())
    }
}
