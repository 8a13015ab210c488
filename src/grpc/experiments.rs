//! ExperimentService.

use super::auth::as_caller;
use super::convert::experiment::{quantity, request as experiment};
use super::convert::{items, page, required, resource, text};
use super::error::status;
use super::files::{FileStream, send};
use super::proto;
use crate::app::App;
use proto::experiment_service_server::ExperimentService;
use tonic::{Request, Response, Status};

/// Service implementation on the use cases.
pub struct Service(pub App);

#[tonic::async_trait]
impl ExperimentService for Service {
    type ExportExperimentStream = FileStream;

    async fn create_experiment(
        &self,
        request: Request<proto::CreateExperimentRequest>,
    ) -> Result<Response<proto::Job>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::CreateExperimentRequest { experiment: message, idempotency_key } = request.into_inner();
        let wanted = required("/experiment", message).and_then(experiment).map_err(status)?;
        let job = app.create_experiment(wanted, text(idempotency_key)).await.map_err(status)?;
        Ok(Response::new(job.into()))
    }

    async fn get_experiment(
        &self,
        request: Request<proto::GetExperimentRequest>,
    ) -> Result<Response<proto::Experiment>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::GetExperimentRequest { id } = request.into_inner();
        let view = app.get_experiment(&resource(&id).map_err(status)?).await.map_err(status)?;
        Ok(Response::new(view.into()))
    }

    async fn list_experiments(
        &self,
        request: Request<proto::ListExperimentsRequest>,
    ) -> Result<Response<proto::ListExperimentsResponse>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::ListExperimentsRequest { page_size, page_token } = request.into_inner();
        let found = app.list_experiments(page(page_size, page_token)).await.map_err(status)?;
        let (experiments, next_page_token) = items(found);
        Ok(Response::new(proto::ListExperimentsResponse { experiments, next_page_token }))
    }

    async fn get_experiment_table(
        &self,
        request: Request<proto::GetExperimentTableRequest>,
    ) -> Result<Response<proto::ExperimentTable>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::GetExperimentTableRequest { id } = request.into_inner();
        let table = app.experiment_table(&resource(&id).map_err(status)?).await.map_err(status)?;
        Ok(Response::new(table.into()))
    }

    async fn list_experiment_rows(
        &self,
        request: Request<proto::ListExperimentRowsRequest>,
    ) -> Result<Response<proto::ListExperimentRowsResponse>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::ListExperimentRowsRequest { id, cell, page_size, page_token } = request.into_inner();
        let (id, page) = (resource(&id).map_err(status)?, page(page_size, page_token));
        let (rows, next_page_token) = items(app.experiment_rows(&id, cell, page).await.map_err(status)?);
        Ok(Response::new(proto::ListExperimentRowsResponse { rows, next_page_token }))
    }

    async fn compare_experiment(
        &self,
        request: Request<proto::CompareExperimentRequest>,
    ) -> Result<Response<proto::ExperimentComparison>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::CompareExperimentRequest { id, first, second, quantity: wanted } = request.into_inner();
        let (id, quantity) = (resource(&id).map_err(status)?, quantity(wanted).map_err(status)?);
        let comparison = app.compare_experiment(&id, first, second, quantity).await.map_err(status)?;
        Ok(Response::new(comparison.into()))
    }

    async fn export_experiment(
        &self,
        request: Request<proto::ExportExperimentRequest>,
    ) -> Result<Response<FileStream>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::ExportExperimentRequest { id, format } = request.into_inner();
        let file = app.export_experiment(&resource(&id).map_err(status)?, &format).await.map_err(status)?;
        Ok(send(file))
    }
}
