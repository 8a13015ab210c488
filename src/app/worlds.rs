//! Worlds: where effects happen.

use crate::app::model::{AppError, CreateWorld, Keyset, Page, PageQuery, WorldId, WorldView};
use crate::app::{App, chain_text, check_name};
use crate::framework::world::{self};

impl App {
    /// Checks and stores a world.
    ///
    /// # Errors
    /// `Invalid` world.
    pub async fn create_world(&self, request: CreateWorld) -> Result<WorldView, AppError> {
        check_name("/name", &request.name)?;
        let features = world::features(&request.spec)
            .map_err(|error| AppError::field("/spec", "invalid_world", chain_text(&error)))?;
        let id = WorldId::from_uuid(self.ports.ids.uuid());
        let view = WorldView { id, name: request.name, spec: request.spec, features, created_at: self.now() };
        self.ports.store.insert_world(view.clone()).await?;
        Ok(view)
    }

    /// Lists worlds, newest first.
    ///
    /// # Errors
    /// `Malformed` page.
    pub async fn list_worlds(&self, page: PageQuery) -> Result<Page<WorldView>, AppError> {
        let keyset = Keyset::new(&page, "worlds")?;
        let worlds = self.ports.store.worlds(&keyset).await?;
        Ok(keyset.page(worlds, |world| world.id.to_string()))
    }

    /// Reads one world.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn get_world(&self, id: &WorldId) -> Result<WorldView, AppError> {
        Ok(self.ports.store.world(id).await?)
    }

    /// Deletes a world unless a job uses it.
    ///
    /// # Errors
    /// `NotFound`; `Conflict` if jobs use it.
    pub async fn delete_world(&self, id: &WorldId) -> Result<(), AppError> {
        Ok(self.ports.store.delete_world(id).await?)
    }
}
