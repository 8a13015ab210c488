//! Worlds: the request for one, and how it is shown.

use super::id::WorldId;
use super::time::Timestamp;
use crate::framework::Feature;
use crate::framework::world::WorldSpec;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// A new world.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct CreateWorld {
    /// Display name.
    pub name: String,
    /// What it is.
    pub spec: WorldSpec,
}

/// A world; it never changes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct WorldView {
    /// Its id.
    pub id: WorldId,
    /// Display name.
    pub name: String,
    /// What it is.
    pub spec: WorldSpec,
    /// What is observed in it.
    pub features: Vec<Feature>,
    /// When it was created.
    pub created_at: Timestamp,
}
