//! RunService.

use super::convert::{id, items, page, reference};
use super::error::status;
use super::proto;
use crate::app::App;
use crate::app::model::RunFilter;
use proto::run_service_server::RunService;
use tonic::{Request, Response, Status};

/// The service.
pub struct Service(pub App);

#[tonic::async_trait]
impl RunService for Service {
    async fn get_run(&self, request: Request<proto::GetRunRequest>) -> Result<Response<proto::Run>, Status> {
        let id = id(&request.into_inner().id).map_err(status)?;
        let view = self.0.get_run(&id).await.map_err(status)?;
        Ok(Response::new(view.into()))
    }

    async fn list_runs(
        &self,
        request: Request<proto::ListRunsRequest>,
    ) -> Result<Response<proto::ListRunsResponse>, Status> {
        let request = request.into_inner();
        let job = match request.job.as_str() {
            "" => None,
            id => Some(reference("/job", id).map_err(status)?),
        };
        let page = page(request.page_size, request.page_token);
        let (runs, next_page_token) = items(self.0.list_runs(RunFilter { job }, page).await.map_err(status)?);
        Ok(Response::new(proto::ListRunsResponse { runs, next_page_token }))
    }

    async fn get_run_goals(
        &self,
        request: Request<proto::GetRunGoalsRequest>,
    ) -> Result<Response<proto::RunGoals>, Status> {
        let id = id(&request.into_inner().id).map_err(status)?;
        let goals = self.0.run_goals(&id).await.map_err(status)?;
        Ok(Response::new(goals.into()))
    }

    async fn get_run_trials(
        &self,
        request: Request<proto::GetRunTrialsRequest>,
    ) -> Result<Response<proto::RunTrials>, Status> {
        let id = id(&request.into_inner().id).map_err(status)?;
        let trials = self.0.run_trials(&id).await.map_err(status)?;
        Ok(Response::new(trials.into()))
    }
}
