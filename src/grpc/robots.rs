//! RobotService.

use super::convert::{id, items, page, robot};
use super::error::status;
use super::proto;
use crate::app::App;
use proto::robot_service_server::RobotService;
use tonic::{Request, Response, Status};

/// The service.
pub struct Service(pub App);

#[tonic::async_trait]
impl RobotService for Service {
    async fn create_robot(
        &self,
        request: Request<proto::CreateRobotRequest>,
    ) -> Result<Response<proto::Robot>, Status> {
        let wanted = robot::create(request.into_inner()).map_err(status)?;
        let view = self.0.create_robot(wanted).await.map_err(status)?;
        Ok(Response::new(view.into()))
    }

    async fn get_robot(&self, request: Request<proto::GetRobotRequest>) -> Result<Response<proto::Robot>, Status> {
        let id = id(&request.into_inner().id).map_err(status)?;
        let view = self.0.get_robot(&id).await.map_err(status)?;
        Ok(Response::new(view.into()))
    }

    async fn list_robots(
        &self,
        request: Request<proto::ListRobotsRequest>,
    ) -> Result<Response<proto::ListRobotsResponse>, Status> {
        let request = request.into_inner();
        let found = self.0.list_robots(page(request.page_size, request.page_token)).await.map_err(status)?;
        let (robots, next_page_token) = items(found);
        Ok(Response::new(proto::ListRobotsResponse { robots, next_page_token }))
    }
}
