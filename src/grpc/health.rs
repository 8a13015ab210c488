//! `grpc.health.v1`: the same readiness as `/readyz`, for the server (the empty name) and each of its services.

use crate::app::App;
use crate::grpc::proto;
use futures_util::StreamExt as _;
use futures_util::stream::BoxStream;
use prost::Message as _;
use std::collections::BTreeSet;
use tokio_stream::wrappers::WatchStream;
use tonic::{Request, Response, Status};
use tonic_health::ServingStatus;
use tonic_health::pb::health_server::{Health, HealthServer};
use tonic_health::pb::{HealthCheckRequest, HealthCheckResponse};

/// The service.
pub struct Service {
    app: App,
    names: BTreeSet<String>,
}

/// Answers for every service of the descriptors.
pub fn server(app: App) -> HealthServer<Service> {
    let files = prost_types::FileDescriptorSet::decode(proto::DESCRIPTORS).unwrap_or_default().file;
    let names = files
        .iter()
        .flat_map(|file| file.service.iter().map(|service| format!("{}.{}", file.package(), service.name())));
    HealthServer::new(Service { app, names: names.chain([String::new()]).collect() })
}

impl Service {
    fn known(&self, name: &str) -> Result<(), Status> {
        if self.names.contains(name) {
            return Ok(());
        }
        Err(Status::not_found(format!("there is no service {name:?}: ask for \"\" or one that reflection lists")))
    }
}

fn answer(ready: bool) -> HealthCheckResponse {
    let status = if ready { ServingStatus::Serving } else { ServingStatus::NotServing };
    HealthCheckResponse { status: status as i32 }
}

#[tonic::async_trait]
impl Health for Service {
    type WatchStream = BoxStream<'static, Result<HealthCheckResponse, Status>>;

    async fn check(&self, request: Request<HealthCheckRequest>) -> Result<Response<HealthCheckResponse>, Status> {
        self.known(&request.get_ref().service)?;
        Ok(Response::new(answer(self.app.is_ready())))
    }

    async fn watch(&self, request: Request<HealthCheckRequest>) -> Result<Response<Self::WatchStream>, Status> {
        self.known(&request.get_ref().service)?;
        let changes = WatchStream::new(self.app.readiness());
        Ok(Response::new(changes.map(|ready| Ok(answer(ready))).boxed()))
    }
}
