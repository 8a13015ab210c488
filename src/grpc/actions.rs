//! ActionService.

use super::convert::{id, items, page, required, text, work};
use super::error::status;
use super::proto;
use crate::app::App;
use proto::action_service_server::ActionService;
use tonic::{Request, Response, Status};

/// The service.
pub struct Service(pub App);

#[tonic::async_trait]
impl ActionService for Service {
    async fn create_action(
        &self,
        request: Request<proto::CreateActionRequest>,
    ) -> Result<Response<proto::Job>, Status> {
        let request = request.into_inner();
        let wanted = required("/generalization", request.generalization).and_then(work::generalization);
        let key = text(request.idempotency_key);
        let job = self.0.create_action(wanted.map_err(status)?, key).await.map_err(status)?;
        Ok(Response::new(job.into()))
    }

    async fn get_action(&self, request: Request<proto::GetActionRequest>) -> Result<Response<proto::Action>, Status> {
        let id = id(&request.into_inner().id).map_err(status)?;
        let view = self.0.get_action(&id).await.map_err(status)?;
        Ok(Response::new(view.into()))
    }

    async fn list_actions(
        &self,
        request: Request<proto::ListActionsRequest>,
    ) -> Result<Response<proto::ListActionsResponse>, Status> {
        let request = request.into_inner();
        let found = self.0.list_actions(page(request.page_size, request.page_token)).await.map_err(status)?;
        let (actions, next_page_token) = items(found);
        Ok(Response::new(proto::ListActionsResponse { actions, next_page_token }))
    }

    async fn get_action_goals(
        &self,
        request: Request<proto::GetActionGoalsRequest>,
    ) -> Result<Response<proto::ActionGoals>, Status> {
        let id = id(&request.into_inner().id).map_err(status)?;
        let goals = self.0.action_goals(&id).await.map_err(status)?;
        Ok(Response::new(goals.into()))
    }
}
