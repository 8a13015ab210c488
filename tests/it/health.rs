//! gRPC health agrees with `/readyz`.

use super::clients::{Http, send};
use super::parity::messages::{pool, rpcs};
use super::server::Server;
use reqwest::Method;
use tonic::Code;
use tonic::transport::Endpoint;
use tonic_health::pb::HealthCheckRequest;
use tonic_health::pb::health_check_response::ServingStatus;
use tonic_health::pb::health_client::HealthClient;

#[tokio::test]
async fn health_follows_readiness_for_the_server_and_each_service() {
    let server = Server::start();
    let endpoint = Endpoint::from_shared(format!("http://{}", server.address)).unwrap();
    let mut health = HealthClient::new(endpoint.connect().await.unwrap());
    let ask = |service: &str| HealthCheckRequest { service: service.to_owned() };
    send(Http::new(&server).bare(Method::GET, "/readyz")).await.expect(200);
    let services = rpcs(&pool()).into_iter().map(|rpc| rpc.parent_service().full_name().to_owned());
    for name in services.chain([String::new()]) {
        assert_eq!(health.check(ask(&name)).await.unwrap().into_inner().status(), ServingStatus::Serving, "{name}");
    }
    assert_eq!(health.check(ask("cgda.v1.Nobody")).await.unwrap_err().code(), Code::NotFound);
    let mut changes = health.watch(ask("")).await.unwrap().into_inner();
    assert_eq!(changes.message().await.unwrap().unwrap().status(), ServingStatus::Serving);
    server.ask_to_stop();
    assert_eq!(changes.message().await.unwrap().unwrap().status(), ServingStatus::NotServing);
}
