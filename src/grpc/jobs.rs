//! `JobService`.

use super::auth::as_caller;
use super::convert::{items, job, page, resource, text, work};
use super::error::status;
use super::proto;
use crate::app::App;
use crate::app::model::limits;
use futures_util::StreamExt as _;
use futures_util::stream::BoxStream;
use proto::job_service_server::JobService;
use std::time::Duration;
use tonic::{Request, Response, Status};

/// Service implementation on the use cases.
pub struct Service(pub App);

#[tonic::async_trait]
impl JobService for Service {
    type WatchJobStream = BoxStream<'static, Result<proto::JobEvent, Status>>;

    async fn create_job(&self, request: Request<proto::CreateJobRequest>) -> Result<Response<proto::Job>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::CreateJobRequest { work, idempotency_key } = request.into_inner();
        let work = work::work(work).map_err(status)?;
        let job = app.create_job(work, text(idempotency_key)).await.map_err(status)?;
        Ok(Response::new(job.into()))
    }

    async fn validate_job(
        &self,
        request: Request<proto::ValidateJobRequest>,
    ) -> Result<Response<proto::JobValidation>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::ValidateJobRequest { work, robot_trial_s } = request.into_inner();
        let work = work::work(work).map_err(status)?;
        let validation = app.validate_job(work, robot_trial_s).await.map_err(status)?;
        Ok(Response::new(validation.into()))
    }

    async fn get_job(&self, request: Request<proto::GetJobRequest>) -> Result<Response<proto::Job>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::GetJobRequest { id } = request.into_inner();
        let job = app.get_job(&resource(&id).map_err(status)?).await.map_err(status)?;
        Ok(Response::new(job.into()))
    }

    async fn list_jobs(
        &self,
        request: Request<proto::ListJobsRequest>,
    ) -> Result<Response<proto::ListJobsResponse>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::ListJobsRequest { states, kind, page_size, page_token } = request.into_inner();
        let filter = job::filter(&states, kind).map_err(status)?;
        let found = app.list_jobs(filter, page(page_size, page_token)).await.map_err(status)?;
        let (jobs, next_page_token) = items(found);
        Ok(Response::new(proto::ListJobsResponse { jobs, next_page_token }))
    }

    async fn wait_job(&self, request: Request<proto::WaitJobRequest>) -> Result<Response<proto::Job>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::WaitJobRequest { id, after_seq, timeout_ms } = request.into_inner();
        let id = resource(&id).map_err(status)?;
        let timeout_ms = if timeout_ms == 0 { limits::DEFAULT_WAIT_MS } else { timeout_ms };
        let timeout = Duration::from_millis(u64::from(timeout_ms));
        let job = app.wait_job(&id, after_seq, timeout).await.map_err(status)?;
        Ok(Response::new(job.into()))
    }

    async fn watch_job(
        &self,
        request: Request<proto::WatchJobRequest>,
    ) -> Result<Response<Self::WatchJobStream>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::WatchJobRequest { id, after_seq } = request.into_inner();
        let events = app.watch_job(&resource(&id).map_err(status)?, after_seq).await.map_err(status)?;
        Ok(Response::new(events.map(|event| event.map(Into::into).map_err(status)).boxed()))
    }

    async fn pause_job(&self, request: Request<proto::PauseJobRequest>) -> Result<Response<proto::Job>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::PauseJobRequest { id } = request.into_inner();
        let job = app.pause_job(&resource(&id).map_err(status)?).await.map_err(status)?;
        Ok(Response::new(job.into()))
    }

    async fn resume_job(&self, request: Request<proto::ResumeJobRequest>) -> Result<Response<proto::Job>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::ResumeJobRequest { id } = request.into_inner();
        let job = app.resume_job(&resource(&id).map_err(status)?).await.map_err(status)?;
        Ok(Response::new(job.into()))
    }

    async fn cancel_job(&self, request: Request<proto::CancelJobRequest>) -> Result<Response<proto::Job>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::CancelJobRequest { id } = request.into_inner();
        let job = app.cancel_job(&resource(&id).map_err(status)?).await.map_err(status)?;
        Ok(Response::new(job.into()))
    }

    async fn clone_job(&self, request: Request<proto::CloneJobRequest>) -> Result<Response<proto::Job>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::CloneJobRequest { id, idempotency_key } = request.into_inner();
        let id = resource(&id).map_err(status)?;
        let job = app.clone_job(&id, text(idempotency_key)).await.map_err(status)?;
        Ok(Response::new(job.into()))
    }
}
