//! `RunService`.

use super::auth::as_caller;
use super::convert::trajectory::split;
use super::convert::{items, page, reference, resource};
use super::error::status;
use super::proto;
use crate::app::App;
use crate::app::model::RunFilter;
use proto::run_service_server::RunService;
use tonic::{Request, Response, Status};

/// Service implementation on the use cases.
pub struct Service(pub App);

#[tonic::async_trait]
impl RunService for Service {
    async fn get_run(&self, request: Request<proto::GetRunRequest>) -> Result<Response<proto::Run>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::GetRunRequest { id } = request.into_inner();
        let run = app.get_run(&resource(&id).map_err(status)?).await.map_err(status)?;
        Ok(Response::new(run.into()))
    }

    async fn list_runs(
        &self,
        request: Request<proto::ListRunsRequest>,
    ) -> Result<Response<proto::ListRunsResponse>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::ListRunsRequest { job, page_size, page_token } = request.into_inner();
        let job = match job.as_str() {
            "" => None,
            id => Some(reference("/job", id).map_err(status)?),
        };
        let found = app.list_runs(RunFilter { job }, page(page_size, page_token)).await.map_err(status)?;
        let (runs, next_page_token) = items(found);
        Ok(Response::new(proto::ListRunsResponse { runs, next_page_token }))
    }

    async fn get_run_goals(
        &self,
        request: Request<proto::GetRunGoalsRequest>,
    ) -> Result<Response<proto::RunGoals>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::GetRunGoalsRequest { id } = request.into_inner();
        let goals = app.run_goals(&resource(&id).map_err(status)?).await.map_err(status)?;
        Ok(Response::new(goals.into()))
    }

    async fn get_run_trials(
        &self,
        request: Request<proto::GetRunTrialsRequest>,
    ) -> Result<Response<proto::RunTrials>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::GetRunTrialsRequest { id } = request.into_inner();
        let trials = app.run_trials(&resource(&id).map_err(status)?).await.map_err(status)?;
        Ok(Response::new(trials.into()))
    }

    async fn get_run_convergence(
        &self,
        request: Request<proto::GetRunConvergenceRequest>,
    ) -> Result<Response<proto::Convergence>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::GetRunConvergenceRequest { id, max_points } = request.into_inner();
        let curve = app.run_convergence(&resource(&id).map_err(status)?, max_points).await.map_err(status)?;
        Ok(Response::new(curve.into()))
    }

    async fn get_run_trajectory(
        &self,
        request: Request<proto::GetRunTrajectoryRequest>,
    ) -> Result<Response<proto::Trajectory>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::GetRunTrajectoryRequest { id } = request.into_inner();
        let trajectory = app.run_trajectory(&resource(&id).map_err(status)?).await.map_err(status)?;
        Ok(Response::new(split(trajectory).0))
    }
}
