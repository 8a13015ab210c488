//! `ActionService`.

use super::auth::as_caller;
use super::convert::{items, page, required, resource, text, work};
use super::error::status;
use super::files::{FileStream, send};
use super::proto;
use crate::app::App;
use proto::action_service_server::ActionService;
use tonic::{Request, Response, Status};

/// Service implementation on the use cases.
pub struct Service(pub App);

#[tonic::async_trait]
impl ActionService for Service {
    type ExportActionStream = FileStream;

    async fn create_action(
        &self,
        request: Request<proto::CreateActionRequest>,
    ) -> Result<Response<proto::Job>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::CreateActionRequest { generalization, idempotency_key } = request.into_inner();
        let wanted = required("/generalization", generalization).and_then(work::generalization).map_err(status)?;
        let job = app.create_action(wanted, text(idempotency_key)).await.map_err(status)?;
        Ok(Response::new(job.into()))
    }

    async fn get_action(&self, request: Request<proto::GetActionRequest>) -> Result<Response<proto::Action>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::GetActionRequest { id } = request.into_inner();
        let action = app.get_action(&resource(&id).map_err(status)?).await.map_err(status)?;
        Ok(Response::new(action.into()))
    }

    async fn list_actions(
        &self,
        request: Request<proto::ListActionsRequest>,
    ) -> Result<Response<proto::ListActionsResponse>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::ListActionsRequest { page_size, page_token } = request.into_inner();
        let found = app.list_actions(page(page_size, page_token)).await.map_err(status)?;
        let (actions, next_page_token) = items(found);
        Ok(Response::new(proto::ListActionsResponse { actions, next_page_token }))
    }

    async fn get_action_goals(
        &self,
        request: Request<proto::GetActionGoalsRequest>,
    ) -> Result<Response<proto::ActionGoals>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::GetActionGoalsRequest { id } = request.into_inner();
        let goals = app.action_goals(&resource(&id).map_err(status)?).await.map_err(status)?;
        Ok(Response::new(goals.into()))
    }

    async fn interpolate_action(
        &self,
        request: Request<proto::InterpolateActionRequest>,
    ) -> Result<Response<proto::Interpolation>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::InterpolateActionRequest { id, n } = request.into_inner();
        let curve = app.interpolate_action(&resource(&id).map_err(status)?, n).await.map_err(status)?;
        Ok(Response::new(curve.into()))
    }

    async fn export_action(
        &self,
        request: Request<proto::ExportActionRequest>,
    ) -> Result<Response<FileStream>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::ExportActionRequest { id, format } = request.into_inner();
        let file = app.export_action(&resource(&id).map_err(status)?, &format).await.map_err(status)?;
        Ok(send(file))
    }
}
