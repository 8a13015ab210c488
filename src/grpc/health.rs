//! `grpc.health.v1`: the same readiness as `/readyz`, for the server (empty name) and each of its services.

use crate::app::App;
use crate::grpc::proto;
use futures_util::StreamExt as _;
use futures_util::stream::BoxStream;
use tokio_stream::wrappers::WatchStream;
use tonic::{Request, Response, Status};
use tonic_health::ServingStatus;
use tonic_health::pb::health_server::{Health, HealthServer};
use tonic_health::pb::{HealthCheckRequest, HealthCheckResponse};

/// The server itself and its services.
const NAMES: [&str; 11] = [
    "",
    proto::action_service_server::SERVICE_NAME,
    proto::demonstration_service_server::SERVICE_NAME,
    proto::experiment_service_server::SERVICE_NAME,
    proto::job_service_server::SERVICE_NAME,
    proto::method_service_server::SERVICE_NAME,
    proto::recognition_service_server::SERVICE_NAME,
    proto::robot_service_server::SERVICE_NAME,
    proto::run_service_server::SERVICE_NAME,
    proto::trajectory_service_server::SERVICE_NAME,
    proto::world_service_server::SERVICE_NAME,
];

/// Service implementation on the use cases.
pub struct Service {
    app: App,
}

/// Health service for the server and its services.
pub fn server(app: App) -> HealthServer<Service> {
    HealthServer::new(Service { app })
}

fn known(name: &str) -> Result<(), Status> {
    if NAMES.contains(&name) {
        return Ok(());
    }
    Err(Status::not_found(format!("there is no service {name:?}: give \"\" or one that reflection lists")))
}

fn answer(ready: bool) -> HealthCheckResponse {
    let status = if ready { ServingStatus::Serving } else { ServingStatus::NotServing };
    HealthCheckResponse { status: status as i32 }
}

#[tonic::async_trait]
impl Health for Service {
    type WatchStream = BoxStream<'static, Result<HealthCheckResponse, Status>>;

    async fn check(&self, request: Request<HealthCheckRequest>) -> Result<Response<HealthCheckResponse>, Status> {
        known(&request.get_ref().service)?;
        Ok(Response::new(answer(self.app.is_ready())))
    }

    async fn watch(&self, request: Request<HealthCheckRequest>) -> Result<Response<Self::WatchStream>, Status> {
        known(&request.get_ref().service)?;
        let changes = WatchStream::new(self.app.readiness());
        Ok(Response::new(changes.map(|ready| Ok(answer(ready))).boxed()))
    }
}
