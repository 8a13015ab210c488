//! A world; its specification is stored as the core writes it, see [`super::job`].

use super::{document, unchanged, versions};
use crate::app::model::{Timestamp, WorldId, WorldView};
use crate::framework::Feature;
use crate::framework::world::WorldSpec;

document! {
    /// A world with its features.
    World keeps WorldView {
        id: WorldId,
        name: String,
        spec: WorldSpec,
        features: Vec<Feature>,
        created_at: Timestamp,
    }
}
versions! { World keeps WorldView, "world", [unchanged] }
