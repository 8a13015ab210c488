//! A world.

use super::{document, unchanged, versions};
use crate::app::model::{Timestamp, WorldId, WorldView};
use crate::framework::Feature;
use crate::framework::world::WorldSpec;

document! {
    /// A world.
    World keeps WorldView {
        id: WorldId,
        name: String,
        spec: WorldSpec,
        features: Vec<Feature>,
        created_at: Timestamp,
    }
}
versions! { World keeps WorldView, "world", [unchanged] }
