//! Worlds: where effects happen.

use crate::app::model::{AppError, CreateWorld, Keyset, Page, PageQuery, WorldId, WorldView};
use crate::app::{UseCases, chain_text, check_name};
use crate::framework::world::{self};

impl UseCases {
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

#[cfg(test)]
mod tests {
    use crate::app::bench::Bench;
    use crate::app::model::{CreateWorld, ErrorKind, PageQuery};
    use crate::framework::Feature;
    use crate::framework::world::{ToolPositionSpec, WorldSpec};

    #[tokio::test]
    async fn a_world_names_its_features() {
        let bench = Bench::new();
        let world = bench.world().await;
        assert_eq!(world.features, ["x", "y", "z"].map(|name| Feature::new(name, "mm")));
        assert_eq!(bench.app.list_worlds(PageQuery::default()).await.unwrap().items, [world]);
    }

    #[tokio::test]
    async fn an_invalid_world_is_refused_by_its_place() {
        let bench = Bench::new();
        let spec = WorldSpec::ToolPosition(ToolPositionSpec { unit: "inch".to_owned() });
        let error = bench.app.create_world(CreateWorld { name: "air".to_owned(), spec }).await.unwrap_err();
        assert_eq!((error.kind, error.details[0].pointer.as_str()), (ErrorKind::Invalid, "/spec"));
        assert!(bench.app.list_worlds(PageQuery::default()).await.unwrap().items.is_empty());
    }

    #[tokio::test]
    async fn a_refused_name_says_what_is_wrong_with_it() {
        let bench = Bench::new();
        let spec = bench.world().await.spec;
        for (name, told) in
            [("a\u{202e}b", "U+202E"), (" ", "this one has none"), (&*"x".repeat(129), "this one has 129")]
        {
            let request = CreateWorld { name: name.to_owned(), spec: spec.clone() };
            let error = bench.app.create_world(request).await.unwrap_err();
            assert_eq!(error.details[0].pointer, "/name");
            assert!(error.message.contains(told), "{}", error.message);
        }
    }

    #[tokio::test]
    async fn a_world_in_use_is_not_deleted() {
        let bench = Bench::new();
        let spare = bench.world().await;
        let used = bench.run(false).await.world;
        assert_eq!(bench.app.delete_world(&used).await.unwrap_err().code, "in_use");
        bench.app.delete_world(&spare.id).await.unwrap();
        assert_eq!(bench.app.delete_world(&spare.id).await.unwrap_err().kind, ErrorKind::NotFound);
    }
}
