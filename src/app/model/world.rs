//! Worlds, as requested and as shown.

use super::id::WorldId;
use super::time::Timestamp;
use crate::framework::Feature;
use crate::framework::world::WorldSpec;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Request for a new world.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct CreateWorld {
    /// Display name.
    pub name: String,
    /// Kind and parameters.
    pub spec: WorldSpec,
}

/// A world; immutable.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct WorldView {
    /// Id of the world.
    pub id: WorldId,
    /// Display name.
    pub name: String,
    /// Kind and parameters.
    pub spec: WorldSpec,
    /// Features observed in it.
    pub features: Vec<Feature>,
    /// Creation time.
    pub created_at: Timestamp,
}
