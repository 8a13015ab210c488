//! Worlds: where effects happen.

use crate::app::id::WorldId;
use crate::app::{App, AppError, Page, PageQuery, Timestamp};
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

impl App {
    /// Checks and keeps a world.
    ///
    /// # Errors
    /// `Invalid` world.
    pub async fn create_world(&self, request: CreateWorld) -> Result<WorldView, AppError> {
        let _ = request;
        Err(self.unfinished())
    }

    /// Newest first.
    ///
    /// # Errors
    /// `Malformed` page.
    pub async fn list_worlds(&self, page: PageQuery) -> Result<Page<WorldView>, AppError> {
        let _ = page;
        Err(self.unfinished())
    }

    /// One world.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn get_world(&self, id: &WorldId) -> Result<WorldView, AppError> {
        let _ = id;
        Err(self.unfinished())
    }

    /// Deletes it unless a job names it.
    ///
    /// # Errors
    /// `NotFound`; `Conflict` when jobs name it.
    pub async fn delete_world(&self, id: &WorldId) -> Result<(), AppError> {
        let _ = id;
        Err(self.unfinished())
    }
}
