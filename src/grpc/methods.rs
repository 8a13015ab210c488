//! MethodService.

use super::auth::as_caller;
use super::convert::all;
use super::proto;
use crate::app::App;
use crate::app::model::MethodList;
use proto::method_service_server::MethodService;
use tonic::{Request, Response, Status};

/// Implementation on the use cases.
pub struct Service(pub App);

#[tonic::async_trait]
impl MethodService for Service {
    async fn list_methods(
        &self,
        request: Request<proto::ListMethodsRequest>,
    ) -> Result<Response<proto::ListMethodsResponse>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::ListMethodsRequest {} = request.into_inner();
        let MethodList { items } = app.list_methods();
        Ok(Response::new(proto::ListMethodsResponse { methods: all(items) }))
    }
}
