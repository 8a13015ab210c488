//! `WorldService`.

use super::auth::as_caller;
use super::convert::{items, page, resource, world};
use super::error::status;
use super::proto;
use crate::app::App;
use proto::world_service_server::WorldService;
use tonic::{Request, Response, Status};

/// Service implementation on the use cases.
pub struct Service(pub App);

#[tonic::async_trait]
impl WorldService for Service {
    async fn create_world(
        &self,
        request: Request<proto::CreateWorldRequest>,
    ) -> Result<Response<proto::World>, Status> {
        let app = as_caller(&self.0, &request)?;
        let wanted = world::create(request.into_inner()).map_err(status)?;
        let world = app.create_world(wanted).await.map_err(status)?;
        Ok(Response::new(world.into()))
    }

    async fn get_world(&self, request: Request<proto::GetWorldRequest>) -> Result<Response<proto::World>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::GetWorldRequest { id } = request.into_inner();
        let world = app.get_world(&resource(&id).map_err(status)?).await.map_err(status)?;
        Ok(Response::new(world.into()))
    }

    async fn list_worlds(
        &self,
        request: Request<proto::ListWorldsRequest>,
    ) -> Result<Response<proto::ListWorldsResponse>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::ListWorldsRequest { page_size, page_token } = request.into_inner();
        let found = app.list_worlds(page(page_size, page_token)).await.map_err(status)?;
        let (worlds, next_page_token) = items(found);
        Ok(Response::new(proto::ListWorldsResponse { worlds, next_page_token }))
    }

    async fn delete_world(&self, request: Request<proto::DeleteWorldRequest>) -> Result<Response<()>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::DeleteWorldRequest { id } = request.into_inner();
        app.delete_world(&resource(&id).map_err(status)?).await.map_err(status)?;
        Ok(Response::new(()))
    }
}
