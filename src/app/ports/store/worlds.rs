//! Storage of worlds.

use super::StoreError;
use crate::app::model::{Keyset, WorldId, WorldView};
use async_trait::async_trait;

/// Worlds, kept until they are deleted; a world that a job uses cannot be deleted.
#[async_trait]
pub trait Worlds: Send + Sync {
    /// Keeps a world.
    async fn insert_world(&self, new: WorldView) -> Result<(), StoreError>;
    /// Reads one world.
    async fn world(&self, id: &WorldId) -> Result<WorldView, StoreError>;
    /// Lists worlds.
    async fn worlds(&self, keyset: &Keyset) -> Result<Vec<WorldView>, StoreError>;
    /// Deletes a world that no job names.
    async fn delete_world(&self, id: &WorldId) -> Result<(), StoreError>;
}
