//! `RobotService`.

use super::auth::as_caller;
use super::convert::{items, page, resource, robot};
use super::error::status;
use super::proto;
use crate::app::App;
use proto::robot_service_server::RobotService;
use tonic::{Request, Response, Status};

/// Service implementation on the use cases.
pub struct Service(pub App);

#[tonic::async_trait]
impl RobotService for Service {
    async fn create_robot(
        &self,
        request: Request<proto::CreateRobotRequest>,
    ) -> Result<Response<proto::Robot>, Status> {
        let app = as_caller(&self.0, &request)?;
        let wanted = robot::create(request.into_inner()).map_err(status)?;
        let robot = app.create_robot(wanted).await.map_err(status)?;
        Ok(Response::new(robot.into()))
    }

    async fn get_robot(&self, request: Request<proto::GetRobotRequest>) -> Result<Response<proto::Robot>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::GetRobotRequest { id } = request.into_inner();
        let robot = app.get_robot(&resource(&id).map_err(status)?).await.map_err(status)?;
        Ok(Response::new(robot.into()))
    }

    async fn list_robots(
        &self,
        request: Request<proto::ListRobotsRequest>,
    ) -> Result<Response<proto::ListRobotsResponse>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::ListRobotsRequest { page_size, page_token } = request.into_inner();
        let found = app.list_robots(page(page_size, page_token)).await.map_err(status)?;
        let (robots, next_page_token) = items(found);
        Ok(Response::new(proto::ListRobotsResponse { robots, next_page_token }))
    }

    async fn get_robot_urdf(
        &self,
        request: Request<proto::GetRobotUrdfRequest>,
    ) -> Result<Response<proto::RobotUrdf>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::GetRobotUrdfRequest { id } = request.into_inner();
        let urdf = app.robot_urdf(&resource(&id).map_err(status)?).await.map_err(status)?;
        Ok(Response::new(proto::RobotUrdf { urdf }))
    }

    async fn delete_robot(&self, request: Request<proto::DeleteRobotRequest>) -> Result<Response<()>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::DeleteRobotRequest { id } = request.into_inner();
        app.delete_robot(&resource(&id).map_err(status)?).await.map_err(status)?;
        Ok(Response::new(()))
    }
}
