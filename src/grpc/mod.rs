//! gRPC: one file per service.
//!
//! # Architecture Invariants
//! - A method converts, makes one `app` call and converts back: what a use-case means is decided in `app`.
//! - Radians on the wire, units in the comments of `proto/cgda/v1`.
//! - Every service but health needs the token (`auth.rs`); messages have a limit of size.

mod actions;
mod auth;
mod convert;
mod demonstrations;
pub mod error;
mod experiments;
mod files;
mod health;
mod jobs;
mod methods;
pub mod proto;
mod recognition;
mod robots;
mod runs;
mod trajectories;
mod worlds;

use crate::app::{Access, App};
use proto::action_service_server::ActionServiceServer;
use proto::demonstration_service_server::DemonstrationServiceServer;
use proto::experiment_service_server::ExperimentServiceServer;
use proto::job_service_server::JobServiceServer;
use proto::method_service_server::MethodServiceServer;
use proto::recognition_service_server::RecognitionServiceServer;
use proto::robot_service_server::RobotServiceServer;
use proto::run_service_server::RunServiceServer;
use proto::trajectory_service_server::TrajectoryServiceServer;
use proto::world_service_server::WorldServiceServer;
use tonic::service::Routes;
use tonic::service::interceptor::InterceptedService;

/// Settings of this edge.
#[derive(Debug, Clone)]
pub struct Settings {
    /// Maximum size of one message, bytes.
    pub message_limit_bytes: usize,
    /// Whether clients may ask for the services and their messages.
    pub reflection: bool,
}

/// All services, for the router they share with HTTP.
///
/// # Errors
/// Unreadable descriptors from the build.
pub fn routes(app: App, access: Access, settings: &Settings) -> Result<Routes, tonic_reflection::server::Error> {
    let guard = auth::Guard(access);
    let limit = settings.message_limit_bytes;
    macro_rules! guarded {
        ($server:ident, $service:expr) => {
            InterceptedService::new($server::new($service).max_decoding_message_size(limit), guard.clone())
        };
    }
    let health = health::server(app.clone());
    let mut routes = Routes::new(health)
        .add_service(guarded!(DemonstrationServiceServer, demonstrations::Service(app.clone())))
        .add_service(guarded!(ActionServiceServer, actions::Service(app.clone())))
        .add_service(guarded!(RecognitionServiceServer, recognition::Service(app.clone())))
        .add_service(guarded!(RobotServiceServer, robots::Service(app.clone())))
        .add_service(guarded!(WorldServiceServer, worlds::Service(app.clone())))
        .add_service(guarded!(MethodServiceServer, methods::Service(app.clone())))
        .add_service(guarded!(JobServiceServer, jobs::Service(app.clone())))
        .add_service(guarded!(ExperimentServiceServer, experiments::Service(app.clone())))
        .add_service(guarded!(RunServiceServer, runs::Service(app.clone())))
        .add_service(guarded!(TrajectoryServiceServer, trajectories::Service(app)));
    if settings.reflection {
        let reflection = tonic_reflection::server::Builder::configure()
            .register_encoded_file_descriptor_set(proto::DESCRIPTORS)
            .register_encoded_file_descriptor_set(tonic_health::pb::FILE_DESCRIPTOR_SET)
            .build_v1()?;
        routes = routes.add_service(InterceptedService::new(reflection, guard));
    }
    Ok(routes)
}
