//! `TrajectoryService`.

use super::auth::as_caller;
use super::convert::resource;
use super::convert::trajectory::{chunks, split};
use super::error::status;
use super::files::{FileStream, send};
use super::proto;
use crate::app::App;
use crate::app::model::{AppError, ErrorKind, limits};
use crate::app::trajectories::export_names;
use futures_util::StreamExt as _;
use futures_util::stream::{BoxStream, iter};
use proto::trajectory_service_server::TrajectoryService;
use tonic::{Request, Response, Status};

/// Service implementation on the use cases.
pub struct Service(pub App);

#[tonic::async_trait]
impl TrajectoryService for Service {
    type ExportTrajectoryStream = FileStream;
    type StreamTrajectoryStream = BoxStream<'static, Result<proto::TrajectoryChunk, Status>>;

    async fn get_trajectory(
        &self,
        request: Request<proto::GetTrajectoryRequest>,
    ) -> Result<Response<proto::Trajectory>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::GetTrajectoryRequest { id } = request.into_inner();
        let view = app.get_trajectory(&resource(&id).map_err(status)?).await.map_err(status)?;
        Ok(Response::new(split(view).0))
    }

    async fn stream_trajectory(
        &self,
        request: Request<proto::StreamTrajectoryRequest>,
    ) -> Result<Response<Self::StreamTrajectoryStream>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::StreamTrajectoryRequest { id, from_index, batch } = request.into_inner();
        let id = resource(&id).map_err(status)?;
        let size = batch_size(batch).map_err(status)?;
        let (_, points) = split(app.get_trajectory(&id).await.map_err(status)?);
        let from = usize::try_from(from_index).unwrap_or(usize::MAX);
        Ok(Response::new(iter(chunks(points, from, size)).map(Ok).boxed()))
    }

    async fn export_trajectory(
        &self,
        request: Request<proto::ExportTrajectoryRequest>,
    ) -> Result<Response<FileStream>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::ExportTrajectoryRequest { id, format, prefix, rename, omit_held } = request.into_inner();
        let names = export_names(prefix, &rename, omit_held).map_err(status)?;
        let file = app.export_trajectory(&resource(&id).map_err(status)?, &format, names).await.map_err(status)?;
        Ok(send(file))
    }
}

fn batch_size(asked: u32) -> Result<usize, AppError> {
    match asked {
        0 => Ok(limits::DEFAULT_TRAJECTORY_BATCH as usize),
        _ if limits::TRAJECTORY_BATCH.contains(&asked) => Ok(asked as usize),
        _ => {
            let message = format!("batch is {asked}: give {}", limits::in_words(&limits::TRAJECTORY_BATCH));
            Err(AppError::new(ErrorKind::Malformed, "invalid_batch", message))
        }
    }
}
